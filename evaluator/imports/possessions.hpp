#pragma once

#include <cstdint>
#include <vector>

#include "evaluator/imports/team_log.hpp"

namespace trivela::evaluator::imports {

/// A robot had the ball.
struct Possession {
  int robot_id = 0;
  std::int64_t from_ms = 0;  ///< UTC since 1970: first and last record that say so
  std::int64_t to_ms = 0;
  std::vector<double> speeds_mps{};  ///< over ground, of the records that have one

  double duration_s() const { return 1e-3 * static_cast<double>(to_ms - from_ms); }
};

/// A contact that is lost for less is the same possession; a shorter possession is none. Both as
/// docs/data/possessions_2016.csv was counted.
inline constexpr std::int64_t kSamePossession_ms = 600, kShortestPossession_ms = 300;

/// Possessions of a team by its robots' `ballEngaged`, in the order of their ends. `times_ms`: of the usable records.
std::vector<Possession> possessions(const TeamLog& log, const std::vector<std::int64_t>& times_ms);

}  // namespace trivela::evaluator::imports
