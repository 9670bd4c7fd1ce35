#include "kicking/policy/predictive/lookahead_search.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/geometry/time.hpp"
#include "kicking/policy/policy_output.hpp"
#include "kicking/policy/shot.hpp"

namespace trivela::kicking {
namespace {

constexpr std::uint32_t kCyclesOfACorner = 4;  // after so many the other one is looked at, too
constexpr double kLastShare = 1.0 - 1e-3;      // of a cycle: its end is the next decision's beginning

DriveMotion settled(const PolicyConfig& config, const PolicyInput& input, const PredictiveMemory& memory) {
  DriveMotion base(input.pose, input.twist);
  if (memory.command) base.hasten(*memory.command, config, config.predictive.twist_lag_s);
  return base;
}

constexpr LearnedDecision kByHand{};

/// The settings with what was learned on top.
PredictiveConfig settings_of(PredictiveConfig settings, const LearnedDecision& decision) {
  settings.threshold *= decision.threshold_ratio;
  settings.goal_threshold *= decision.goal_threshold_ratio;
  settings.position_sd_m *= decision.position_ratio;
  settings.heading_sd_rad *= decision.heading_ratio;
  settings.speed_sd_mps *= decision.speed_ratio;
  settings.turn_rate_sd_radps *= decision.turn_rate_ratio;
  settings.hazard_per_s *= decision.hazard_ratio;
  settings.dispute_distance_m += decision.dispute_shift_m;
  settings.opponent_places = settings.opponent_places || decision.opponent_places;
  return settings;
}

StateSpread spread_of(const PredictiveConfig& config, const PolicyInput& input, const PredictiveMemory& memory) {
  return {std::hypot(config.position_sd_m, input.sd_position_m),
          std::hypot(config.heading_sd_rad, input.sd_heading_rad),
          std::hypot(config.speed_sd_mps, memory.speed_jump_mps), config.turn_rate_sd_radps};
}

}  // namespace

LookaheadSearch::LookaheadSearch(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                                 const PolicyInput& input, const PredictiveMemory& memory, const LearnedModel* learned)
    : config_(config),
      robot_(robot),
      goal_(goal),
      input_(input),
      learned_(learned != nullptr && learned->corrects() ? learned : nullptr),
      decision_(learned != nullptr ? learned->decision : kByHand),
      settings_(settings_of(config.predictive, decision_)),
      past_keeper_(weighs_keeper(config, input)),
      reach_(carry_reach(config, robot, memory)),
      start_(settled(config, input, memory)),
      spread_(spread_of(settings_, input, memory)),
      kind_count_(learned_ != nullptr ? 1 : std::min(robot.kinds(), kMostKickKinds)),
      survival_(settings_, memory.opponent),
      opponent_(memory.opponent),
      wanted_kind_(memory.lever_kind),
      way_(memory.way),
      other_style_(memory.other_style(decision_.styles)),
      dribble_mps_(dribble_mps(config, input)),
      half_width_m_(goal.clean_half_width_m(robot.ball)),
      looks_at_both_(past_keeper_ && memory.cycles_past % kCyclesOfACorner == 1),
      last_fire_after_s_(last_fire_after_s(robot, input)) {
  for (std::size_t i = 0; i < kind_count_; ++i) kinds_[i].emplace(kind_of(i, memory));
  look_at_opponents();
  ball_speed_mps_ =
      kinds_[0]->guess.exit_angle.cosine * 0.5 * (robot.table.front().speed_mps + robot.table.back().speed_mps);
}

/// The lever is on its way to the kind that it was last told, since then.
LookaheadSearch::Kind LookaheadSearch::kind_of(std::size_t i, const PredictiveMemory& memory) const {
  const RobotModel& robot = robot_.kind(i);
  Kind kind{.model{config_, robot, goal_, spread_, past_keeper_ ? input_.keeper : std::nullopt},
            .later_s = robot.delay_s - robot_.delay_s};
  kind.guess.exit_angle = Elevation(robot.exit_angle_at(0.5 * (robot.table.front().power + robot.table.back().power)));
  if (input_.lever_kind == i) return kind;
  kind.lever_s = (memory.stuck_kinds >> i & 1) != 0 ? HUGE_VAL : robot_.lever_s;
  if (memory.lever_kind == i && kind.lever_s < HUGE_VAL)
    kind.lever_s = std::max(0.0, robot_.lever_s - seconds(input_.t_ns - memory.lever_since_t_ns));
  return kind;
}

/// Where the way turns to: off the target by the style's share, towards where the robot heads.
double LookaheadSearch::aim_x_m(const Way& way, const DriveMotion& base) const {
  const double off_m = decision_.style[way.style].aim_ratio * half_width_m_;
  if (off_m == 0.0) return way.aim_x_m;
  const Eigen::Vector2d line = Eigen::Vector2d{way.aim_x_m, goal_.y_m} - base.position_m;
  const double left = base.forward.y() * line.x() - base.forward.x() * line.y();  // the target is to the right
  return std::clamp(way.aim_x_m - std::copysign(off_m, left), -half_width_m_, half_width_m_);
}

Twist LookaheadSearch::command_at(const Way& way, const DriveMotion& base) const {
  const DriveStyle& style = decision_.style[way.style];
  const Twist command = command_of(way.plan, base, config_, {aim_x_m(way, base), goal_.y_m}, dribble_mps_,
                                   robot_.transfer_exact.lateral, ball_speed_mps_, style);
  return reach_.keep(command, base.position_m, base.forward);
}

/// Cycle by cycle, as the policy itself will steer.
void LookaheadSearch::drive_for(const Way& way, DriveMotion& base, double time_s) const {
  while (time_s > 1e-6) {
    const double step_s = std::min(time_s, config_.cycle_s);
    base.step(command_at(way, base), config_, step_s);
    time_s -= step_s;
  }
}

/// What a log has of a kick ordered then: as believed now for one of this cycle, as predicted for a later one.
ShotFeatures LookaheadSearch::features(const DriveMotion& base, const PlannedShot& planned) const {
  const bool now = planned.fire_after_s <= config_.cycle_s;
  const Eigen::Vector2d ball = now ? held_ball(input_.pose, robot_) : planned.release.ball_m;
  const Twist twist = now ? input_.twist : base.twist();
  ShotFeatures shot{.p_on_target = planned.p_on_target,
                    .distance_m = (target_on_line(config_, goal_) - ball).norm(),
                    .vx_mps = twist.vx_mps,
                    .vy_mps = twist.vy_mps,
                    .omega_radps = twist.omega_radps,
                    .power = planned.shot.power,
                    .opponent_distance_m = input_.opponent_distance_m};
  if (!now && opponent_.seen) shot.opponent_distance_m = opponent_.distance_after_m(planned.fire_after_s);
  return shot;
}

PlannedShot LookaheadSearch::planned_shot(const DriveMotion& base, double fire_after_s, bool now, double least) {
  PlannedShot best;
  bool found = false;
  for (std::size_t i = 0; i < kind_count_; ++i) {
    const bool stands = now ? input_.lever_kind == i : fire_after_s >= kinds_[i]->lever_s;
    if (!stands) continue;
    const PlannedShot shot = shot_of(static_cast<std::uint8_t>(i), base, fire_after_s, least);
    if (!found || worth(shot) > worth(best)) best = shot;
    found = true;
  }
  if (!found) best = {.fire_after_s = fire_after_s, .release = base.release(robot_.ball_offset_m)};
  return best;
}

/// The distance of the nearest is watched for longer than its place.
void LookaheadSearch::look_at_opponents() {
  if (!settings_.opponent_places) return;
  const Eigen::Vector2d ball_m = held_ball(input_.pose, robot_);
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < input_.opponent_count; ++i) {
    const BodyPlace& place = input_.opponents[i];
    const Eigen::Vector2d apart_m = place.position_m - ball_m;
    const double distance_m = apart_m.norm();
    if (!(distance_m > 0.0)) continue;
    bodies_[body_count_] = {apart_m / distance_m, distance_m, place.closing_mps, place.sd_m};
    if (distance_m < bodies_[nearest].distance_m) nearest = body_count_;
    ++body_count_;
  }
  if (body_count_ > 0 && opponent_.seen) bodies_[nearest].closing_mps = opponent_.closing_mps;
}

