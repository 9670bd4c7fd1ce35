#pragma once

#include <optional>

#include "kicking/constants.hpp"
#include "kicking/geometry/angle.hpp"

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
std::optional<double> crossing_speed(const FlightPoint& point, const Elevation& exit_angle,
                                     double gravity_mps2 = kGravity_mps2);

/// Does that flight pass the point on its way down: h < d tan(theta) / 2?
bool descends_through(const FlightPoint& point, const Elevation& exit_angle);

/// Landing distance by which the released CAMBADA code brings a height into the range law [m]: d + h / tan(theta).
/// First order in h only: the ball crosses d at h / (1 + h / (d tan(theta))).
double extended_range(const FlightPoint& point, const Elevation& exit_angle);

}  // namespace trivela::kicking
