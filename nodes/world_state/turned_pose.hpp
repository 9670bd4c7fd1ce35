#pragma once

#include <Eigen/Core>
#include <cmath>

#include "kicking/geometry/frames.hpp"

namespace trivela::nodes {

/// A pose with the cosine and sine of its heading, for who turns by it more than once. The same bits as the functions
/// of kicking/geometry/frames.hpp.
struct TurnedPose : kicking::Pose {
  double cosine = 1.0;
  double sine = 0.0;

  TurnedPose() = default;
  explicit TurnedPose(const kicking::Pose& pose)
      : Pose(pose), cosine(std::cos(pose.heading_rad)), sine(std::sin(pose.heading_rad)) {}

  /// A vector of R in F.
  Eigen::Vector2d turn(double x, double y) const { return {cosine * x - sine * y, sine * x + cosine * y}; }

  /// A point of R in F.
  Eigen::Vector2d to_field(double x, double y) const { return Eigen::Vector2d(x_m, y_m) + turn(x, y); }
};

/// `to` seen from `from`: position in the frame of `from`, heading relative to it.
inline kicking::Pose relative(const TurnedPose& from, const kicking::Pose& to) {
  const double dx = to.x_m - from.x_m, dy = to.y_m - from.y_m;
  return {from.cosine * dx + from.sine * dy, -from.sine * dx + from.cosine * dy,
          kicking::wrap_angle(to.heading_rad - from.heading_rad)};
}

/// The pose reached from `from` by the relative step `step`; compose(a, relative(a, b)) = b.
inline kicking::Pose compose(const TurnedPose& from, const kicking::Pose& step) {
  const Eigen::Vector2d position = from.to_field(step.x_m, step.y_m);
  return {position.x(), position.y(), kicking::wrap_angle(from.heading_rad + step.heading_rad)};
}

}  // namespace trivela::nodes
