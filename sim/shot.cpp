#include "sim/shot.hpp"

#include <algorithm>
#include <cmath>

#include "sim/margin.hpp"

namespace trivela::sim {
namespace {

kicking::Goal goal_of(const Field& field) {
  return {.y_m = field.goal_line_y_m,
          .half_width_m = field.goal_half_width_m,
          .height_m = field.goal_height_m,
          .post_width_m = field.frame_thickness_m};
}

kicking::Ball ball_of(const Ball& ball) { return {.mass_kg = ball.mass_kg, .radius_m = ball.radius_m}; }

/// How far along y a rolling ball still goes; without end in the air, where its fall decides nothing about the line.
double reach_y_m(const BallMotion& motion, const Ball& ball) {
  if (!motion.rolling || ball.rolling_deceleration_mps2 <= 0.0) return HUGE_VAL;
  const double speed = std::hypot(motion.velocity_mps.x, motion.velocity_mps.y);
  return 0.5 * speed * std::abs(motion.velocity_mps.y) / ball.rolling_deceleration_mps2;
}

}  // namespace

Shot::Shot(const Scenario& scenario, const BallMotion& released, std::int64_t t_ns)
    : scenario_(scenario),
      released_(released),
      ball_(released),
      release_t_ns_(t_ns),
      t_ns_(t_ns),
      farthest_y_m_(released.position_m.y) {
  if (released.position_m.y >= scenario.field.goal_line_y_m) meet_goal_plane(released.position_m, t_ns);
}

void Shot::advance_to(std::int64_t t_ns, const PlanPoint& opponent) {
  const Vec3 before = ball_.position_m;
  sim::advance(ball_, scenario_.ball, static_cast<double>(t_ns - t_ns_) * 1e-9);
  t_ns_ = t_ns;
  if (result_) return;
  farthest_y_m_ = std::max(farthest_y_m_, ball_.position_m.y);
  if (ball_.position_m.y >= scenario_.field.goal_line_y_m) return meet_goal_plane(before, t_ns);
  meet_opponent(opponent, t_ns);
  const double age_s = static_cast<double>(t_ns - release_t_ns_) * 1e-9;
  if (!result_ && (at_rest(ball_) || age_s >= scenario_.possession.flight_limit_s)) settle_short(t_ns);
}

void Shot::meet_goal_plane(const Vec3& before, std::int64_t t_ns) {
  const kicking::Goal goal = goal_of(scenario_.field);
  const kicking::Ball ball = ball_of(scenario_.ball);
  const Vec3& after = ball_.position_m;
  const double part = after.y > before.y ? std::clamp((goal.y_m - before.y) / (after.y - before.y), 0.0, 1.0) : 0.0;
  const Crossing crossing{std::lerp(before.x, after.x, part), std::lerp(before.z, after.z, part)};
  const auto outcome = kicking::classify(crossing.x_m, crossing.z_m, goal, ball);
  const double margin = std::min(sim::margin_m(crossing, goal, ball), reach_y_m(ball_, scenario_.ball));
  result_ = ShotResult{t_ns, outcome, crossing, margin};
  if (outcome == kicking::Outcome::kPost || outcome == kicking::Outcome::kBar) {
    const double kept = scenario_.ball.frame_restitution_ratio;
    const Vec3& v = ball_.velocity_mps;
    ball_.position_m = {crossing.x_m, goal.y_m, crossing.z_m};
    ball_.velocity_mps = {kept * v.x, -kept * std::abs(v.y), kept * v.z};
  }
}

void Shot::meet_opponent(const PlanPoint& opponent, std::int64_t t_ns) {
  const double dx = ball_.position_m.x - opponent.x_m, dy = ball_.position_m.y - opponent.y_m;
  const double reach = scenario_.opponent.body_radius_m + scenario_.ball.radius_m;
  const double distance = std::hypot(dx, dy);
  if (distance >= reach || ball_.position_m.z - scenario_.ball.radius_m >= scenario_.opponent.body_height_m) return;
  Vec3& v = ball_.velocity_mps;
  const double inward = distance > 0.0 ? -(v.x * dx + v.y * dy) / distance : 0.0;
  if (inward <= 0.0) return;  // leaving it already
  const double push = (1.0 + scenario_.ball.body_restitution_ratio) * inward / distance;
  v.x += push * dx;
  v.y += push * dy;
  result_ = ShotResult{t_ns, kicking::Outcome::kBlocked, std::nullopt, std::nullopt};
}

void Shot::settle_short(std::int64_t t_ns) {
  result_ = ShotResult{t_ns, kicking::Outcome::kShort, std::nullopt, scenario_.field.goal_line_y_m - farthest_y_m_};
}

}  // namespace trivela::sim
