#include "kicking/ballistics/floor_way.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::kicking {
namespace {

/// Time over `distance_m` from v_mps on with a steady deceleration; infinite where it stops before.
double slowed_time_s(double v_mps, double distance_m, double deceleration_mps2) {
  const double square = v_mps * v_mps - 2.0 * deceleration_mps2 * distance_m;
  return square >= 0.0 ? 2.0 * distance_m / (v_mps + std::sqrt(square)) : HUGE_VAL;
}

}  // namespace

double floor_time_s(double v_h_mps, double v_z_mps, double distance_m, const Floor& floor, double gravity_mps2) {
  if (!(v_h_mps > 0.0)) return HUGE_VAL;
  const double flown_s = 2.0 * std::max(0.0, v_z_mps) / gravity_mps2;
  const double left_m = distance_m - v_h_mps * flown_s;
  if (left_m <= 0.0) return distance_m / v_h_mps;
  const double rolling_mps = kRollingShare * v_h_mps;
  const double touch_mps = floor.friction_ratio * (1.0 + floor.restitution_ratio) * std::max(0.0, v_z_mps);
  const double v_mps = std::max(rolling_mps, v_h_mps - touch_mps);
  const double sliding_mps2 = floor.friction_ratio * gravity_mps2;
  const double slides_m =
      sliding_mps2 > 0.0 ? (v_mps * v_mps - rolling_mps * rolling_mps) / (2.0 * sliding_mps2) : HUGE_VAL;
  if (left_m <= slides_m) return flown_s + slowed_time_s(v_mps, left_m, sliding_mps2);
  return flown_s + (v_mps - rolling_mps) / sliding_mps2 +
         slowed_time_s(rolling_mps, left_m - slides_m, floor.rolling_deceleration_mps2);
}

}  // namespace trivela::kicking
