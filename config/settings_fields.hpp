#pragma once

#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "config/settings.hpp"
#include "config/text/field_types.hpp"
#include "kicking/kick_id.hpp"
#include "kicking/policy/match_rules.hpp"

/// The keys of default.toml, each named once.
namespace trivela::kicking {

inline config::EnumNames<PolicyName> names_of(PolicyName) {
  config::EnumNames<PolicyName> all;
  for (const Policy* policy : policies()) all.emplace_back(policy->facts().name, static_cast<PolicyName>(all.size()));
  return all;
}

inline config::EnumNames<HeightLaw> names_of(HeightLaw) {
  using enum HeightLaw;
  return {{"paper", kPaper}, {"extended_range", kExtendedRange}, {"exact", kExact}};
}

inline config::EnumNames<Objective> names_of(Objective) {
  return {{"on_target", Objective::kOnTarget}, {"goal", Objective::kGoal}};
}

inline config::EnumNames<MotionLaw> names_of(MotionLaw) {
  return {{"paper", MotionLaw::kPaper}, {"exact", MotionLaw::kExact}};
}

inline config::EnumNames<AlphaLaw> names_of(AlphaLaw) {
  return {{"paper_line", AlphaLaw::kPaperLine}, {"physical", AlphaLaw::kPhysical}};
}

inline config::EnumNames<Extension> names_of(Extension) { return {{"max", Extension::kMax}, {"add", Extension::kAdd}}; }

void fields(auto& v, Goal& g) {
  using config::Range;
  v("y_m", g.y_m, Range{1.0, 30.0});
  v("half_width_m", g.half_width_m, Range{0.3, 5.0});
  v("height_m", g.height_m, Range{0.3, 5.0});
  v("post_width_m", g.post_width_m, Range{0.0, 0.5});
}

void fields(auto& v, AlignmentRule& a) {
  using config::Degrees, config::Range;
  v("half_width_m", a.half_width_m, Range{0.0, 2.0});
  v("extension", a.extension);
  v("reach_m", a.reach_m, Range{1.0, 100.0});
  v("beta_limit_deg", Degrees{a.beta_limit_rad}, Range{0.0, 85.0});
}

void fields(auto& v, TestDriveConfig& t) {
  using config::Degrees, config::Range;
  v("kicks_per_level", t.kicks_per_level, Range{1, 1000});
  v("aim_tolerance_deg", Degrees{t.aim_tolerance_rad}, Range{0.05, 30.0});
  v("settle_s", t.settle_s, Range{0.0, 5.0});
  v("rest_speed_mps", t.rest_speed_mps, Range{0.0, 2.0});
  v("rest_turn_rate_radps", t.rest_turn_rate_radps, Range{0.0, 5.0});
  v("powers", t.powers, Range{0.0, 1000.0});
  v("kick_kind", t.kick_kind, Range{0, kMostKickKinds - 1});
  v("distance_m", t.distance_m, Range{1.0, 20.0});
  v("straight_distance_m", t.straight_distance_m, Range{1.0, 20.0});
  v("run_up_m", t.run_up_m, Range{0.3, 8.0});
  v("approach_mps", t.approach_mps, Range{0.1, 5.0});
  v("lateral_mps", t.lateral_mps, Range{-5.0, 5.0});
  v("straight_mps", t.straight_mps, Range{-5.0, 5.0});
  v("turn_radps", t.turn_radps, Range{-20.0, 20.0});
  v("turn_lead_deg", Degrees{t.turn_lead_rad}, Range{5.0, 80.0});
  v("turn_widest_deg", Degrees{t.turn_widest_rad}, Range{1.0, 60.0});
  v("turn_steps", t.turn_steps, Range{1, 20});
  v("turn_kicks_per_step", t.turn_kicks_per_step, Range{1, 1000});
}

void fields(auto& v, PredictiveConfig& p) {
  using config::Degrees, config::Range;
  v("threshold", p.threshold, Range{0.0, 1.0});
  v("goal_threshold", p.goal_threshold, Range{0.0, 1.0});
  v("horizon_s", p.horizon_s, Range{0.0, 5.0});
  v("step_s", p.step_s, Range{0.005, 0.5});
  v("bounce_ratio", p.bounce_ratio, Range{0.0, 1.0});
  v("low_bounce_ratio", p.low_bounce_ratio, Range{0.0, 1.0});
  v("floor_friction_ratio", p.floor_friction_ratio, Range{0.0, 2.0});
  v("position_sd_m", p.position_sd_m, Range{0.0, 5.0});
  v("heading_sd_deg", Degrees{p.heading_sd_rad}, Range{0.0, 45.0});
  v("speed_sd_mps", p.speed_sd_mps, Range{0.0, 5.0});
  v("turn_rate_sd_radps", p.turn_rate_sd_radps, Range{0.0, 5.0});
  v("twist_lag_s", p.twist_lag_s, Range{0.0, 0.5});
  v("dispute_distance_m", p.dispute_distance_m, Range{0.0, 5.0});
  v("closing_mps", p.closing_mps, Range{0.0, 10.0});
  v("closing_sd_mps", p.closing_sd_mps, Range{0.0, 10.0});
  v("closing_walk_mps2", p.closing_walk_mps2, Range{0.0, 10.0});
  v("opponent_sd_m", p.opponent_sd_m, Range{0.001, 5.0});
  v("opponent_lag_s", p.opponent_lag_s, Range{0.0, 1.0});
  v("hazard_per_s", p.hazard_per_s, Range{0.0, 10.0});
  v("opponent_radius_m", p.opponent_radius_m, Range{0.0, 2.0});
  v("opponent_height_m", p.opponent_height_m, Range{0.0, 3.0});
  v("opponent_places", p.opponent_places);
}

void fields(auto& v, KickerChange& c) {
  using config::Degrees, config::Range;
  v("speed_sd_ratio", c.speed_sd_ratio, Range{0.001, 0.5});
  v("elevation_sd_deg", Degrees{c.elevation_sd_rad}, Range{0.01, 20.0});
  v("direction_sd_deg", Degrees{c.direction_sd_rad}, Range{0.01, 20.0});
  v("delay_sd_s", c.delay_sd_s, Range{0.0005, 0.2});
  v("transfer_sd_ratio", c.transfer_sd_ratio, Range{0.001, 1.0});
  v("jump_chance", c.jump_chance, Range{1e-6, 0.5});
}

void fields(auto& v, KeeperConfig& k) {
  using config::Range;
  v("reaction_s", k.reaction_s, Range{0.0, 2.0});
  v("speed_mps", k.speed_mps, Range{0.0, 20.0});
  v("acceleration_mps2", k.acceleration_mps2, Range{0.0, 50.0});
  v("half_width_m", k.half_width_m, Range{0.0, 2.0});
  v("height_m", k.height_m, Range{0.0, 3.0});
  v("sd_m", k.sd_m, Range{0.0, 2.0});
  v("miss_ratio", k.miss_ratio, Range{0.0, 1.0});
  v("guess_m", k.guess_m, Range{0.0, 1.2});
  v("guess_prior", k.guess_prior, Range{0.0, 0.9});
}

/// [policy.own.NAME] of a policy from outside.
struct OwnSettings {
  const Policy& policy;
  std::vector<double>& values;
};

void fields(auto& v, OwnSettings& own) {
  for (std::size_t i = 0; i < own.values.size(); ++i)
    v(own.policy.settings()[i].key, own.values[i], own.policy.settings()[i].range);
}

/// [policy.own]: reading it makes the policies known that a file has and this program has not. Written is what stands
/// in `values`.
struct OwnPolicies {
  std::vector<std::vector<double>>& values;
};

void fields(auto& v, OwnPolicies& own) {
  if constexpr (requires { v.tables(); }) {
    for (const auto& table : v.tables()) v.require(table.first, [&] { declare_policy(table.first, table.second); });
    complete_own_settings(own.values);
  }
  for (std::size_t i = 0; i < own.values.size(); ++i) {
    OwnSettings settings{*policies()[kPolicyCount + i], own.values[i]};
    v(settings.policy.facts().name, settings);
  }
}

void fields(auto& v, PolicyConfig& p) {
  using config::Degrees, config::Range;
  v("objective", p.objective);
  v("corner_margin_m", p.corner_margin_m, Range{0.0, 1.0});
  v("goal_dribble_mps", p.goal_dribble_mps, Range{0.0, 10.0});
  v("height_law", p.height_law);
  v("motion_law", p.motion_law);
  v("alpha_law", p.alpha_law);
  v("target_x_m", p.target_x_m, Range{-1.5, 1.5});
  v("target_height_m", p.target_height_m, Range{0.11, 2.0});
  v("max_state_age_s", p.max_state_age_s, Range{0.0, 2.0});
  v("order_hold_s", p.order_hold_s, Range{0.0, 10.0});
  v("aim_tolerance_deg", Degrees{p.aim_tolerance_rad}, Range{0.05, 30.0});
  v("settle_s", p.settle_s, Range{0.0, 5.0});
  v("rest_speed_mps", p.rest_speed_mps, Range{0.0, 2.0});
  v("rest_turn_rate_radps", p.rest_turn_rate_radps, Range{0.0, 5.0});
  v("stopped_turn_gain_hz", p.stopped_turn_gain_hz, Range{0.1, 100.0});
  v("moving_turn_gain_hz", p.moving_turn_gain_hz, Range{0.1, 100.0});
  v("max_forward_mps", p.max_forward_mps, Range{0.0, 10.0});
  v("max_sideways_mps", p.max_sideways_mps, Range{0.0, 10.0});
  v("dribble_mps", p.dribble_mps, Range{0.0, 10.0});
  v("keep_off_m", p.keep_off_m, Range{0.0, 10.0});
  v("max_brake_mps2", p.max_brake_mps2, Range{0.1, 50.0});
  v("max_turn_rate_radps", p.max_turn_rate_radps, Range{0.0, 30.0});
  v("max_turn_acceleration_radps2", p.max_turn_acceleration_radps2, Range{0.0, 200.0});
  v("half_line_margin_m", p.half_line_margin_m, Range{0.0, 5.0});
  v("carry_margin_m", p.carry_margin_m, Range{0.0, 5.0});
  v("alignment", p.alignment);
  v("keeper", p.keeper);
  v("predictive", p.predictive);
  v("test_drive", p.test_drive);
  OwnPolicies own{p.own};
  v("own", own);
}

}  // namespace trivela::kicking

