#include "sim/kicker/flight.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::sim {
namespace {

void roll(BallMotion& m, const BallPhysics& ball, double drag, double dt) {
  const double speed = std::hypot(m.velocity_mps.x(), m.velocity_mps.y());
  if (speed <= 0.0) return;
  const auto at = [&](double v) { return ball.rolling_deceleration_mps2 + drag * v * v; };
  const double deceleration = at(std::max(0.0, speed - 0.5 * dt * at(speed)));  // of the middle of the step
  const double time = deceleration * dt > speed ? speed / deceleration : dt;
  const double next = std::max(0.0, speed - deceleration * time);
  m.position_m += 0.5 * (speed + next) / speed * time * m.velocity_mps;
  m.velocity_mps = {m.velocity_mps.x() * next / speed, m.velocity_mps.y() * next / speed, 0.0};
  if (time < dt) m.velocity_mps.setZero();
}

/// Time until z falls to `height` under a constant vertical acceleration, which holds for a control cycle.
double time_to_height(const BallMotion& m, double height, double drag, double gravity) {
  const double a = -kicking::drag_acceleration(m.velocity_mps, drag, gravity).z();
  const double fall = std::max(0.0, m.position_m.z() - height), v = m.velocity_mps.z();
  return a > 0.0 ? (v + std::sqrt(v * v + 2.0 * a * fall)) / a : fall / std::max(1e-9, -v);
}

}  // namespace

double drag_per_m(const BallPhysics& ball) {
  return kicking::drag_per_m({.mass_kg = ball.mass_kg, .radius_m = ball.radius_m},
                             {.density_kgpm3 = ball.air_density_kgpm3, .drag_coefficient = ball.drag_coefficient});
}

void advance(BallMotion& motion, const BallPhysics& ball, double dt_s) {
  const double drag = drag_per_m(ball);
  while (dt_s > 0.0) {
    if (motion.rolling) return roll(motion, ball, drag, dt_s);
    BallMotion next = motion;
    kicking::fly(next, dt_s, drag, ball.gravity_mps2);
    if (next.position_m.z() >= ball.radius_m) {
      motion = next;
      return;
    }
    const double dt_floor = std::min(dt_s, time_to_height(motion, ball.radius_m, drag, ball.gravity_mps2));
    kicking::fly(motion, dt_floor, drag, ball.gravity_mps2);
    dt_s -= dt_floor;
    motion.position_m.z() = ball.radius_m;
    motion.bounced = true;
    Eigen::Vector3d& v = motion.velocity_mps;
    if (-v.z() < ball.roll_below_mps) {
      motion.rolling = true;
      v.z() = 0.0;
    } else {
      v = {ball.retention_ratio * v.x(), ball.retention_ratio * v.y(), -ball.restitution_ratio * v.z()};
    }
  }
}

bool at_rest(const BallMotion& motion) {
  return motion.rolling && motion.velocity_mps.x() == 0.0 && motion.velocity_mps.y() == 0.0;
}

}  // namespace trivela::sim
