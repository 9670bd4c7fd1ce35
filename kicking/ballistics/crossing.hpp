#pragma once

#include "kicking/constants.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::kicking {

/// A point that the ball's centre shall pass, seen from the launch: horizontal distance d and height h above the
/// launch's centre.
struct FlightPoint {
  double distance_m = 0.0;
  double height_m = 0.0;
};

/// Height over the launch [m] at a distance of the drag-free flight: z = v_z t - g t^2 / 2, t = d / v_h.
double height_at(double distance_m, double v_h_mps, double v_z_mps, double gravity_mps2 = kGravity_mps2);

/// Exit speed of the drag-free flight through the point [m/s]: v0 = sqrt(g d^2 / (2 cos^2(theta) (d tan(theta) - h))).
/// None if no speed reaches it: d <= 0 or d tan(theta) <= h.
OptionalDouble crossing_speed(const FlightPoint& point, const Elevation& exit_angle,
                              double gravity_mps2 = kGravity_mps2);

/// Does that flight pass the point on its way down: h < d tan(theta) / 2?
bool descends_through(const FlightPoint& point, const Elevation& exit_angle);

/// Landing distance by which the released CAMBADA code brings a height into the range law [m]: d + h / tan(theta).
/// First order in h only: the ball crosses d at h / (1 + h / (d tan(theta))).
double extended_range(const FlightPoint& point, const Elevation& exit_angle);

/// How a ball leaves the kicker.
struct LobExit {
  double angle_rad = 0.0;  ///< over the floor
  double speed_mps = 0.0;
  double t_flight_s = 0.0;  ///< until it is back at launch height
};

/// Exit of a lob from its apex height H and range D [m], both of the ball's centre relative to the launch (paper,
/// section 2.2): theta = atan(4 H / D), V0 = sqrt(D g / sin(2 theta)). Effective values: drag is absorbed.
/// Throws std::invalid_argument unless both are positive.
LobExit exit_from_lob(double apex_m, double range_m, double gravity_mps2 = kGravity_mps2);

/// Exit speed for the target's height at its distance.
/// kPaper: the range law of section 2.2, the ball lands on the goal line. kExtendedRange: the released code's D = d + h
/// / tan(theta). kExact: the parabola through the target.
enum class HeightLaw { kPaper, kExtendedRange, kExact };

/// The point that the drag-free flight shall pass, by that law, so that the ball meets the target.
inline FlightPoint point_by(HeightLaw law, const FlightPoint& target, const Elevation& exit_angle) {
  switch (law) {
    case HeightLaw::kPaper:
      return {target.distance_m, 0.0};
    case HeightLaw::kExtendedRange:
      return {extended_range(target, exit_angle), 0.0};
    case HeightLaw::kExact:
      break;
  }
  return target;
}

}  // namespace trivela::kicking
