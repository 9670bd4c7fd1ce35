#pragma once

#include <cstdint>
#include <optional>

#include "idl/refbox/command.hpp"

namespace trivela::hal::refbox {

using trivela::refbox::Colour;
using trivela::refbox::CommandKind;
using trivela::refbox::kCommandNames;
using trivela::refbox::kind_of;
using trivela::refbox::name;

/// Whom a command is for.
enum class Side : std::uint8_t { kBoth, kOurs, kTheirs };

/// One word of the referee box, as our team hears it.
struct Command {
  CommandKind kind = CommandKind::kStop;
  Side side = Side::kBoth;
  std::optional<int> robot_id{};  ///< the league's number of a robot: SUBSTITUTION and IS_ALIVE have one
  bool emulated = false;          ///< WELCOME of a box that is a program of ours and says so

  friend bool operator==(const Command&, const Command&) = default;
};

}  // namespace trivela::hal::refbox
