#include "emulators/refbox/box_keys.hpp"

#include "hal/refbox/words.hpp"

namespace trivela::hal::refbox {

std::optional<BoxAct> act_of_key(char key) {
  for (const BoxFaultWord& word : kBoxFaults) {
    if (word.key == key) return word.fault;
  }
  if (key == ' ') return BoxCommand{.kind = CommandKind::kStop};
  if (key == 'E') return BoxCommand{.kind = CommandKind::kEndPart};
  const ParsedCommand letter = read_letter(key, Colour::kCyan);
  const auto* const command = std::get_if<Command>(&letter);
  if (command == nullptr) return std::nullopt;
  BoxCommand said{.kind = command->kind};
  if (command->side != Side::kBoth) said.team = command->side == Side::kOurs ? 0 : 1;
  return said;
}

}  // namespace trivela::hal::refbox
