#include "sim/shot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kicking/geometry/time.hpp"

namespace trivela::sim {

namespace {

constexpr std::int64_t kNear_ns = 1'000'000;  // step beside an opponent: a centimetre of the ball's way

kicking::Ball ball_of(const BallPhysics& ball) { return {.mass_kg = ball.mass_kg, .radius_m = ball.radius_m}; }

bool touched_floor(const BallMotion& motion) { return motion.bounced || motion.rolling; }

/// How far along y a rolling ball still goes; without end in the air, where its fall decides nothing about the line.
double reach_y_m(const BallMotion& motion, const BallPhysics& ball) {
  if (!motion.rolling || ball.rolling_deceleration_mps2 <= 0.0) return HUGE_VAL;
  const double speed = std::hypot(motion.velocity_mps.x(), motion.velocity_mps.y());
  return 0.5 * speed * std::abs(motion.velocity_mps.y()) / ball.rolling_deceleration_mps2;
}

}  // namespace

Shot::Shot(const Scenario& scenario, const BallMotion& released, std::int64_t t_ns, const kicking::Draws& draws)
    : scenario_(scenario),
      draws_(draws),
      released_(released),
      ball_(released),
      release_t_ns_(t_ns),
      t_ns_(t_ns),
      farthest_y_m_(released.position_m.y()) {
  if (released.position_m.y() >= scenario.field.goal_line_y_m) meet_goal_plane(t_ns);
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
  farthest_y_m_ = std::max(farthest_y_m_, ball_.position_m.y());
  if (scenario_.defenders.count > 0.0) meet_defenders(before, before_t_ns, dt_s);
  if (result_) return;
  if (scenario_.keeper.enabled && scenario_.keeper.advance_m > 0.0) meet_keeper_before_line(before, before_t_ns, dt_s);
  if (result_) return;
  if (ball_.position_m.y() >= scenario_.field.goal_line_y_m) {
    double until_s = dt_s;
    ball_ = at_line(before, scenario_.field.goal_line_y_m, dt_s, until_s);
    meet_goal_plane(before_t_ns + kicking::nanoseconds(until_s));
    return sim::advance(ball_, scenario_.ball, dt_s - until_s);
  }
  for (const OpponentBody& body : opponents) {
    if (!result_) meet_opponent(body.position(), t_ns);
  }
  const double age_s = kicking::seconds(t_ns - release_t_ns_);
  if (!result_ && (at_rest(ball_) || age_s >= scenario_.possession.flight_limit_s)) settle_short(t_ns);
}

/// The ball where, within the step from `before`, it reaches a plane of constant y, `until_s` after `before`: the
/// secant from both ends, which a nearly straight way meets at once.
BallMotion Shot::at_line(const BallMotion& before, double line_y_m, double dt_s, double& until_s) const {
  const auto after = [&](double t_s) {
    BallMotion ball = before;
    sim::advance(ball, scenario_.ball, t_s);
    return ball;
  };
  double low_s = 0.0, low = before.position_m.y() - line_y_m, high = ball_.position_m.y() - line_y_m;
  until_s = dt_s;
  for (int i = 0; i < 8 && high - low > 0.0; ++i) {
    const double middle_s = low_s - low * (until_s - low_s) / (high - low);
    BallMotion middle = after(middle_s);
    const double y = middle.position_m.y() - line_y_m;
    if (std::abs(y) < 1e-9) {
      until_s = middle_s;
      return middle;
    }
    (y < 0.0 ? low_s : until_s) = middle_s;
    (y < 0.0 ? low : high) = y;
  }
  return after(until_s);
}

void Shot::meet_goal_plane(std::int64_t t_ns) {
  const kicking::Goal goal = goal_of(scenario_.field);
  const kicking::Ball ball = ball_of(scenario_.ball);
  const Crossing crossing{ball_.position_m.x(), ball_.position_m.z()};
  const auto outcome = kicking::classify(crossing.x_m, crossing.z_m, goal, ball);
  const double margin = std::min(sim::margin_m(crossing, goal, ball), reach_y_m(ball_, scenario_.ball));
  const bool saved = outcome == kicking::Outcome::kOnTarget && scenario_.keeper.advance_m == 0.0 &&
                     keeper_has(crossing, kicking::seconds(t_ns - release_t_ns_));
  result_ = ShotResult{t_ns, outcome, crossing, margin, saved, touched_floor(ball_)};
  if (saved || outcome == kicking::Outcome::kPost || outcome == kicking::Outcome::kBar) {
    const double kept = saved ? scenario_.ball.body_restitution_ratio : scenario_.ball.frame_restitution_ratio;
    const Eigen::Vector3d& v = ball_.velocity_mps;
    ball_.velocity_mps = {kept * v.x(), -kept * std::abs(v.y()), kept * v.z()};
  }
}

Misjudgement Shot::keeper_misjudges() const {
  const auto noise = draws_.normals(kicking::Role::kKeeper, 0);
  Misjudgement misjudged{noise[0], noise[1]};
  const double guess_m = scenario_.keeper.guess_m;
  if (guess_m > 0.0)
    misjudged.guessed_m = keeper_place(scenario_, released_.position_m).x_m + std::copysign(guess_m, noise[2]);
  return misjudged;
}

bool Shot::keeper_has(const Crossing& crossing, double flown_s) const {
  const Keeper& keeper = scenario_.keeper;
  if (!keeper.enabled) return false;
  return guard_stops(keeper.guard, {keeper.side_extension_m, keeper.up_extension_m, keeper.extension_s},
                     keeper_place(scenario_, released_.position_m).x_m, {crossing, flown_s, scenario_.ball.radius_m},
                     keeper_misjudges());
}

std::optional<PlanPoint> Shot::jumping_keeper(std::int64_t t_ns) const {
  if (!scenario_.keeper.enabled || scenario_.keeper.guess_m == 0.0) return std::nullopt;
  PlanPoint place = keeper_place(scenario_, released_.position_m);
  const double until_s = kicking::seconds(t_ns - release_t_ns_);
  if (!jump_ || until_s < jump_->motion.t_s) jump_ = Jump{*keeper_misjudges().guessed_m, {place.x_m}};
  place.x_m = jumped_place_m(scenario_.keeper.guard, jump_->aim_m, until_s, jump_->motion);
  return place;
}

/// What the ball would come to if nobody stood in its way; none: not into the goal.
std::optional<ShotResult> Shot::would_go_in(BallMotion ball) const {
  constexpr double kFurther_s = 0.02;
  const double goal_y_m = scenario_.field.goal_line_y_m;
  for (double t_s = 0.0; t_s < scenario_.possession.flight_limit_s && !at_rest(ball); t_s += kFurther_s) {
    const BallMotion before = ball;
    sim::advance(ball, scenario_.ball, kFurther_s);
    if (ball.position_m.y() < goal_y_m) continue;
    const double way_m = ball.position_m.y() - before.position_m.y();
    ball = before;
    sim::advance(ball, scenario_.ball, kFurther_s * (goal_y_m - before.position_m.y()) / way_m);
    const kicking::Goal goal = goal_of(scenario_.field);
    const kicking::Ball size = ball_of(scenario_.ball);
    const Crossing crossing{ball.position_m.x(), ball.position_m.z()};
    if (kicking::classify(crossing.x_m, crossing.z_m, goal, size) != kicking::Outcome::kOnTarget) return std::nullopt;
    const double margin = std::min(sim::margin_m(crossing, goal, size), reach_y_m(ball, scenario_.ball));
    return ShotResult{0, kicking::Outcome::kOnTarget, crossing, margin, true, touched_floor(ball)};
  }
  return std::nullopt;
}

void Shot::meet_keeper_before_line(const BallMotion& before, std::int64_t before_t_ns, double dt_s) {
  const double line_y_m = scenario_.field.goal_line_y_m - scenario_.keeper.advance_m;
  if (before.position_m.y() >= line_y_m || ball_.position_m.y() < line_y_m) return;
  double until_s = dt_s;
  const BallMotion there = at_line(before, line_y_m, dt_s, until_s);
  const std::int64_t t_ns = before_t_ns + kicking::nanoseconds(until_s);
  const Crossing passes{there.position_m.x(), there.position_m.z()};
  if (!keeper_has(passes, kicking::seconds(t_ns - release_t_ns_))) return;
  result_ = would_go_in(there);
  if (!result_) return;
  result_->t_ns = t_ns;
  ball_ = there;
  ball_.velocity_mps.y() *= -scenario_.ball.body_restitution_ratio;
  sim::advance(ball_, scenario_.ball, dt_s - until_s);
}

PlanPoint keeper_place(const Scenario& scenario, const Eigen::Vector3d& ball_m) {
  const double goal_y_m = scenario.field.goal_line_y_m, advance_m = scenario.keeper.advance_m;
  if (advance_m == 0.0) return {0.0, goal_y_m};
  return {ball_m.x() * advance_m / std::max(goal_y_m - ball_m.y(), advance_m), goal_y_m - advance_m};
}

PlanPoint defender_place(const Scenario& scenario, const kicking::Draws& draws, const Eigen::Vector3d& ball_m,
                         std::uint32_t i) {
  const Defenders& defenders = scenario.defenders;
  const double goal_y_m = scenario.field.goal_line_y_m;
  const double middle_x_m = ball_m.x() * defenders.line_distance_m / (goal_y_m - ball_m.y());
  return {middle_x_m + defenders.spread_sd_m * draws.normals(kicking::Role::kDefender, 0, i)[2],
          goal_y_m - defenders.line_distance_m};
}

void Shot::meet_defenders(const BallMotion& before, std::int64_t before_t_ns, double dt_s) {
  const Defenders& defenders = scenario_.defenders;
  const double goal_y_m = scenario_.field.goal_line_y_m, line_y_m = goal_y_m - defenders.line_distance_m;
  if (before.position_m.y() >= line_y_m || ball_.position_m.y() < line_y_m) return;
  double until_s = dt_s;
  const BallMotion there = at_line(before, line_y_m, dt_s, until_s);
  const std::int64_t t_ns = before_t_ns + kicking::nanoseconds(until_s);
  const GuardedBall ball{
      {there.position_m.x(), there.position_m.z()}, kicking::seconds(t_ns - release_t_ns_), scenario_.ball.radius_m};
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(defenders.count); ++i) {
    const auto noise = draws_.normals(kicking::Role::kDefender, 0, i);
    const double place_m = defender_place(scenario_, draws_, released_.position_m, i).x_m;
    if (!guard_stops(defenders.guard, {}, place_m, ball, {noise[0], noise[1]})) continue;
    ball_ = there;
    ball_.velocity_mps.y() *= -scenario_.ball.body_restitution_ratio;
    block(t_ns);
    return sim::advance(ball_, scenario_.ball, dt_s - until_s);
  }
}

