#include "robot/decision/decision_message.hpp"

#include <algorithm>
#include <cmath>

#include "idl/none.hpp"

namespace trivela::robot {
namespace {

static_assert(int{msg::REASON_FIRE} == int(kicking::Reason::kFire));
static_assert(int{msg::REASON_STALE_STATE} == int(kicking::Reason::kStaleState));
static_assert(int{msg::REASON_DRIVE_FINISHED} == int(kicking::Reason::kDriveFinished));
static_assert(int{msg::REASON_WAITING} == int(kicking::Reason::kWaiting));

}  // namespace

msg::Policy to_wire(kicking::PolicyName policy) { return static_cast<msg::Policy>(policy); }
msg::DecisionReason to_wire(kicking::Reason reason) { return static_cast<msg::DecisionReason>(reason); }

kicking::PolicyInput policy_input(const msg::WorldState& world, const msg::KickerStatus* kicker) {
  kicking::PolicyInput in;
  in.t_ns = world.t_ns;
  in.pose = {world.x_m, world.y_m, world.heading_rad};
  in.twist = {world.vx_mps, world.vy_mps, world.omega_radps};
  in.playing = world.playing;
  in.possession = world.possession;
  in.possession_id = world.possession_id;
  in.kicker_ready = kicker != nullptr && kicker->ready;
  if (kicker != nullptr) in.state_age_s = std::abs(static_cast<double>(world.t_ns - kicker->t_ns)) * 1e-9;
  in.sd_position_m = world.sd_position_m;
  in.sd_heading_rad = world.sd_heading_rad;
  if (std::isfinite(world.opponent_distance_m)) in.opponent_distance_m = world.opponent_distance_m;
  return in;
}

msg::KickDecision decision_message(const msg::WorldState& world, const msg::KickerStatus* kicker,
                                   kicking::PolicyName policy, const kicking::Judgement& judgement) {
  msg::KickDecision out{};
  out.t_ns = world.t_ns;
  out.half = world.half;
  out.possession_id = world.possession_id;
  out.policy = to_wire(policy);
  out.fire = judgement.fire;
  out.reason = to_wire(judgement.reason);
  out.x_m = world.x_m;
  out.y_m = world.y_m;
  out.heading_rad = world.heading_rad;
  out.vx_mps = world.vx_mps;
  out.vy_mps = world.vy_mps;
  out.omega_radps = world.omega_radps;
  out.target_x_m = judgement.target_x_m;
  out.target_y_m = judgement.target_y_m;
  out.target_z_m = judgement.target_z_m;
  out.distance_m = judgement.distance_m;
  out.v0_mps = judgement.v0_mps.value_or(msg::kNone);
  out.v_kick_mps = judgement.v_kick_mps.value_or(msg::kNone);
  out.power = judgement.power.value_or(msg::kNone);
  out.alpha_rad = judgement.alpha_rad;
  out.beta_rad = judgement.beta_rad;
  out.aligned = judgement.aligned;
  out.offset_right_m = judgement.offset_right_m.value_or(msg::kNone);
  out.left_m = judgement.left_m;
  out.right_m = judgement.right_m;
  out.predicted_x_cross_m = judgement.predicted ? judgement.predicted->x_m : msg::kNone;
  out.predicted_z_cross_m = judgement.predicted ? judgement.predicted->z_m : msg::kNone;
  out.predicted_t_flight_s = judgement.predicted ? judgement.predicted->t_flight_s : msg::kNone;
  out.p_on_target = judgement.p_on_target.value_or(msg::kNone);
  out.fire_after_s = judgement.fire_after_s;
  out.assignment_probability = 1.0;
  out.opponent_distance_m = world.opponent_distance_m;
  out.charge = kicker != nullptr ? kicker->charge : 0.0;
  return out;
}

msg::ShadowDecision shadow_message(kicking::PolicyName policy, const kicking::Judgement& judgement) {
  msg::ShadowDecision out{};
  out.policy = to_wire(policy);
  out.fire = judgement.fire;
  out.reason = to_wire(judgement.reason);
  out.power = judgement.power.value_or(msg::kNone);
  out.v_kick_mps = judgement.v_kick_mps.value_or(msg::kNone);
  out.aligned = judgement.aligned;
  out.offset_right_m = judgement.offset_right_m.value_or(msg::kNone);
  out.left_m = judgement.left_m;
  out.right_m = judgement.right_m;
  out.p_on_target = judgement.p_on_target.value_or(msg::kNone);
  out.fire_after_s = judgement.fire_after_s;
  return out;
}

}  // namespace trivela::robot
