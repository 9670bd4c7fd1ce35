#pragma once

#include <cstdint>

#include "sim/scenario.hpp"

namespace trivela::sim {

/// The kicker of one of our robots, counted from 1, on the day of its calibration: that of the scenario with the
/// robot's own speeds.
Kicker team_kicker(const Scenario& scenario, std::uint32_t robot);

/// The same in the match of that seed: its speeds have drifted by one factor 1 + N(0, drift_sd_ratio).
Kicker match_kicker(const Scenario& scenario, std::uint32_t robot, std::uint64_t seed);

/// Of the speeds that this kicker began with, what it has after so many kicks: 1, or 1 - drop_ratio from
/// drop_after_kicks on.
double worn_ratio(const Kicker& kicker, std::uint32_t kicks);

/// The kicker with its lever for that kind of kick: 0 is the lob, any other the flat kick where there is one.
Kicker kicker_of_kind(const Kicker& kicker, std::size_t kind);

/// Speed and elevation with which a ball leaves the robot at rest.
struct Exit {
  double speed_mps = 0.0;
  double elevation_rad = 0.0;
};

/// The true exit at `power`: linear between the table's set-points, clamped to its ends.
Exit exit_at(const Kicker& kicker, double power);

/// What the paper's calibration makes of a true exit: fly it with drag back to the height it left from, measure apex H
/// and range D, and read theta = atan(4 H / D), v = sqrt(D g / sin 2 theta) (paper, section 2). Without drag it is the
/// identity. Throws std::runtime_error for an elevation outside (0, pi/2) or a speed that is not positive.
Exit effective_exit(const Exit& true_exit, const BallPhysics& ball);

/// The true exit whose effective_exit() is `effective`: how the default table of Kicker follows from the published map.
Exit true_exit(const Exit& effective, const BallPhysics& ball);

}  // namespace trivela::sim
