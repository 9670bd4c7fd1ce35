#include "sim/guard.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::sim {
namespace {

constexpr double kStep_s = 0.002;

/// How far off a guard is at t_s about where the ball crosses, for an error of one standard deviation [m].
double error_m(const Guard& guard, const GuardedBall& ball, double t_s) {
  return guard.sight_sd_mps * (ball.flown_s - (t_s - guard.reaction_s));
}

double place_at(const Guard& guard, double start_x_m, const GuardedBall& ball, const Misjudgement& misjudged,
                double until_s) {
  double x_m = start_x_m, v_mps = 0.0;
  for (double t_s = misjudged.guessed_m ? 0.0 : guard.reaction_s; t_s < until_s; t_s += kStep_s) {
    const double dt_s = std::min(kStep_s, until_s - t_s);
    const double aim_m =
        misjudged.guessed_m.value_or(ball.crossing.x_m + misjudged.sideways * error_m(guard, ball, t_s));
    const double way_m = aim_m - x_m;
    const double fastest_mps =
        std::min({guard.speed_mps, std::sqrt(2.0 * guard.acceleration_mps2 * std::abs(way_m)), std::abs(way_m) / dt_s});
    const double change_mps = guard.acceleration_mps2 * dt_s;
    const double next_mps = std::clamp(std::copysign(fastest_mps, way_m), v_mps - change_mps, v_mps + change_mps);
    x_m += 0.5 * (v_mps + next_mps) * dt_s;
    v_mps = next_mps;
  }
  return x_m;
}

}  // namespace

double guard_place_m(const Guard& guard, double start_x_m, const GuardedBall& ball, const Misjudgement& misjudged) {
  return place_at(guard, start_x_m, ball, misjudged, ball.flown_s);
}

bool guard_stops(const Guard& guard, const Extension& extension, double start_x_m, const GuardedBall& ball,
                 const Misjudgement& misjudged) {
  const double x_m = guard_place_m(guard, start_x_m, ball, misjudged);
  double left_m = guard.half_width_m, right_m = guard.half_width_m, top_m = guard.height_m;
  const double decided_s = ball.flown_s - extension.out_s;
  if (decided_s >= guard.reaction_s) {
    const double error = error_m(guard, ball, decided_s);
    const double bottom_m = ball.crossing.z_m + misjudged.upwards * error - ball.radius_m;
    const double side_m = misjudged.guessed_m.value_or(ball.crossing.x_m + misjudged.sideways * error) -
                          place_at(guard, start_x_m, ball, misjudged, decided_s);
    if (bottom_m > top_m - guard.overlap_m) {
      top_m += extension.up_m;
    } else {
      (side_m < 0.0 ? left_m : right_m) += extension.side_m;
    }
  }
  const double reach_m = ball.radius_m - guard.overlap_m;
  return ball.crossing.x_m >= x_m - left_m - reach_m && ball.crossing.x_m <= x_m + right_m + reach_m &&
         ball.crossing.z_m - ball.radius_m <= top_m - guard.overlap_m;
}

}  // namespace trivela::sim
