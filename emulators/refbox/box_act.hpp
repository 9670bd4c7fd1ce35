#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
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

inline constexpr std::array<std::pair<std::string_view, BoxFault>, 11> kBoxFaults{{{"merge", BoxFault::kMerge},
                                                                                   {"split", BoxFault::kSplit},
                                                                                   {"unknown", BoxFault::kUnknown},
                                                                                   {"broken", BoxFault::kBroken},
                                                                                   {"status", BoxFault::kStatus},
                                                                                   {"overlong", BoxFault::kOverlong},
                                                                                   {"close", BoxFault::kClose},
                                                                                   {"reset", BoxFault::kReset},
                                                                                   {"silent", BoxFault::kSilent},
                                                                                   {"deaf", BoxFault::kDeaf},
                                                                                   {"heal", BoxFault::kHeal}}};

using BoxAct = std::variant<BoxCommand, BoxFault>;

/// An act at its time [s] from the beginning.
struct BoxStep {
  double at_s = 0.0;
  BoxAct act;
};

}  // namespace trivela::hal::refbox
