#pragma once

#include <optional>
#include <string_view>

#include "emulators/refbox/box_act.hpp"

namespace trivela::hal::refbox {

/// What a key of a box's prompt does: the letters of the old protocol (lower case: the right team, upper case: the left
/// one), the space bar STOP, E END_PART, and faults under letters that it has left. None: nothing.
std::optional<BoxAct> act_of_key(char key);

/// The keys, for people.
inline constexpr std::string_view kKeyHelp =
    "s START, space or S STOP; left team in upper case, right team in lower case: K kick-off, F free kick, G goal "
    "kick,\n"
    "T throw-in, C corner, P penalty, A goal, D goal taken back, O repair, Y R B cards; N drop ball; 1 2 3 4 halves,\n"
    "h half-time, e end of game, E end of part, z game over, L park, Z reset\n"
    "faults: m next two objects in one write, l next object in two, i unknown command, j broken object, n object "
    "without\n"
    "a command, v overlong object, x close, X reset connections, w silent, q deaf, H heal; ? these lines, Ctrl-C "
    "ends\n";

}  // namespace trivela::hal::refbox
