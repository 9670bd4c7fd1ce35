#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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

}  // namespace trivela::hal::refbox
