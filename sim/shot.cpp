#include "sim/shot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kicking/geometry/time.hpp"
#include "sim/margin.hpp"

namespace trivela::sim {
namespace {

constexpr std::int64_t kNear_ns = 1'000'000;  // step beside an opponent: a centimetre of the ball's way

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
  if (released.position_m.y >= scenario.field.goal_line_y_m) meet_goal_plane(t_ns);
}

void Shot::advance_to(std::int64_t t_ns, std::span<const OpponentBody> opponents) {
  const auto somebody_near = [&] {
    return std::ranges::any_of(
        opponents, [&](const OpponentBody& body) { return passes(body.position(), kicking::seconds(t_ns - t_ns_)); });
  };
  while (!result_ && t_ns_ < t_ns && somebody_near()) step_to(std::min(t_ns_ + kNear_ns, t_ns), opponents);
  if (t_ns_ < t_ns) step_to(t_ns, opponents);
}

void Shot::step_to(std::int64_t t_ns, std::span<const OpponentBody> opponents) {
  const BallMotion before = ball_;
  const double dt_s = kicking::seconds(t_ns - t_ns_);
  sim::advance(ball_, scenario_.ball, dt_s);
  const std::int64_t before_t_ns = std::exchange(t_ns_, t_ns);
  if (result_) return;
  farthest_y_m_ = std::max(farthest_y_m_, ball_.position_m.y);
  if (ball_.position_m.y >= scenario_.field.goal_line_y_m) {
    const double until_s = time_to_goal_s(before, dt_s);
    ball_ = before;
    sim::advance(ball_, scenario_.ball, until_s);
    meet_goal_plane(before_t_ns + std::llround(until_s * 1e9));
    return sim::advance(ball_, scenario_.ball, dt_s - until_s);
  }
  for (const OpponentBody& body : opponents) {
    if (!result_) meet_opponent(body.position(), t_ns);
  }
  const double age_s = kicking::seconds(t_ns - release_t_ns_);
  if (!result_ && (at_rest(ball_) || age_s >= scenario_.possession.flight_limit_s)) settle_short(t_ns);
}

/// When, within the step from `before`, the ball reaches the plane of the goal: the secant from both ends, which a
/// nearly straight way meets at once.
double Shot::time_to_goal_s(const BallMotion& before, double dt_s) const {
  const double line = scenario_.field.goal_line_y_m;
  double low_s = 0.0, high_s = dt_s, low = before.position_m.y - line, high = ball_.position_m.y - line;
  for (int i = 0; i < 8 && high - low > 0.0; ++i) {
    const double middle_s = low_s - low * (high_s - low_s) / (high - low);
    BallMotion middle = before;
    sim::advance(middle, scenario_.ball, middle_s);
    const double y = middle.position_m.y - line;
    if (std::abs(y) < 1e-9) return middle_s;
    (y < 0.0 ? low_s : high_s) = middle_s;
    (y < 0.0 ? low : high) = y;
  }
  return high_s;
}

void Shot::meet_goal_plane(std::int64_t t_ns) {
  const kicking::Goal goal = goal_of(scenario_.field);
  const kicking::Ball ball = ball_of(scenario_.ball);
  const Crossing crossing{ball_.position_m.x, ball_.position_m.z};
  const auto outcome = kicking::classify(crossing.x_m, crossing.z_m, goal, ball);
  const double margin = std::min(sim::margin_m(crossing, goal, ball), reach_y_m(ball_, scenario_.ball));
  const bool saved =
      outcome == kicking::Outcome::kOnTarget && keeper_has(crossing, kicking::seconds(t_ns - release_t_ns_));
  result_ = ShotResult{t_ns, outcome, crossing, margin, saved};
  if (saved || outcome == kicking::Outcome::kPost || outcome == kicking::Outcome::kBar) {
    const double kept = saved ? scenario_.ball.body_restitution_ratio : scenario_.ball.frame_restitution_ratio;
    const Vec3& v = ball_.velocity_mps;
    ball_.velocity_mps = {kept * v.x, -kept * std::abs(v.y), kept * v.z};
  }
}

bool Shot::keeper_has(const Crossing& crossing, double flown_s) const {
  const Keeper& keeper = scenario_.keeper;
  if (!keeper.enabled || crossing.z_m - scenario_.ball.radius_m >= keeper.height_m) return false;
  const double moved_m = keeper.speed_mps * std::max(0.0, flown_s - keeper.reaction_s);
  return std::abs(crossing.x_m) <= moved_m + keeper.half_width_m + scenario_.ball.radius_m;
}

/// The ball comes within reach of the opponent in the next dt_s: its way over the floor is straight.
bool Shot::passes(const PlanPoint& opponent, double dt_s) const {
  const Vec3 &p = ball_.position_m, &v = ball_.velocity_mps;
  const double dx = opponent.x_m - p.x, dy = opponent.y_m - p.y;
  const double ahead = v.x * dx + v.y * dy;  // times the speed
  if (ahead <= 0.0) return false;
  const double square = v.x * v.x + v.y * v.y, reach = scenario_.opponent.body_radius_m + scenario_.ball.radius_m;
  const double aside = v.x * dy - v.y * dx;
  if (aside * aside >= reach * reach * square) return false;
  const double near = reach + std::sqrt(square) * dt_s;
  return dx * dx + dy * dy < near * near;
}

void Shot::meet_opponent(const PlanPoint& opponent, std::int64_t t_ns) {
  const double dx = ball_.position_m.x - opponent.x_m, dy = ball_.position_m.y - opponent.y_m;
  const double reach = scenario_.opponent.body_radius_m + scenario_.ball.radius_m;
  const double distance = std::sqrt(dx * dx + dy * dy);
  if (distance >= reach || ball_.position_m.z - scenario_.ball.radius_m >= scenario_.opponent.body_height_m) return;
  Vec3& v = ball_.velocity_mps;
  const double inward = distance > 0.0 ? -(v.x * dx + v.y * dy) / distance : 0.0;
  if (inward <= 0.0) return;  // leaving it already
  const double push = (1.0 + scenario_.ball.body_restitution_ratio) * inward / distance;
  v.x += push * dx;
  v.y += push * dy;
  result_ = ShotResult{t_ns, kicking::Outcome::kBlocked, std::nullopt, std::nullopt, false};
}

void Shot::settle_short(std::int64_t t_ns) {
  result_ =
      ShotResult{t_ns, kicking::Outcome::kShort, std::nullopt, scenario_.field.goal_line_y_m - farthest_y_m_, false};
}

}  // namespace trivela::sim
