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

void drive(const Guard& guard, GuardMotion& motion, double aim_m, double dt_s) {
  const double way_m = aim_m - motion.x_m;
  const double fastest_mps =
      std::min({guard.speed_mps, std::sqrt(2.0 * guard.acceleration_mps2 * std::abs(way_m)), std::abs(way_m) / dt_s});
  const double change_mps = guard.acceleration_mps2 * dt_s;
  const double next_mps =
      std::clamp(std::copysign(fastest_mps, way_m), motion.v_mps - change_mps, motion.v_mps + change_mps);
  motion.x_m += 0.5 * (motion.v_mps + next_mps) * dt_s;
  motion.v_mps = next_mps;
}

double place_at(const Guard& guard, double start_x_m, const GuardedBall& ball, const Misjudgement& misjudged,
                double until_s) {
  if (misjudged.guessed_m) {
    GuardMotion jump{start_x_m};
    return jumped_place_m(guard, *misjudged.guessed_m, until_s, jump);
  }
  GuardMotion motion{start_x_m};
  for (double t_s = guard.reaction_s; t_s < until_s; t_s += kStep_s) {
    const double aim_m = ball.crossing.x_m + misjudged.sideways * error_m(guard, ball, t_s);
    drive(guard, motion, aim_m, std::min(kStep_s, until_s - t_s));
  }
  return motion.x_m;
}

}  // namespace

double jumped_place_m(const Guard& guard, double aim_m, double until_s, GuardMotion& jump) {
  for (; until_s - jump.t_s >= kStep_s; jump.t_s += kStep_s) drive(guard, jump, aim_m, kStep_s);
  GuardMotion last = jump;
  if (last.t_s < until_s) drive(guard, last, aim_m, until_s - last.t_s);
  return last.x_m;
}

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
