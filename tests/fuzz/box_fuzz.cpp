// What an emulated referee box is told and what teams send it: any bytes as a script, as a log of a real box, and as
// an object of a team. Times never go back, a script that cannot be read is refused with its line, and every command is
// heard as it was said, in both protocols.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "emulators/refbox/box_act.hpp"
#include "emulators/refbox/emulated_box.hpp"
#include "hal/refbox/words.hpp"
#include "tests/fuzz/script.hpp"

namespace {

using namespace trivela::hal::refbox;
using trivela::tests::require;

Side side_of(const BoxCommand& said) { return said.team ? Side::kOurs : Side::kBoth; }

void hear_object(const BoxCommand& said, const BoxConfig& box) {
  std::string object = wire_text(said, box);
  require(object.ends_with('\0'));
  object.pop_back();
  const ParsedCommand word = read_object(object, box.groups.at(said.team.value_or(0)));
  const auto* const received = std::get_if<Command>(&word);
  require(received != nullptr && received->kind == said.kind && received->side == side_of(said));
  require(received->robot_id == said.robot_id);
}

void hear_letter(const BoxCommand& said, const BoxConfig& box) {
  const std::string letter = wire_text(said, box);
  if (letter.empty()) return;  // the old protocol has no word for it
  require(letter.size() == 1);
  const ParsedCommand word = read_letter(letter[0], said.team == std::size_t{1} ? Colour::kMagenta : Colour::kCyan);
  const auto* const received = std::get_if<Command>(&word);
  require(received != nullptr && received->kind == said.kind && received->side == side_of(said));
}

void check(const std::vector<BoxStep>& steps) {
  double last_s = 0.0;
  for (const BoxStep& step : steps) {
    require(std::isfinite(step.at_s) && step.at_s >= last_s);
    last_s = step.at_s;
    const auto* const said = std::get_if<BoxCommand>(&step.act);
    if (said == nullptr) continue;
    hear_object(*said, {});
    hear_letter(*said, {.protocol = Protocol::kLetters});
  }
}

template <class Read>
void read_or_refuse(Read read, std::string_view text) {
  try {
    check(read(text, "x.txt"));
  } catch (const std::runtime_error& refused) {
    require(std::string_view(refused.what()).starts_with("x.txt"));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  read_or_refuse(read_box_script, text);
  read_or_refuse(read_box_log, text);
  const auto problem = worldstate_problem(text);
  require(!problem || !problem->empty());
  return 0;
}
