#include "sim/opponent_body.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::sim {

void OpponentBody::place(const Vec3& ball_m, double distance_m, double bearing_rad, double closing_mps) {
  distance_m_ = distance_m;
  closing_mps_ = closing_mps;
  unit_x_ = -std::sin(bearing_rad);
  unit_y_ = std::cos(bearing_rad);
  close_in(ball_m, 0.0);
}

void OpponentBody::close_in(const Vec3& ball_m, double dt_s) {
  distance_m_ = std::max(0.0, distance_m_ - closing_mps_ * dt_s);
  position_ = {ball_m.x + distance_m_ * unit_x_, ball_m.y + distance_m_ * unit_y_};
}

double OpponentBody::time_until_s(double distance_m) const {
  if (distance_m_ <= distance_m) return 0.0;
  return closing_mps_ > 0.0 ? (distance_m_ - distance_m) / closing_mps_ : HUGE_VAL;
}

}  // namespace trivela::sim