namespace trivela::config {

inline EnumNames<Capability> names_of(Capability) {
  using enum Capability;
  return {
      {"charge_control", kChargeControl}, {"voltage", kVoltage}, {"discharge", kDischarge}, {"watchdog", kWatchdog}};
}

inline EnumNames<SelfCalibrationMode> names_of(SelfCalibrationMode) {
  using enum SelfCalibrationMode;
  return {{"off", kOff}, {"shadow", kShadow}, {"on", kOn}};
}

inline EnumNames<DriveMode> names_of(DriveMode) {
  using enum DriveMode;
  return {{"always", kAlways}, {"with_ball", kWithBall}, {"advice", kAdvice}};
}

inline EnumNames<SimulatedDevices> names_of(SimulatedDevices) {
  return {{"bus", SimulatedDevices::kBus}, {"emulated", SimulatedDevices::kEmulated}};
}

inline EnumNames<TeamColour> names_of(TeamColour) {
  return {{"cyan", TeamColour::kCyan}, {"magenta", TeamColour::kMagenta}};
}

void fields(auto& v, Run& r) {
  v("team", r.team);
  v("robot_id", r.robot_id, Range{1, 255});
  v("cycle_s", r.cycle_s, Range{0.0005, 0.5});
  v("session", r.session, Range{0, kicking::KickId::kLastSession});
  v("match_mode", r.match_mode);
  v("lockstep", r.lockstep);
  v("one_process", r.one_process);
  v("referee_timeout_s", r.referee_timeout_s, Range{0.05, 60.0});
  v("robot", r.robot);
  v("scenario", r.scenario);
  v("field_file", r.field_file);
  v("memory_limit_mb", r.memory_limit_mb, Range{8, 1'000'000});
  v("log_level", r.log_level);
  require(v, "log_level", [&] {
    if (std::ranges::find(kLogLevels, r.log_level) == kLogLevels.end())
      throw std::invalid_argument{fmt::format("expected one of: {}", fmt::join(kLogLevels, ", "))};
  });
}

void fields(auto& v, FieldLines& f) { v("side_line_x_m", f.side_line_x_m, Range{1.0, 30.0}); }

void fields(auto& v, Domain& d) {
  v("domain_id", d.domain_id, Range{0, 100});
  v("tag", d.tag);
  v("dds_file", d.dds_file);
}

void fields(auto& v, IoBoardDevice& b) {
  v("port", b.port);
  v("pulse_us_per_power", b.pulse_us_per_power, Range{0.1, 32640.0});
  v("lever", b.lever, Range{0, 205});
  v("charge_time_s", b.charge_time_s, Range{0.0, 60.0});
}

void fields(auto& v, ReKickDevice& b) {
  v("port", b.port);
  v("pulse_us_per_power", b.pulse_us_per_power, Range{0.01, 3499.0});
  v("max_voltage_v", b.max_voltage_v, Range{1, 330});
}

void fields(auto& v, Cia402Device& d) {
  v("port", d.port);
  v("nodes", d.nodes, Range{1, 127});
  v("reversed", d.reversed, Range{1, 127});
  v("gear", d.gear, Range{0.01, 1000.0});
  v("rpm_per_unit", d.rpm_per_unit, Range{1e-9, 1e4});
  v("max_motor_rpm", d.max_motor_rpm, Range{1.0, 1e5});
  v("ramp", d.ramp, Range{1, 4294967295.0});
  v("quick_stop_ramp", d.quick_stop_ramp, Range{1, 4294967295.0});
  v("master", d.master, Range{1, 127});
  v("heartbeat_s", d.heartbeat_s, Range{0.1, 1.0});
  v("cycle_s", d.cycle_s, Range{0.002, 0.05});
}

void fields(auto& v, MtiDevice& d) {
  v("port", d.port);
  v("upside_down", d.upside_down);
}

void fields(auto& v, Hal& h) {
  v("wheels", h.wheels);
  v("gyro", h.gyro);
  v("kicker", h.kicker);
}

void fields(auto& v, Odometry& o) {
  v("wheel_sd_radps", o.wheel_sd_radps, Range{1e-6, 100.0});
  v("gyro_sd_radps", o.gyro_sd_radps, Range{1e-6, 10.0});
  v("drive_timeout_s", o.drive_timeout_s, Range{0.01, 10.0});
  v("team_drive_timeout_s", o.team_drive_timeout_s, Range{0.01, 10.0});
  v("drift_ratio", o.drift_ratio, Range{0.0, 1.0});
  v("heading_drift_ratio", o.heading_drift_ratio, Range{0.0, 1.0});
}

void fields(auto& v, WorldState& w) {
  v("pose_sd_m", w.pose_sd_m, Range{1e-4, 5.0});
  v("pose_sd_heading_deg", Degrees{w.pose_sd_heading_rad}, Range{0.01, 90.0});
  v("relocalise_distance_m", w.relocalise_distance_m, Range{0.05, 20.0});
  v("relocalise_frames", w.relocalise_frames, Range{1, 1000});
  v("history_s", w.history_s, Range{0.01, 10.0});
  v("velocity_time_constant_s", w.velocity_time_constant_s, Range{1e-4, 1.0});
  v("ball_time_constant_s", w.ball_time_constant_s, Range{1e-4, 1.0});
  v("possession_forget_s", w.possession_forget_s, Range{0.01, 10.0});
  v("ball_forget_s", w.ball_forget_s, Range{0.01, 10.0});
  v("handler_half_width_m", w.handler_half_width_m, Range{0.01, 0.5});
  v("handler_reach_m", w.handler_reach_m, Range{0.01, 0.5});
  v("possession_debounce_s", w.possession_debounce_s, Range{0.0, 2.0});
}

void fields(auto& v, KickDecision& k) {
  v("policy_by_half", k.policy_by_half);
  v("policy_by_robot", k.policy_by_robot);
  v("random", k.random);
  v("random_probabilities", k.random_probabilities, Range{0.0, 1.0});
  v("assignment_seed", k.assignment_seed, Range{0, 9e15});
  v("learned_model", k.learned_model);
  v("shadows", k.shadows);
  v("order_validity_s", k.order_validity_s, Range{0.001, 1.0});
  v("drive", k.drive);
  v("standby", k.standby);
}

void fields(auto& v, KickerDriver& k) {
  v("min_interval_s", k.min_interval_s, Range{0.01, 10.0});
  v("min_charge_ratio", k.min_charge_ratio, Range{0.0, 1.0});
  v("max_order_age_s", k.max_order_age_s, Range{0.001, 1.0});
  v("future_tolerance_s", k.future_tolerance_s, Range{0.0, 1.0});
  v("link_timeout_s", k.link_timeout_s, Range{0.001, 10.0});
  v("voltage_rise_v", k.voltage_rise_v, Range{0.1, 500.0});
  v("voltage_rise_s", k.voltage_rise_s, Range{0.1, 60.0});
  v("demand", k.demand);
}

void fields(auto& v, ShotObserver& s) {
  v("history_s", s.history_s, Range{0.05, 10.0});
  v("time_out_s", s.time_out_s, Range{0.2, 30.0});
  v("ball_sd_m", s.ball_sd_m, Range{1e-4, 1.0});
  v("label_probability", s.label_probability, Range{0.5, 1.0});
  v("lost_s", s.lost_s, Range{0.02, 5.0});
  v("rest_speed_mps", s.rest_speed_mps, Range{0.0, 5.0});
}

void fields(auto& v, SelfCalibration& s) {
  v("mode", s.mode);
  v("state_file", s.state_file);
  v("state_max_age_h", s.state_max_age_h, Range{0.0, 87600.0});
  v("change", s.change);
}

void fields(auto& v, Simulator& s) {
  v("seed", s.seed, Range{0, 9e15});
  v("halves", s.halves, Range{1, 255});
  v("half_minutes", s.half_minutes, Range{0.0, 1000.0});
  v("max_possessions", s.max_possessions, Range{0, 1000000});
  v("paired_halves", s.paired_halves);
  v("pace", s.pace, Range{0.0, 1000.0});
  v("devices", s.devices);
  v("referee", s.referee);
}

void fields(auto& v, Recorder& r) {
  v("log", r.log);
  v("queue_capacity", r.queue_capacity, Range{1, 10000000});
  v("group_commit_s", r.group_commit_s, Range{0.001, 10.0});
}

void fields(auto& v, ScanRecorder& s) {
  v("enabled", s.enabled);
  v("device", s.device);
  v("file", s.file);
  v("mount_x_m", s.mount_x_m, Range{-50.0, 50.0});
  v("mount_z_m", s.mount_z_m, Range{0.0, 5.0});
  v("mount_front_elevation_deg", Degrees{s.mount_front_elevation_rad}, Range{-180.0, 180.0});
  v("mount_mirrored", s.mount_mirrored);
}

void fields(auto& v, Refbox& r) {
  v("host", r.host);
  v("port", r.port, Range{1, 65535});
  v("group", r.group);
  v("team_name", r.team_name);
  v("intention", r.intention);
  v("letters", r.letters);
  v("colour", r.colour);
  v("robots", r.robots, Range{1, 255});
  v("period_s", r.period_s, Range{0.01, 0.1});
  v("acknowledgement_s", r.acknowledgement_s, Range{0.05, 0.5});
}

void fields(auto& v, TeamLink& t) {
  v("domain_id", t.domain_id, Range{0, 100});
  v("dds_file", t.dds_file);
  v("interface", t.interface);
  v("base", t.base);
  v("referee", t.referee);
}

void fields(auto& v, Settings& s) {
  v("run", s.run);
  v("domain", s.domain);
  v("hal", s.hal);
  v("goal", s.goal);
  v("field", s.field);
  v("rules", s.policy.rules);
  v("policy", s.policy);
  v("odometry", s.odometry);
  v("world_state", s.world_state);
  v("kick_decision", s.kick_decision);
  v("kicker_driver", s.kicker_driver);
  v("shot_observer", s.shot_observer);
  v("self_calibration", s.self_calibration);
  v("simulator", s.simulator);
  v("recorder", s.recorder);
  v("scan_recorder", s.scan_recorder);
  v("refbox", s.refbox);
  v("team_link", s.team_link);
}

}  // namespace trivela::config
