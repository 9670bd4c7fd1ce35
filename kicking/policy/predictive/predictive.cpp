#include "kicking/policy/predictive/predictive.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/policy/policy_output.hpp"
#include "kicking/policy/predictive/lookahead_search.hpp"

namespace trivela::kicking {
namespace {

/// How much faster the twist changed than the base can: the velocity filter still follows a jump.
double speed_jump(const PolicyConfig& config, const PolicyInput& input, const PredictiveMemory& memory) {
  if (!memory.twist) return 0.0;
  const double change =
      std::hypot(input.twist.vx_mps - memory.twist->vx_mps, input.twist.vy_mps - memory.twist->vy_mps);
  const double turned =
      config.max_turn_rate_radps * config.cycle_s * std::hypot(input.twist.vx_mps, input.twist.vy_mps);
  const double possible = config.max_brake_mps2 * config.cycle_s + turned + 2.0 * config.predictive.speed_sd_mps;
  return std::max(0.0, change - possible);
}

void describe_shot(PolicyOutput& output, const PlannedShot& now, bool past_keeper, const RobotModel& robot,
                   const Goal& goal) {
  if (!(now.shot.exit.v_kick_mps > 0.0)) return;
  const CrossingSpread& crossing = now.shot.crossing;
  output.target_z_m = now.shot.aim_height_m;
  output.v_kick_mps = now.shot.exit.v_kick_mps;
  output.power = now.shot.power;
  output.kick_kind = now.kind;
  output.v0_mps = crossing_speed({output.distance_m, now.shot.aim_height_m - robot.ball.radius_m},
                                 now.shot.exit.exit_angle.angle_rad);
  output.p_on_target = now.p_on_target;
  if (past_keeper) output.p_goal = now.p_goal;
  output.fire_after_s = now.fire_after_s;
  if (!std::isfinite(crossing.x_m)) return;
  output.predicted =
      PredictedCrossing{.x_m = crossing.x_m,
                        .z_m = crossing.z_m,
                        .t_flight_s = crossing.t_flight_s,
                        .release_m = now.release.ball_m,
                        .release_heading_rad = std::atan2(-now.release.forward.x(), now.release.forward.y())};
  output.offset_right_m = crossing.x_m - output.target_x_m;
  output.aligned = std::abs(crossing.x_m) < goal.clean_half_width_m(robot.ball);
}

Reason reason_of(const CandidateWay& best) {
  if (best.now.shot.out_of_range && !(best.value_later > 0.0)) return Reason::kOutOfRange;
  if (best.fires) return Reason::kFire;
  return best.value() > 0.0 ? Reason::kWaiting : Reason::kUnlikely;
}

PolicyOutput evaluate_by(const LearnedModel* learned, const PolicyConfig& config, const RobotModel& robot,
                         const Goal& goal, const PolicyInput& input, PredictiveMemory& own) {
  const bool past_keeper = weighs_keeper(config, input);
  const bool pending = order_pending(config, input, own);
  if (!pending) {
    own.cycles_past = plays_past(config, input) ? own.cycles_past + 1 : 0;
    if (own.cycles_past <= 1) own.way.aim_x_m = target_past(config, robot, goal, input, own).x();
  }
  own.watch_lever(robot, input);
  LookaheadSearch search(config, robot, goal, input, own, learned);
  CandidateWay best{};
  if (pending) {
    best.way = own.way;  // the kick was reckoned with this way of driving
  } else {
    best = search.best();
    ++own.cycles_searched;
    own.way = best.way;
    own.want_lever(best.value() > 0.0 ? best.kind() : own.lever_kind, input.t_ns);
  }
  PolicyOutput output = describe(config, goal, {});
  output.target_x_m = best.way.aim_x_m;
  output.distance_m = (Eigen::Vector2d{output.target_x_m, goal.y_m} - held_ball(input.pose, robot)).norm();
  output.left_m = output.right_m = goal.clean_half_width_m(robot.ball);
  describe_shot(output, best.now, past_keeper, robot, goal);
  output.lever_kind = own.lever_kind;
  output.drive = search.command(best.way);
  own.command = output.drive;
  output.reason = pending ? Reason::kOrderPending : reason_of(best);
  return output;
}

}  // namespace

void PredictiveMemory::want_lever(std::uint8_t kind, std::int64_t t_ns) {
  if (kind == lever_kind) return;
  lever_kind = kind;
  lever_since_t_ns = t_ns;
}

void PredictiveMemory::watch_lever(const RobotModel& robot, const PolicyInput& input) {
  if (lever_since_t_ns == 0) {  // the possession begins: it is wanted where it stands
    lever_since_t_ns = input.t_ns;
    if (input.lever_kind < robot.kinds()) lever_kind = input.lever_kind;
  }
  const double told_s = seconds(input.t_ns - lever_since_t_ns);
  if (lever_kind == 0 || input.lever_kind == lever_kind || told_s < 2.0 * robot.lever_s + 0.2) return;
  stuck_kinds |= static_cast<std::uint8_t>(1u << lever_kind);
}

void PredictiveMemory::watch(const PolicyConfig& config, const PolicyInput& input) {
  opponent.update(config.predictive, input.t_ns, input.playing, input.opponent_distance_m, input.opponent_closing_mps);
  speed_jump_mps = speed_jump(config, input, *this);
  twist = input.twist;
}

PolicyOutput evaluate_predictive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                                 const PolicyInput& input, PredictiveMemory& memory) {
  return evaluate_by(nullptr, config, robot, goal, input, memory);
}

PolicyOutput evaluate_learned(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                              const PolicyInput& input, PredictiveMemory& memory) {
  return evaluate_by(config.learned ? &*config.learned : nullptr, config, robot, goal, input, memory);
}

}  // namespace trivela::kicking
