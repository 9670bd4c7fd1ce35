#pragma once

#include <Eigen/Core>

#include <cmath>

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

/// A pose with the cosine and sine of its heading, for who turns by it more than once. The same bits as the functions
/// of Pose.
struct TurnedPose : Pose {
  double cosine = 1.0;
  double sine = 0.0;

  TurnedPose() = default;
  explicit TurnedPose(const Pose& pose) : TurnedPose(pose.x_m, pose.y_m, pose.heading_rad) {}
  TurnedPose(double x, double y, double heading)
      : Pose{x, y, heading}, cosine(std::cos(heading)), sine(std::sin(heading)) {}

  /// Unit vectors of R in F: forward (-sin, cos) and to the right (cos, sin).
  Eigen::Vector2d forward() const { return {-sine, cosine}; }
  Eigen::Vector2d right() const { return {cosine, sine}; }

  /// A vector of R in F.
  Eigen::Vector2d turn(double x, double y) const { return {cosine * x - sine * y, sine * x + cosine * y}; }

  /// A point of R in F.
  Eigen::Vector2d to_field(double x, double y) const { return Eigen::Vector2d(x_m, y_m) + turn(x, y); }
};

/// `to` seen from `from`: position in the frame of `from`, heading relative to it.
inline Pose relative(const TurnedPose& from, const Pose& to) {
  const double dx = to.x_m - from.x_m, dy = to.y_m - from.y_m;
  return {from.cosine * dx + from.sine * dy, -from.sine * dx + from.cosine * dy,
          wrap_angle(to.heading_rad - from.heading_rad)};
}

/// The pose reached from `from` by the relative step `step`; compose(a, relative(a, b)) = b.
inline Pose compose(const TurnedPose& from, const Pose& step) {
  return {from.x_m + (from.cosine * step.x_m - from.sine * step.y_m),
          from.y_m + (from.sine * step.x_m + from.cosine * step.y_m), wrap_angle(from.heading_rad + step.heading_rad)};
}

}  // namespace trivela::kicking