/// Probability that no opponent is in the way.
double LookaheadSearch::passes(const PlannedShot& planned, double release_after_s) const {
  if (body_count_ == 0) {
    if (!opponent_.seen) return 1.0;
    return 1.0 - decision_.blocking_ratio *
                     p_blocked(settings_, opponent_.distance_after_m(release_after_s), planned.shot, robot_.ball);
  }
  const KickExit& exit = planned.shot.exit;
  const ReleaseState& release = planned.release;
  const CrossingSpread& crossing = planned.shot.crossing;
  const double way_m = std::hypot(crossing.x_m - release.ball_m.x(), goal_.y_m - release.ball_m.y());
  const KickPath path{
      .velocity_mps = exit.v_kick_mps * exit.exit_angle.cosine * release.forward +
                      release.carried_mps(robot_.kind(planned.kind).transfer_exact, robot_.ball_offset_m),
      .v_z_mps = exit.v_kick_mps * exit.exit_angle.sine,
      .sd_rad = crossing.sd_x_m / std::max(0.1, way_m)};
  const Body body{settings_.opponent_radius_m, settings_.opponent_height_m};
  double p = 1.0;
  for (std::size_t i = 0; i < body_count_; ++i) {
    const Opponent& other = bodies_[i];
    const double then_m =
        std::max(settings_.dispute_distance_m, other.distance_m - other.closing_mps * release_after_s);
    p *= 1.0 - decision_.blocking_ratio * p_in_the_way(then_m * other.bearing, other.sd_m, path, body, robot_.ball);
  }
  return p;
}

