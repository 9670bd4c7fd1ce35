#include "kicking/policy/predictive/outlook.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/policy/shot.hpp"

namespace trivela::kicking {
namespace {

constexpr double kLastShare = 1.0 - 1e-3;  // of a cycle: its end is the next decision's beginning

BaseMotion settled(const PolicyConfig& config, const PolicyInput& input, const PredictiveMemory& memory) {
  BaseMotion base(input.pose, input.twist);
  if (memory.command) base.hasten(*memory.command, config, config.predictive.twist_lag_s);
  return base;
}

StateSpread spread_of(const PredictiveConfig& config, const PolicyInput& input, const PredictiveMemory& memory) {
  return {std::hypot(config.position_sd_m, input.sd_position_m),
          std::hypot(config.heading_sd_rad, input.sd_heading_rad),
          std::hypot(config.speed_sd_mps, memory.speed_jump_mps), config.turn_rate_sd_radps};
}

}  // namespace

Lookout::Lookout(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input,
                 const PredictiveMemory& memory, const LearnedModel* learned)
    : config_(config),
      robot_(robot),
      goal_(goal),
      input_(input),
      learned_(learned),
      start_(settled(config, input, memory)),
      model_(config.predictive, robot, goal, spread_of(config.predictive, input, memory)),
      survival_(config.predictive, memory.opponent),
      opponent_(memory.opponent) {
  guess_.exit_angle_rad = robot.exit_angle_at(0.5 * (robot.table.front().power + robot.table.back().power));
  ball_speed_mps_ =
      std::cos(guess_.exit_angle_rad) * 0.5 * (robot.table.front().speed_mps + robot.table.back().speed_mps);
}

Twist Lookout::command_at(const DrivePlan& plan, const BaseMotion& base) const {
  return command_of(plan, base, config_, target_on_line(config_, goal_), robot_.transfer_exact.lateral,
                    ball_speed_mps_);
}

/// Cycle by cycle, as the policy itself will steer.
void Lookout::drive_for(const DrivePlan& plan, BaseMotion& base, double time_s) const {
  while (time_s > 1e-6) {
    const double step_s = std::min(time_s, config_.cycle_s);
    base.step(command_at(plan, base), config_, step_s);
    time_s -= step_s;
  }
}

Prospect Lookout::prospect(const BaseMotion& base, double fire_after_s) {
  Prospect out{fire_after_s, {}, base.release(robot_.ball_offset_m), 0.0};
  out.shot = model_.chance(out.release, guess_);
  out.p_on_target = out.shot.p;
  if (!(out.shot.p > 0.0)) return out;
  if (learned_) {
    const Twist twist = base.twist();
    const Eigen::Vector2d line = target_on_line(config_, goal_) - out.release.ball_m;
    ShotFeatures features{.p_on_target = out.shot.p,
                          .distance_m = line.norm(),
                          .vx_mps = twist.vx_mps,
                          .vy_mps = twist.vy_mps,
                          .omega_radps = twist.omega_radps,
                          .power = out.shot.power,
                          .opponent_distance_m = {}};
    if (opponent_.seen) features.opponent_distance_m = opponent_.distance_after_m(fire_after_s);
    out.p_on_target = learned_->p_on_target(features);
  } else if (opponent_.seen) {
    out.p_on_target *= 1.0 - p_blocked(config_.predictive, opponent_.distance_after_m(fire_after_s + robot_.delay_s),
                                       out.shot, robot_.ball);
  }
  return out;
}

double Lookout::value(const Prospect& prospect, double survival) const {
  return prospect.p_on_target >= config_.predictive.threshold ? survival * prospect.p_on_target : 0.0;
}

void Lookout::schedule(Outlook& outlook) {
  const auto [first, middle, last] = outlook.values;
  const double bend = first - 2.0 * middle + last;
  double share = first >= last ? 0.0 : 1.0;
  if (bend < 0.0) share = std::clamp(0.5 - 0.25 * (last - first) / bend, 0.0, 1.0);
  const double fire_after_s = std::min(share, kLastShare) * config_.cycle_s;
  BaseMotion base = start_;
  drive_for(outlook.plan, base, robot_.delay_s + fire_after_s);
  outlook.now = prospect(base, fire_after_s);
  outlook.value_now = value(outlook.now, survival_(fire_after_s));
}

Outlook Lookout::look(const DrivePlan& plan, double enough) {
  const PredictiveConfig& settings = config_.predictive;
  Outlook outlook;
  outlook.plan = plan;
  BaseMotion base = start_;
  drive_for(plan, base, robot_.delay_s);
  outlook.now = prospect(base, 0.0);
  outlook.values[0] = value(outlook.now, 1.0);
  double fire_after_s = 0.0;
  for (std::size_t i = 1; i < outlook.values.size(); ++i) {
    fire_after_s += 0.5 * config_.cycle_s;
    base.step(command_at(plan, base), config_, 0.5 * config_.cycle_s);
    outlook.values[i] = value(prospect(base, fire_after_s), survival_(fire_after_s));
  }
  outlook.value_now = *std::max_element(outlook.values.begin(), outlook.values.end());
  outlook.value_later = outlook.values.back();
  while (fire_after_s < settings.horizon_s) {
    base.step(command_at(plan, base), config_, settings.step_s);
    fire_after_s += settings.step_s;
    const double survival = survival_(fire_after_s);
    if (survival <= std::max({enough, outlook.value_now, outlook.value_later})) break;
    outlook.value_later = std::max(outlook.value_later, value(prospect(base, fire_after_s), survival));
  }
  return outlook;
}

}  // namespace trivela::kicking
