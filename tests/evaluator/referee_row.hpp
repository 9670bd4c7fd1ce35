#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "log/schema/row.hpp"

namespace trivela::evaluator {

/// The columns of the table referee that may not be left out.
inline const std::vector<std::string>& referee_columns() {
  static const std::vector<std::string> columns{
      "robot_id",        "seq",   "t_ns",   "half", "playing", "possession_id", "ours", "goals_own", "goals_other",
      "command_counter", "stage", "restart"};
  return columns;
}

/// A row of them, with nothing announced or counted.
inline std::vector<log::Value> referee_cells(std::int64_t robot_id, std::int64_t seq, std::int64_t t_ns,
                                             std::int64_t half, bool playing, std::int64_t possession_id) {
  using Int = std::int64_t;
  return {robot_id, seq,    t_ns,   half,   Int{playing},           possession_id,
          Int{0},   Int{0}, Int{0}, Int{0}, std::string{"unknown"}, std::string{"none"}};
}

}  // namespace trivela::evaluator