PlannedShot LookaheadSearch::shot_of(std::uint8_t kind, const DriveMotion& base, double fire_after_s, double least) {
  PlannedShot out{.fire_after_s = fire_after_s, .kind = kind, .release = base.release(robot_.ball_offset_m)};
  Kind& of = *kinds_[kind];
  if (of.later_s != 0.0) {
    DriveMotion later = base;
    later.coast(of.later_s);
    out.release = later.release(robot_.ball_offset_m);
  }
  if (!may_shoot_from(config_, out.release.ball_m.y())) return out;
  if (learned_) least = 0.0;  // which may raise it
  out.shot = of.model.chance(out.release, of.guess, least);
  out.p_on_target = out.shot.p;
  out.p_goal = out.shot.p_goal;
  if (!(out.shot.p > 0.0) || (least > 0.0 && chance(out) <= least)) return out;
  const double passed = passes(out, fire_after_s + robot_.delay_s + of.later_s);
  out.p_on_target *= passed;
  out.p_goal *= passed;
  if (learned_) out.p_on_target = learned_->p_on_target(features(base, out));
  return out;
}

/// While the lever moves nothing can be fired, which no instant looks at by itself.
double LookaheadSearch::worth(const PlannedShot& planned) const {
  return (planned.kind == wanted_kind_ ? 1.0 : decision_.lever_worth) * chance(planned);
}

double LookaheadSearch::value(const PlannedShot& planned, double survival) const {
  const double p = chance(planned);
  return p >= (past_keeper_ ? settings_.goal_threshold : settings_.threshold) ? survival * worth(planned) : 0.0;
}

/// The plans part where their commands do.
void LookaheadSearch::go_on(Ways& ways, double time_s) const {
  std::array<Twist, kDrivePlans.size()> commands;
  for (std::size_t i = 0; i < kDrivePlans.size(); ++i) {
    Way way = ways.candidates[0].way;
    way.plan = kDrivePlans[i];
    commands[i] = command_at(way, ways.bases[std::min(i, ways.count - 1)]);
    if (i < ways.count || commands[i].omega_radps == commands[0].omega_radps) continue;
    ways.bases[i] = ways.bases[0];
    ways.candidates[i] = ways.candidates[0];
    ways.candidates[i].way.plan = kDrivePlans[i];
    ways.count = i + 1;
  }
  for (std::size_t i = 0; i < ways.count; ++i) ways.bases[i].step(commands[i], config_, time_s);
}

