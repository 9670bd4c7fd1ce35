#include "sim/shot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trivela::sim {

double margin_m(const Crossing& crossing, const kicking::Goal& goal, const kicking::Ball& ball) {
  constexpr double kBeyond_m = 1e-9;
  const auto here = kicking::classify(crossing.x_m, crossing.z_m, goal, ball);
  double margin = std::numeric_limits<double>::infinity();
  const auto consider = [&](double x, double z, double distance) {
    if (kicking::classify(x, z, goal, ball) != here) margin = std::min(margin, std::abs(distance));
  };
  for (const double edge : {goal.clean_half_width_m(ball), goal.wide_half_width_m(ball)}) {
    for (const double x : {-edge, edge}) {
      const double beyond = crossing.x_m < x ? kBeyond_m : -kBeyond_m;
      consider(x + beyond, crossing.z_m, crossing.x_m - x);
    }
  }
  for (const double z : {goal.clean_height_m(ball), goal.over_height_m(ball)}) {
    const double beyond = crossing.z_m < z ? kBeyond_m : -kBeyond_m;
    consider(crossing.x_m, z + beyond, crossing.z_m - z);
  }
  return margin;
}

}  // namespace trivela::sim
