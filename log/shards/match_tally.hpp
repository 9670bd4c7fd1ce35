#pragma once

#include <cstdint>
#include <vector>

namespace trivela::log {

/// What one arm did in one match.
struct MatchTally {
  std::int64_t opportunities = 0;
  std::int64_t kicks = 0;
  std::int64_t on_target = 0;       ///< observed
  std::int64_t blocked = 0;         ///< observed
  std::int64_t bounced = 0;         ///< on target, and by the simulator's truth it touched the floor before
  std::int64_t goals = 0;           ///< by the simulator's truth: on target and past the keeper, where there is one
  std::uint32_t calibration = 0;    ///< number of the calibration of its robots
  std::int64_t true_on_target = 0;  ///< by the simulator's truth; 0 where it was not counted

  bool operator==(const MatchTally&) const = default;
};

/// An arm's matches, in the order of their numbers.
using ArmTally = std::vector<MatchTally>;

}  // namespace trivela::log
