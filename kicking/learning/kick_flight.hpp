#pragma once

#include <Eigen/Core>

#include "kicking/geometry/frames.hpp"
#include "kicking/learning/kicker_estimate.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::kicking {

/// A kick as its robot decided it and saw it fly; nothing here is a simulator's truth.
struct KickFlight {
  double power = 0.0;
  Pose release{};          ///< of the robot, when its file expects the release, in F
  Twist twist{};           ///< at the decision
  double speed_mps = 0.0;  ///< of the drag-free parabola through the flight where it leaves the floor
  double elevation_rad = 0.0;
  double direction_rad = 0.0;  ///< heading of the flight in F
  double sd_mps = 0.0;         ///< standard deviation of a component of that velocity
  OptionalDouble late_s;       ///< it left so much later than expected; none: not seen
};

/// What a flight shows against what a kicker with these differences gives: along the kick, to its left, up [m/s], late
/// [s].
using FlightResidual = Eigen::Vector4d;

/// A flight against a model, linear about `offsets`: shown = residual(offsets) + design (truth - offsets) + noise.
///
///     velocity = V e^s (c' f + s' up) + (k + along) v_front f0 + (k + side) v_side r0
///
/// f0 and r0 are the robot's forward and right axes at the release, which omega turns during the delay; f is f0 turned
/// by the direction. c' and s' are cosine and sine of the file's angle and the elevation together.
struct LinearFlight {
  FlightResidual residual = FlightResidual::Zero();
  Eigen::Matrix<double, 4, kKickerParts> design = Eigen::Matrix<double, 4, kKickerParts>::Zero();
  double speed_mps = 0.0;  ///< V e^s
  double cosine = 1.0;     ///< c'
  double sine = 0.0;       ///< s'
};
LinearFlight linear_flight(const KickFlight& flight, const RobotModel& file, const KickerVector& offsets);

}  // namespace trivela::kicking
