#pragma once

#include "sim/sensors.hpp"
#include "sim/truth.hpp"

namespace trivela::sim {

/// The nearest opponent. While the robot has the ball it keeps up with it and its distance falls at a constant rate:
/// p = ball + distance(t) (-sin bearing, cos bearing). Once the ball is gone it stands.
class OpponentBody {
 public:
  /// `bearing_rad`: from the ball, counter-clockwise from +y of F.
  void place(const Vec3& ball_m, double distance_m, double bearing_rad, double closing_mps);

  /// Closes in for dt [s] on the ball, which is now at `ball_m`. Never passes through it.
  void close_in(const Vec3& ball_m, double dt_s);

  /// How long until it is `distance_m` from the ball; without end if it never is.
  double time_until_s(double distance_m) const;

  double closing_mps() const { return closing_mps_; }

  /// From the ball when it was last held [m].
  double distance_m() const { return distance_m_; }
  const PlanPoint& position() const { return position_; }

 private:
  double distance_m_ = 0.0;
  double closing_mps_ = 0.0;
  double unit_x_ = 0.0;
  double unit_y_ = 1.0;
  PlanPoint position_;
};

}  // namespace trivela::sim
