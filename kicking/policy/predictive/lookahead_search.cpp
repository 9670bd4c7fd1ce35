#include "kicking/policy/predictive/lookahead_search.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/geometry/time.hpp"
#include "kicking/policy/policy_output.hpp"
#include "kicking/policy/shot.hpp"

namespace trivela::kicking {
namespace {

constexpr double kBetter = 2e-3;               // a plan must promise so much more than the one before it
constexpr std::uint32_t kCyclesOfACorner = 4;  // after so many the other one is looked at, too
constexpr double kMovesLever = 0.85;           // worth of a kick for which the lever moves first; tuned
constexpr double kLastShare = 1.0 - 1e-3;      // of a cycle: its end is the next decision's beginning

DriveMotion settled(const PolicyConfig& config, const PolicyInput& input, const PredictiveMemory& memory) {
  DriveMotion base(input.pose, input.twist);
  if (memory.command) base.hasten(*memory.command, config, config.predictive.twist_lag_s);
  return base;
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
      learned_(learned),
      past_keeper_(plays_past(config, input)),
      reach_(carry_reach(config, robot, memory)),
      start_(settled(config, input, memory)),
      spread_(spread_of(config.predictive, input, memory)),
      kind_count_(learned != nullptr ? 1 : std::min(robot.kinds(), kMostKickKinds)),
      survival_(config.predictive, memory.opponent),
      opponent_(memory.opponent),
      wanted_kind_(memory.lever_kind),
      way_(memory.way),
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

Twist LookaheadSearch::command_at(const Way& way, const DriveMotion& base) const {
  const Twist command = command_of(way.plan, base, config_, {way.aim_x_m, goal_.y_m}, dribble_mps(config_, input_),
                                   robot_.transfer_exact.lateral, ball_speed_mps_);
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
  if (!config_.predictive.opponent_places) return;
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
  const PredictiveConfig& settings = config_.predictive;
  if (body_count_ == 0) {
    if (!opponent_.seen) return 1.0;
    return 1.0 - p_blocked(settings, opponent_.distance_after_m(release_after_s), planned.shot, robot_.ball);
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
  const Body body{settings.opponent_radius_m, settings.opponent_height_m};
  double p = 1.0;
  for (std::size_t i = 0; i < body_count_; ++i) {
    const Opponent& other = bodies_[i];
    const double then_m = std::max(settings.dispute_distance_m, other.distance_m - other.closing_mps * release_after_s);
    p *= 1.0 - p_in_the_way(then_m * other.bearing, other.sd_m, path, body, robot_.ball);
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
  return (planned.kind == wanted_kind_ ? 1.0 : kMovesLever) * chance(planned);
}

double LookaheadSearch::value(const PlannedShot& planned, double survival) const {
  const double p = chance(planned);
  return p >= (past_keeper_ ? config_.predictive.goal_threshold : config_.predictive.threshold)
             ? survival * worth(planned)
             : 0.0;
}

/// The plans part where their commands do.
void LookaheadSearch::go_on(Ways& ways, double time_s) const {
  std::array<Twist, kDrivePlans.size()> commands;
  for (std::size_t i = 0; i < kDrivePlans.size(); ++i) {
    commands[i] = command_at({kDrivePlans[i], ways.candidates[0].way.aim_x_m}, ways.bases[std::min(i, ways.count - 1)]);
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
  }
}

/// Until nothing can be worth more than the best any more.
void LookaheadSearch::look_ahead(Ways& ways) {
  const PredictiveConfig& settings = config_.predictive;
  double best = std::max(ways.candidates[0].value(), ways.candidates[ways.count - 1].value());
  const double horizon_s = std::min(settings.horizon_s, last_fire_after_s_);
  for (double fire_after_s = config_.cycle_s + settings.step_s; fire_after_s <= horizon_s;
       fire_after_s += settings.step_s) {
    const double survival = survival_(fire_after_s);
    if (survival <= best) return;
    go_on(ways, settings.step_s);
    for (std::size_t i = 0; i < ways.count; ++i) {
      const double least = ways.candidates[i].value_later / survival;
      const PlannedShot shot = planned_shot(ways.bases[i], fire_after_s, false, least);
      ways.candidates[i].see_later(value(shot, survival), shot.kind);
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

CandidateWay LookaheadSearch::best_to(double aim_x_m) {
  Ways ways{{start_, start_}};
  ways.candidates[0].way.aim_x_m = aim_x_m;
  look_at_this_cycle(ways);
  look_ahead(ways);
  std::size_t best = 0;
  for (std::size_t i = 1; i < ways.count; ++i) {
    if (ways.candidates[i].value() > ways.candidates[best].value() + kBetter) best = i;
  }
  return ways.candidates[best];
}

CandidateWay LookaheadSearch::best() {
  CandidateWay chosen = best_to(way_.aim_x_m);
  if (looks_at_both_) {
    const CandidateWay other = best_to(-way_.aim_x_m);
    if (other.value() > chosen.value() + kBetter) chosen = other;
  }
  if (chosen.value_now > 0.0 && chosen.value_now >= chosen.value_later) schedule(chosen);
  return chosen;
}

}  // namespace trivela::kicking
