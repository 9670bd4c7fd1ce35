#pragma once

#include <Eigen/Core>
#include <cmath>

#include "kicking/geometry/frames.hpp"

namespace trivela::kicking {

/// A pose with the cosine and sine of its heading, for who turns by it more than once. The same bits as the functions
/// of kicking/geometry/frames.hpp.
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
