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

/// Slides for dt [s] at most. Returns what is left of it when the ball begins to roll.
double slide(BallMotion& m, const BallPhysics& ball, double drag, double dt) {
  const double speed = std::hypot(m.velocity_mps.x(), m.velocity_mps.y()), slip = speed - m.rim_mps;
  if (!(slip > 1e-9)) return dt;
  const double grip = ball.sliding_friction_ratio * ball.gravity_mps2, deceleration = grip + drag * speed * speed;
  const double time = std::min(dt, slip / (deceleration + 1.5 * grip));
  const double next = std::max(0.0, speed - deceleration * time);
  m.position_m += 0.5 * (speed + next) / speed * time * m.velocity_mps;
  m.velocity_mps *= next / speed;
  m.rim_mps = std::min(next, m.rim_mps + 1.5 * grip * time);
  return dt - time;
}

/// The velocity over ground after a touch with the floor's friction.
void grip(BallMotion& m, const BallPhysics& ball) {
  Eigen::Vector3d& v = m.velocity_mps;
  const double speed = std::hypot(v.x(), v.y());
  if (!(speed > 0.0)) return;
  const double push = ball.sliding_friction_ratio * (1.0 + ball.restitution_ratio) * std::abs(v.z());
  const double lost = std::clamp(0.4 * (speed - m.rim_mps), -push, push);
  v.x() *= (speed - lost) / speed;
  v.y() *= (speed - lost) / speed;
  m.rim_mps += 1.5 * lost;
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
    if (motion.rolling) {
      if (ball.sliding_friction_ratio > 0.0) dt_s = slide(motion, ball, drag, dt_s);
      return roll(motion, ball, drag, dt_s);
    }
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
    if (ball.sliding_friction_ratio > 0.0) grip(motion, ball);
    if (-v.z() < ball.roll_below_mps) {
      motion.rolling = true;
      v.z() = 0.0;
    } else if (ball.sliding_friction_ratio > 0.0) {
      v.z() *= -ball.restitution_ratio;
    } else {
      v = {ball.retention_ratio * v.x(), ball.retention_ratio * v.y(), -ball.restitution_ratio * v.z()};
    }
  }
}

bool at_rest(const BallMotion& motion) {
  return motion.rolling && motion.velocity_mps.x() == 0.0 && motion.velocity_mps.y() == 0.0;
}

}  // namespace trivela::sim
