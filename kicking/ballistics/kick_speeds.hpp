#pragma once

#include "kicking/ballistics/crossing.hpp"
#include "kicking/constants.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::kicking {

/// A point that the ball shall pass, kicked by a robot that drives straight ahead.
struct WantedKick {
  FlightPoint point{};
  Elevation exit_angle{};
  double v_front_mps = 0.0;  ///< forward speed of the robot
  double transfer = 1.0;     ///< share of it that the ball takes over
  double gravity_mps2 = kGravity_mps2;

  double u_mps() const { return v_front_mps * transfer; }
};

/// The exit speeds for it, without drag; all none where no speed reaches the point.
struct KickSpeeds {
  OptionalDouble v0_mps;        ///< robot at rest, crossing_speed()
  OptionalDouble vk_exact_mps;  ///< moving_kick_exact(); none also where the robot is too fast for it
  OptionalDouble vk_paper_mps;  ///< moving_kick_paper()
  bool descending = false;      ///< the flight from rest passes the point on its way down
};

KickSpeeds kick_speeds(const WantedKick& wanted);

}  // namespace trivela::kicking
