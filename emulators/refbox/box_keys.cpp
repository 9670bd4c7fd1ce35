#include "emulators/refbox/box_keys.hpp"

#include "hal/refbox/words.hpp"

namespace trivela::hal::refbox {
namespace {

constexpr std::array<std::pair<char, BoxFault>, 11> kFaultKeys{{{'m', BoxFault::kMerge},
                                                                {'l', BoxFault::kSplit},
                                                                {'i', BoxFault::kUnknown},
                                                                {'j', BoxFault::kBroken},
                                                                {'n', BoxFault::kStatus},
                                                                {'v', BoxFault::kOverlong},
                                                                {'x', BoxFault::kClose},
                                                                {'X', BoxFault::kReset},
                                                                {'w', BoxFault::kSilent},
                                                                {'q', BoxFault::kDeaf},
                                                                {'H', BoxFault::kHeal}}};
static_assert(kFaultKeys.size() == kBoxFaults.size());

}  // namespace

std::optional<BoxAct> act_of_key(char key) {
  for (const auto& [known, fault] : kFaultKeys) {
    if (known == key) return fault;
  }
  if (key == ' ') return BoxCommand{.kind = CommandKind::kStop};
  if (key == 'E') return BoxCommand{.kind = CommandKind::kEndPart};
  const ParsedCommand word = read_letter(key, Colour::kCyan);
  const auto* const command = std::get_if<Command>(&word);
  if (command == nullptr) return std::nullopt;
  BoxCommand said{.kind = command->kind};
  if (command->side != Side::kBoth) said.team = command->side == Side::kOurs ? 0 : 1;
  return said;
}

}  // namespace trivela::hal::refbox
