#pragma once

#include <Eigen/Core>

#include "kicking/geometry/angle.hpp"

namespace trivela::kicking {

// Frames. F, the field: origin at the centre spot, +y to the opponents' goal, +x right.
//         R, the robot: origin at its centre, +y forward, +x right.
// Angles are counter-clockwise; heading 0 faces +y of F. (CAMBADA's own convention; paper, figure 7.)

/// Where the robot is, in F.
struct Pose {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
};

/// How the robot moves, in R: vx to its right, vy forward, omega counter-clockwise.
struct Twist {
  double vx_mps = 0.0;
  double vy_mps = 0.0;
  double omega_radps = 0.0;
};

/// The vector turned counter-clockwise by the angle.
Eigen::Vector2d rotate(const Eigen::Vector2d& vector, double angle_rad);

/// Unit vector in F of a heading: (-sin, cos).
Eigen::Vector2d direction(double heading_rad);

/// Point of R in F: p + rotate(point, heading).
Eigen::Vector2d to_field(const Pose& pose, const Eigen::Vector2d& point_in_robot_m);

/// Point of F in R; the inverse of to_field.
Eigen::Vector2d to_robot(const Pose& pose, const Eigen::Vector2d& point_in_field_m);

/// Heading that faces `to` from `from`, both in F [rad].
double bearing(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m);

/// Pose after dt at constant twist in R, in closed form:
/// displacement in R = dt [sinc -versc; versc sinc] (vx, vy) with sinc = sin(omega dt)/(omega dt),
/// versc = (1 - cos(omega dt))/(omega dt); exact for every omega, zero included. The heading is not wrapped.
Pose advance(const Pose& pose, const Twist& twist, double dt_s);

}  // namespace trivela::kicking
