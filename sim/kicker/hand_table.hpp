#pragma once

#include <cstdint>

#include "kicking/model/distance_table.hpp"
#include "sim/scenario.hpp"

namespace trivela::sim {

/// The height table as a person makes it before there is a laser (paper, section 2.2): from each set-point distance the
/// robot kicks with whole-number powers until the balls seem to pass at the target's height, and a polynomial goes
/// through the powers found. A model of the human error, of assumptions alone (Scenario::hand_table):
///
///   1. on the day of the table the kicker is `(1 + day_sd_ratio N)` times as fast as in the match;
///   2. at each distance the height is judged wrong by `eye_height_sd_m N`, and at all of them by `eye_bias_sd_m N`:
///      what this person takes for a good height;
///   3. the balls judged are `kicks_per_distance`, whose own scatter (kicker.speed_sd_ratio) the person sees as well;
///   4. the power noted is the nearest whole number;
///   5. least squares of degree 2 through them (the paper gives no degree).
///
/// Distances beyond the kicker's reach on that day are left out. A table with fewer than two distances, or whose powers
/// do not rise, is none that anybody would play by: it is made again on another day, all numbers drawn again.
/// One draw for each (seed, match, robot): the same in every arm. `robot` counts from 1; `kicker` is that robot's, or
/// the team's reference where one table serves all.
/// Throws std::runtime_error where 100 tables in a row are no good.
kicking::DistanceTable draw_hand_table(const Scenario& scenario, const Kicker& kicker, std::uint64_t seed,
                                       std::uint32_t match, std::uint32_t robot);

}  // namespace trivela::sim
