#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/refbox/command.hpp"

namespace trivela::hal::refbox {

/// A command that an emulated box says; team 0 is the left one, in cyan, 1 the right one, in magenta; none: both.
struct BoxCommand {
  CommandKind kind = CommandKind::kStop;
  std::optional<std::size_t> team{};
  std::optional<int> robot_id{};

  friend bool operator==(const BoxCommand&, const BoxCommand&) = default;
};

/// What real boxes and their networks do to a client.
enum class BoxFault : std::uint8_t {
  kMerge,     ///< the next two objects leave in one write
  kSplit,     ///< the next object leaves in two writes, some time apart
  kUnknown,   ///< a command that nobody knows
  kBroken,    ///< an object that is no JSON
  kStatus,    ///< an object without a command
  kOverlong,  ///< an object of 200 kB
  kClose,     ///< every connection is closed
  kReset,     ///< every connection is reset
  kSilent,    ///< nothing is said from now on, commands are lost
  kDeaf,      ///< nothing is read from now on: what clients send is acknowledged no more
  kHeal       ///< ends silence and deafness
};

/// By which name a script asks for a fault, and by which key a person.
struct BoxFaultWord {
  std::string_view name;
  char key;
  BoxFault fault;
};
inline constexpr std::array<BoxFaultWord, 11> kBoxFaults{{
    {"merge", 'm', BoxFault::kMerge},
    {"split", 'l', BoxFault::kSplit},
    {"unknown", 'i', BoxFault::kUnknown},
    {"broken", 'j', BoxFault::kBroken},
    {"status", 'n', BoxFault::kStatus},
    {"overlong", 'v', BoxFault::kOverlong},
    {"close", 'x', BoxFault::kClose},
    {"reset", 'X', BoxFault::kReset},
    {"silent", 'w', BoxFault::kSilent},
    {"deaf", 'q', BoxFault::kDeaf},
    {"heal", 'H', BoxFault::kHeal},
}};

using BoxAct = std::variant<BoxCommand, BoxFault>;

/// An act at its time [s] from the beginning.
struct BoxStep {
  double at_s = 0.0;
  BoxAct act;
};

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

/// A script for an emulated box: a line an act, "SECONDS COMMAND [left|right [ROBOT]]" or "SECONDS fault NAME", in the
/// order of time; what follows a # is left out. `name` is the file's, for messages. Throws std::runtime_error with
/// file, line and value for a line that is none, and for a time before the one above it.
std::vector<BoxStep> read_box_script(std::string_view text, const std::string& name);

/// The commands in the text log of a real box, from its first on: "ms,time(run time),state,code,text" with a letter of
/// the old protocol, a command, or a command's JSON object as the code (RoboCup-MSL/RefBox, mslrb2015/Log.pde, and
/// logs of 2016 to 2018). Other lines are left out. An object's team is the left one when it is the first team named.
/// Throws std::runtime_error where there is no command at all.
std::vector<BoxStep> read_box_log(std::string_view text, const std::string& name);

}  // namespace trivela::hal::refbox
