#include "experiment/play/oracle.hpp"

#include <vector>

#include "sim/kicker/kicker.hpp"

namespace trivela::experiment {

namespace {

/// One kind of kick.
kicking::RobotModel oracle_kind(const sim::Scenario& scenario, const sim::Kicker& kicker) {
  std::vector<kicking::SetPoint> speeds;
  std::vector<kicking::AnglePoint> angles;
  for (std::size_t i = 0; i < kicker.powers.size(); ++i) {
    const sim::Exit seen = sim::effective_exit(
        {kicker.speed_scale_ratio * kicker.exit_speeds_mps[i], kicker.exit_elevations_rad[i]}, scenario.ball);
    speeds.push_back({kicker.powers[i], seen.speed_mps});
    angles.push_back({kicker.powers[i], seen.elevation_rad});
  }
  kicking::RobotModel robot;
  robot.table = kicking::EffectiveTable{speeds};
  robot.exit_angles.emplace(angles);
  robot.exit_angle_rad = angles.back().exit_angle_rad;
  robot.transfer_exact = {kicker.transfer_forward_ratio, kicker.transfer_backward_ratio, kicker.transfer_lateral_ratio};
  robot.delay_s = kicker.delay_s;
  robot.ball_offset_m = scenario.robot.ball_offset_m;
  robot.ball = {.mass_kg = scenario.ball.mass_kg, .radius_m = scenario.ball.radius_m};
  robot.spreads = {.speed_sd_ratio = kicker.speed_sd_ratio,
                   .exit_angle_sd_rad = 0.0,
                   .direction_sd_rad = kicker.direction_sd_rad,
                   .delay_sd_s = kicker.delay_sd_s,
                   .table_sd_ratio = 0.0,
                   .transfer_sd_ratio = 0.0};
  return robot;
}

}  // namespace

kicking::RobotModel oracle_robot(const sim::Scenario& scenario, const sim::Kicker& kicker, std::size_t kinds) {
  kicking::RobotModel robot = oracle_kind(scenario, kicker);
  if (!kicker.flat.enabled || kinds == 1) return robot;
  robot.lever_s = kicker.flat.lever_s;
  robot.further_kinds.push_back(oracle_kind(scenario, sim::kicker_of_kind(kicker, 1)));
  return robot;
}

kicking::PolicyConfig oracle_config(const kicking::PolicyConfig& config, const sim::Scenario& scenario) {
  kicking::PolicyConfig told = config;
  told.cycle_s = scenario.cycle_s;
  told.max_brake_mps2 = scenario.robot.max_acceleration_mps2;
  told.max_turn_rate_radps = scenario.robot.max_turn_rate_radps;
  told.max_turn_acceleration_radps2 = scenario.robot.max_turn_acceleration_radps2;
  kicking::PredictiveConfig& own = told.predictive;
  own.position_sd_m = own.heading_sd_rad = own.speed_sd_mps = own.turn_rate_sd_radps = 0.0;
  own.twist_lag_s = own.opponent_lag_s = 0.0;
  own.dispute_distance_m = scenario.opponent.dispute_distance_m;
  own.opponent_radius_m = scenario.opponent.body_radius_m;
  own.opponent_height_m = scenario.opponent.body_height_m;
  const sim::Guard& guard = scenario.keeper.guard;
  told.keeper = {.reaction_s = guard.reaction_s,
                 .speed_mps = guard.speed_mps,
                 .acceleration_mps2 = guard.acceleration_mps2,
                 .half_width_m = guard.half_width_m + scenario.keeper.side_extension_m - guard.overlap_m,
                 .height_m = guard.height_m + scenario.keeper.up_extension_m - guard.overlap_m,
                 .sd_m = 0.02,
                 .miss_ratio = config.keeper.miss_ratio};
  if (scenario.ball.sliding_friction_ratio > 0.0) own.floor_friction_ratio = scenario.ball.sliding_friction_ratio;
  own.hazard_per_s = 0.02;  // so that it does not wait for nothing
  return told;
}

kicking::PolicyInput oracle_input(const sim::TrueState& state, std::int64_t t_ns, bool playing,
                                  std::uint32_t possession_id, bool kicker_ready) {
  kicking::PolicyInput input;
  input.t_ns = t_ns;
  input.pose = state.pose;
  input.twist = state.twist;
  input.playing = playing;
  input.possession = state.ball_held;
  input.possession_id = possession_id;
  input.kicker_ready = kicker_ready;
  input.lever_kind = state.lever_kind;
  input.opponent_distance_m = state.opponent_distance_m;
  input.opponent_closing_mps = state.opponent_closing_mps;
  input.opponents = state.opponents;
  input.opponent_count = state.opponent_count;
  if (state.keeper_x_m) input.keeper = kicking::KeeperPlace{*state.keeper_x_m, 0.0};
  return input;
}

}  // namespace trivela::experiment