void LookaheadSearch::look_at_this_cycle(Ways& ways) {
  for (double left_s = robot_.delay_s; left_s > 1e-6; left_s -= config_.cycle_s)
    go_on(ways, std::min(left_s, config_.cycle_s));
  const double half_s = 0.5 * config_.cycle_s;
  for (std::size_t instant = 0; instant < 3; ++instant) {
    const double fire_after_s = static_cast<double>(instant) * half_s;
    if (instant > 0) go_on(ways, half_s);
    for (std::size_t i = 0; i < ways.count; ++i) {
      const PlannedShot shot = planned_shot(ways.bases[i], fire_after_s, true);
      ways.candidates[i].values[instant] = value(shot, survival_(fire_after_s));
      if (instant == 0) ways.candidates[i].now = shot;
    }
  }
  for (CandidateWay& candidate : ways.candidates) {
    candidate.value_now = std::max({candidate.values[0], candidate.values[1], candidate.values[2]});
    candidate.value_later = config_.cycle_s <= last_fire_after_s_ ? candidate.values[2] : 0.0;
    candidate.kind_later = candidate.now.kind;
    candidate.later_s = config_.cycle_s;
  }
}

/// Until nothing can be worth more than the best any more.
void LookaheadSearch::look_ahead(Ways& ways) {
  double best = std::max(ways.candidates[0].value(), ways.candidates[ways.count - 1].value());
  const double horizon_s = std::min(settings_.horizon_s, last_fire_after_s_);
  for (double fire_after_s = config_.cycle_s + settings_.step_s; fire_after_s <= horizon_s;
       fire_after_s += settings_.step_s) {
    const double survival = survival_(fire_after_s);
    if (survival <= best) return;
    go_on(ways, settings_.step_s);
    for (std::size_t i = 0; i < ways.count; ++i) {
      const double least = ways.candidates[i].value_later / survival;
      const PlannedShot shot = planned_shot(ways.bases[i], fire_after_s, false, least);
      ways.candidates[i].see_later(value(shot, survival), fire_after_s, shot.kind);
      best = std::max(best, ways.candidates[i].value_later);
    }
  }
}

/// The vertex of the parabola through the three values, where there is one; the end of the cycle belongs to the next
/// decision.
void LookaheadSearch::schedule(CandidateWay& candidate) {
  const auto [first, middle, last] = candidate.values;
  const double bend = first - 2.0 * middle + last;
  double share = first >= last ? 0.0 : 1.0;
  if (bend < 0.0) share = std::clamp(0.5 - 0.25 * (last - first) / bend, 0.0, 1.0);
  const double fire_after_s = std::min(share, kLastShare) * config_.cycle_s;
  DriveMotion base = start_;
  drive_for(candidate.way, base, robot_.delay_s + fire_after_s);
  candidate.now = planned_shot(base, fire_after_s, true);
  candidate.value_now = value(candidate.now, survival_(fire_after_s));
}

CandidateWay LookaheadSearch::best_to(double aim_x_m, std::size_t style) {
  Ways ways{{start_, start_}};
  ways.candidates[0].way.style = style;
  ways.candidates[0].way.aim_x_m = aim_x_m;
  look_at_this_cycle(ways);
  look_ahead(ways);
  std::size_t best = 0;
  for (std::size_t i = 1; i < ways.count; ++i) {
    if (ways.candidates[i].value() > ways.candidates[best].value() + decision_.switch_margin) best = i;
  }
  return ways.candidates[best];
}

bool LookaheadSearch::fires(const CandidateWay& candidate) const {
  if (!(candidate.value_now > 0.0)) return false;
  const std::array<double, kFireFeatures> features{1.0,
                                                   chance(candidate.now),
                                                   std::abs(start_.omega_radps) / config_.max_turn_rate_radps,
                                                   candidate.later_s,
                                                   1.0 - survival_(0.1),
                                                   (goal_.y_m - start_.position_m.y()) / 6.0 - 1.0};
  double sum = 0.0;
  for (std::size_t i = 0; i < features.size(); ++i) sum += decision_.fire_weights[i] * features[i];
  return candidate.value_now * std::exp(sum) >= candidate.value_later;
}

CandidateWay LookaheadSearch::best() {
  CandidateWay chosen = best_to(way_.aim_x_m, way_.style);
  const auto look_at = [&](double aim_x_m, std::size_t style) {
    const CandidateWay other = best_to(aim_x_m, style);
    if (other.value() > chosen.value() + decision_.switch_margin) chosen = other;
  };
  if (looks_at_both_) look_at(-way_.aim_x_m, way_.style);
  if (other_style_ != way_.style) look_at(way_.aim_x_m, other_style_);
  chosen.fires = fires(chosen);
  if (chosen.fires) {
    schedule(chosen);
    chosen.fires = fires(chosen);
  }
  return chosen;
}

}  // namespace trivela::kicking
