#include "sim/flight.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trivela::sim {
namespace {

Vec3 plus(const Vec3& a, double scale, const Vec3& b) {
  return {a.x + scale * b.x, a.y + scale * b.y, a.z + scale * b.z};
}

Vec3 acceleration(const Vec3& v, double drag, double gravity) {
  const double k = -drag * std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  return {k * v.x, k * v.y, k * v.z - gravity};
}

void fly(BallMotion& m, double drag, double gravity, double dt) {
  const Vec3 v1 = m.velocity_mps, a1 = acceleration(v1, drag, gravity);
  const Vec3 v2 = plus(v1, dt / 2, a1), a2 = acceleration(v2, drag, gravity);
  const Vec3 v3 = plus(v1, dt / 2, a2), a3 = acceleration(v3, drag, gravity);
  const Vec3 v4 = plus(v1, dt, a3), a4 = acceleration(v4, drag, gravity);
  m.position_m = plus(plus(m.position_m, dt / 6, plus(v1, 2.0, v2)), dt / 6, plus(v4, 2.0, v3));
  m.velocity_mps = plus(plus(v1, dt / 6, plus(a1, 2.0, a2)), dt / 6, plus(a4, 2.0, a3));
}

void roll(BallMotion& m, const Ball& ball, double drag, double dt) {
  const double speed = std::hypot(m.velocity_mps.x, m.velocity_mps.y);
  if (speed <= 0.0) return;
  const auto at = [&](double v) { return ball.rolling_deceleration_mps2 + drag * v * v; };
  const double deceleration = at(std::max(0.0, speed - 0.5 * dt * at(speed)));  // of the middle of the step
  const double time = deceleration * dt > speed ? speed / deceleration : dt;
  const double next = std::max(0.0, speed - deceleration * time);
  m.position_m = plus(m.position_m, 0.5 * (speed + next) / speed * time, m.velocity_mps);
  m.velocity_mps = {m.velocity_mps.x * next / speed, m.velocity_mps.y * next / speed, 0.0};
  if (time < dt) m.velocity_mps = {};
}

/// Time until z falls to `height` under a constant vertical acceleration, which holds for a control cycle.
double time_to_height(const BallMotion& m, double height, double drag, double gravity) {
  const double a = -acceleration(m.velocity_mps, drag, gravity).z;
  const double fall = std::max(0.0, m.position_m.z - height), v = m.velocity_mps.z;
  return a > 0.0 ? (v + std::sqrt(v * v + 2.0 * a * fall)) / a : fall / std::max(1e-9, -v);
}

}  // namespace

double drag_per_m(const Ball& ball) {
  return ball.air_density_kgpm3 * ball.drag_coefficient * std::numbers::pi * ball.radius_m * ball.radius_m /
         (2.0 * ball.mass_kg);
}

void advance(BallMotion& motion, const Ball& ball, double dt_s) {
  const double drag = drag_per_m(ball);
  while (dt_s > 0.0) {
    if (motion.rolling) return roll(motion, ball, drag, dt_s);
    BallMotion next = motion;
    fly(next, drag, ball.gravity_mps2, dt_s);
    if (next.position_m.z >= ball.radius_m) {
      motion = next;
      return;
    }
    const double dt_floor = std::min(dt_s, time_to_height(motion, ball.radius_m, drag, ball.gravity_mps2));
    fly(motion, drag, ball.gravity_mps2, dt_floor);
    dt_s -= dt_floor;
    motion.position_m.z = ball.radius_m;
    motion.bounced = true;
    Vec3& v = motion.velocity_mps;
    if (-v.z < ball.roll_below_mps) {
      motion.rolling = true;
      v.z = 0.0;
    } else {
      v = {ball.retention_ratio * v.x, ball.retention_ratio * v.y, -ball.restitution_ratio * v.z};
    }
  }
}

bool at_rest(const BallMotion& motion) {
  return motion.rolling && motion.velocity_mps.x == 0.0 && motion.velocity_mps.y == 0.0;
}

}  // namespace trivela::sim