void Shot::block(std::int64_t t_ns) {
  result_ = ShotResult{t_ns, kicking::Outcome::kBlocked, std::nullopt, std::nullopt, false, touched_floor(ball_)};
}

/// The ball comes within reach of the opponent in the next dt_s: its way over the floor is straight.
bool Shot::passes(const PlanPoint& opponent, double dt_s) const {
  const Eigen::Vector3d &p = ball_.position_m, &v = ball_.velocity_mps;
  const double dx = opponent.x_m - p.x(), dy = opponent.y_m - p.y();
  const double ahead = v.x() * dx + v.y() * dy;  // times the speed
  if (ahead <= 0.0) return false;
  const double square = v.x() * v.x() + v.y() * v.y(),
               reach = scenario_.opponent.body_radius_m + scenario_.ball.radius_m;
  const double aside = v.x() * dy - v.y() * dx;
  if (aside * aside >= reach * reach * square) return false;
  const double near = reach + std::sqrt(square) * dt_s;
  return dx * dx + dy * dy < near * near;
}

void Shot::meet_opponent(const PlanPoint& opponent, std::int64_t t_ns) {
  const double dx = ball_.position_m.x() - opponent.x_m, dy = ball_.position_m.y() - opponent.y_m;
  const double reach = scenario_.opponent.body_radius_m + scenario_.ball.radius_m;
  const double distance = std::sqrt(dx * dx + dy * dy);
  if (distance >= reach || ball_.position_m.z() - scenario_.ball.radius_m >= scenario_.opponent.body_height_m) return;
  Eigen::Vector3d& v = ball_.velocity_mps;
  const double inward = distance > 0.0 ? -(v.x() * dx + v.y() * dy) / distance : 0.0;
  if (inward <= 0.0) return;  // leaving it already
  const double push = (1.0 + scenario_.ball.body_restitution_ratio) * inward / distance;
  v.x() += push * dx;
  v.y() += push * dy;
  block(t_ns);
}

void Shot::settle_short(std::int64_t t_ns) {
  result_ = ShotResult{t_ns,  kicking::Outcome::kShort, std::nullopt, scenario_.field.goal_line_y_m - farthest_y_m_,
                       false, touched_floor(ball_)};
}

}  // namespace trivela::sim
