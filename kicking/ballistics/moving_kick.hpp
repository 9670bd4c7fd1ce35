#pragma once

#include <cmath>
#include <optional>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/constants.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::kicking {

/// Share of the robot's velocity that the ball takes along, forward, backward and sideways apart. A constant belongs to
/// the law it was fitted in: 0.70 in the paper's law is about what the exact law gives for a full transfer of 1.
struct Transfer {
  double forward = 1.0;
  double backward = 1.0;
  double lateral = 1.0;

  /// Velocity [m/s] along the robot's forward axis that the ball takes over from v_front [m/s].
  constexpr double along_mps(double v_front_mps) const {
    return (v_front_mps < 0.0 ? backward : forward) * v_front_mps;
  }
};

/// The paper's law of a moving robot (section 2.2) [m/s]: V_kick = V0 - u cos(theta), u = k v_front. Exact to first
/// order at 45 degrees and h = 0, not in general; with k about 0.7 it is good to a few centimetres up to 1 m/s.
double moving_kick_paper(double v0_mps, double u_mps, const Elevation& exit_angle);

/// Kick of a robot whose forward velocity adds u = k v_front [m/s] to the ball's horizontal speed V cos(theta), through
/// the point: V^2 c (d s - h c) + V u (d s - 2 h c) - (h u^2 + g d^2 / 2) = 0, the positive root. None if d <= 0, d
/// tan(theta) <= h or the robot alone is too fast for a point below the launch.
OptionalDouble moving_kick_exact(const FlightPoint& point, const Elevation& exit_angle, double u_mps,
                                 double gravity_mps2 = kGravity_mps2);

/// The way to a line in front: its distance D straight ahead, the share of the kick's direction that points there (cos
/// of the angle between them), and what the robot's motion adds towards it.
struct LineAhead {
  double distance_m = 0.0;
  double toward_ratio = 1.0;
  double carried_mps = 0.0;
};

struct DirectedKick {
  double v_kick_mps = 0.0;
  double t_flight_s = 0.0;
};

/// Exit speed of a kick whose direction is given, so that the ball crosses the line at height h over the launch,
/// without drag. With a = toward_ratio, T the time of flight and V the speed: V c a + u = D / T and V s T - g T^2 / 2 =
/// h. Eliminating V, g T^2 / 2 + (tan(theta) u / a) T - (tan(theta) D / a - h) = 0, the positive root. None if the kick
/// points away from the line (a <= 0), the height is above its straight line or the speed would not be positive.
std::optional<DirectedKick> directed_kick(const LineAhead& line, double height_m, const Elevation& exit_angle,
                                          double gravity_mps2 = kGravity_mps2);

/// Velocity [m/s] that the robot gives to the ball at its point, seen along the line ball - target.
struct Carry {
  double along_mps = 0.0;
  double right_mps = 0.0;
};

/// Kick that makes up for the carry in speed and direction at once.
struct Aim {
  double v_kick_mps = 0.0;
  double t_flight_s = 0.0;
  double left_mps = 0.0;    ///< of the kick's own velocity: away from the line, against the carry
  double toward_mps = 0.0;  ///< and along it, > 0
};

/// Joint solution of direction and height, without drag, with T the time of flight and delta the angle to the left:
/// V c sin(delta) = w_right, V c cos(delta) + w_along = d / T, V s T - g T^2 / 2 = h. Eliminating V and delta,
/// (h + g T^2 / 2) cot(theta) = |(d - w_along T, w_right T)|, solved for T in a bracket.
/// None if the point is out of the angle's reach or the kicker would have to point backwards.
std::optional<Aim> aim_exact(const FlightPoint& point, const Elevation& exit_angle, const Carry& carry,
                             double gravity_mps2 = kGravity_mps2);

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
