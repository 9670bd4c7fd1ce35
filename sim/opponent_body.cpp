#include "sim/opponent_body.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::sim {

void OpponentBody::place(const Eigen::Vector3d& ball_m, const OpponentStart& start) {
  distance_m_ = start.distance_m;
  closing_mps_ = start.closing_mps;
  unit_x_ = -std::sin(start.bearing_rad);
  unit_y_ = std::cos(start.bearing_rad);
  close_in(ball_m, 0.0);
}

void OpponentBody::close_in(const Eigen::Vector3d& ball_m, double dt_s) {
  distance_m_ = std::max(0.0, distance_m_ - closing_mps_ * dt_s);
  position_ = {ball_m.x() + distance_m_ * unit_x_, ball_m.y() + distance_m_ * unit_y_};
}

double OpponentBody::time_until_s(double distance_m) const {
  if (distance_m_ <= distance_m) return 0.0;
  return closing_mps_ > 0.0 ? (distance_m_ - distance_m) / closing_mps_ : HUGE_VAL;
}

void Opponents::place(const Eigen::Vector3d& ball_m, const Opportunity& opportunity) {
  count_ = opportunity.opponent_count;
  for (std::size_t i = 0; i < count_; ++i) bodies_[i].place(ball_m, opportunity.opponents[i]);
}

void Opponents::close_in(const Eigen::Vector3d& ball_m, double dt_s) {
  for (std::size_t i = 0; i < count_; ++i) bodies_[i].close_in(ball_m, dt_s);
}

const OpponentBody& Opponents::first_at(double distance_m) const {
  return *std::ranges::min_element(all(), {}, [=](const OpponentBody& body) { return body.time_until_s(distance_m); });
}

const OpponentBody& Opponents::nearest() const {
  return *std::ranges::min_element(all(), {}, &OpponentBody::distance_m);
}

}  // namespace trivela::sim
