#pragma once

#include <span>

#include "sim/opportunity.hpp"
#include "sim/sensors.hpp"
#include "sim/truth.hpp"

namespace trivela::sim {

/// An opponent. While the robot has the ball it keeps up with it and its distance falls at a constant rate:
/// p = ball + distance(t) (-sin bearing, cos bearing). Once the ball is gone it stands.
class OpponentBody {
 public:
  void place(const Eigen::Vector3d& ball_m, const OpponentStart& start);

  /// Closes in for dt [s] on the ball, which is now at `ball_m`. Never passes through it.
  void close_in(const Eigen::Vector3d& ball_m, double dt_s);

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

/// All of them.
class Opponents {
 public:
  void place(const Eigen::Vector3d& ball_m, const Opportunity& opportunity);
  void close_in(const Eigen::Vector3d& ball_m, double dt_s);

  /// Whoever is `distance_m` from the ball first.
  const OpponentBody& first_at(double distance_m) const;

  /// The one nearest to the ball.
  const OpponentBody& nearest() const;

  std::span<const OpponentBody> all() const { return {bodies_.data(), count_}; }

 private:
  std::array<OpponentBody, kMostOpponents> bodies_;
  std::size_t count_ = 1;
};

}  // namespace trivela::sim
