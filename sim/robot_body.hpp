#pragma once

#include "kicking/geometry/frames.hpp"
#include "sim/scenario.hpp"
#include "sim/truth.hpp"

namespace trivela::sim {

/// The direction of +x of R in F.
struct PlanVector {
  double c = 1.0;
  double s = 0.0;
};

/// The robot's base: it follows a set-point as fast as its limits let it. Speed and acceleration are limited as vectors
/// over ground, so that turning while driving costs acceleration.
class RobotBody {
 public:
  explicit RobotBody(const Robot& limits) : limits_(limits) {}

  /// Puts the robot there, moving at `twist` (in R) and following it from now on.
  void place(const kicking::Pose& pose, const kicking::Twist& twist);

  /// The velocity in R to follow; scaled down to the limits. A set-point that is not finite counts as zero.
  void follow(const kicking::Twist& set_point);

  /// Moves for dt [s], a control cycle at most. Exact for a ramp and for a constant twist; in between the error is of
  /// the third order.
  void advance(double dt_s);

  const kicking::Pose& pose() const { return pose_; }

  /// (cos, sin) of the heading.
  const PlanVector& axis() const { return axis_; }

  /// Velocity in R.
  kicking::Twist twist() const;

  /// The held ball's centre on the floor plan, in F (z = 0).
  Eigen::Vector3d ball_point_m() const;

 private:
  void turn(double dt_s);

  Robot limits_;
  kicking::Pose pose_;
  PlanVector axis_;
  kicking::Twist set_point_;
  double vx_field_mps_ = 0.0;
  double vy_field_mps_ = 0.0;
  double omega_radps_ = 0.0;
};

}  // namespace trivela::sim
