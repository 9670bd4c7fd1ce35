#pragma once

#include <optional>

#include "idl/refbox/command.hpp"

namespace trivela::evaluator::imports {

using BoxCommand = refbox::CommandKind;

/// For whom: the box's left team is cyan (its log is `.A.msl`), the right one magenta (`.B.msl`).
enum class BoxSide { kBoth, kCyan, kMagenta };

constexpr BoxSide side_of(std::optional<refbox::Colour> team) {
  if (!team) return BoxSide::kBoth;
  return *team == refbox::Colour::kCyan ? BoxSide::kCyan : BoxSide::kMagenta;
}

/// A command of a log with its side; of one that was sent as JSON the side is that of its targetTeam.
struct SidedCommand {
  BoxCommand command{};
  BoxSide side = BoxSide::kBoth;
};

}  // namespace trivela::evaluator::imports
