#pragma once

#include <optional>
#include <string>

#include "kicking/policy/match_rules.hpp"
#include "kicking/range.hpp"
#include "sim/scenario.hpp"

/// The keys of a scenario, each named once with the range it may take: `fields(visitor, struct)` calls
/// `visitor(key, member, range)` for each member and `visitor(key, struct)` for each nested struct. Found by ADL.
namespace trivela::sim {

using kicking::Degrees, kicking::Range;

inline constexpr Range kRatio{0.0, 1.0};

void fields(auto& v, BallPhysics& b) {
  v("mass_kg", b.mass_kg, Range{0.05, 2.0});
  v("radius_m", b.radius_m, Range{0.02, 0.25});
  v("air_density_kgpm3", b.air_density_kgpm3, Range{0.0, 2.0});
  v("drag_coefficient", b.drag_coefficient, Range{0.0, 2.0});
  v("gravity_mps2", b.gravity_mps2, Range{1.0, 20.0});
  v("restitution_ratio", b.restitution_ratio, Range{0.0, 0.95});
  v("retention_ratio", b.retention_ratio, kRatio);
  v("roll_below_mps", b.roll_below_mps, Range{0.05, 5.0});
  v("rolling_deceleration_mps2", b.rolling_deceleration_mps2, Range{0.0, 20.0});
  v("sliding_friction_ratio", b.sliding_friction_ratio, Range{0.0, 2.0});
  v("frame_restitution_ratio", b.frame_restitution_ratio, kRatio);
  v("body_restitution_ratio", b.body_restitution_ratio, kRatio);
}

void fields(auto& v, Robot& r) {
  v("max_speed_mps", r.max_speed_mps, Range{0.1, 10.0});
  v("max_acceleration_mps2", r.max_acceleration_mps2, Range{0.1, 50.0});
  v("max_turn_rate_radps", r.max_turn_rate_radps, Range{0.1, 30.0});
  v("max_turn_acceleration_radps2", r.max_turn_acceleration_radps2, Range{0.1, 200.0});
  v("ball_offset_m", r.ball_offset_m, Range{0.1, 0.6});
  v("wheel_angles_rad", r.wheel_angles_rad, Range{-6.3, 6.3});
  v("wheel_distance_m", r.wheel_distance_m, Range{0.02, 0.6});
  v("wheel_radius_m", r.wheel_radius_m, Range{0.005, 0.3});
}

void fields(auto& v, FlatKick& k) {
  v("enabled", k.enabled);
  v("powers", k.powers, Range{0.0, 1000.0});
  v("exit_speeds_mps", k.exit_speeds_mps, Range{0.1, 40.0});
  v("exit_elevations_rad", k.exit_elevations_rad, Range{0.0, 1.5});
  v("delay_s", k.delay_s, Range{0.0, 1.0});
  v("delay_sd_s", k.delay_sd_s, Range{0.0, 0.5});
  v("speed_sd_ratio", k.speed_sd_ratio, Range{0.0, 0.3});
  v("direction_sd_deg", Degrees{k.direction_sd_rad}, Range{0.0, 30.0});
  v("lever_s", k.lever_s, Range{0.0, 5.0});
}

void fields(auto& v, Kicker& k) {
  v("powers", k.powers, Range{0.0, 1000.0});
  v("exit_speeds_mps", k.exit_speeds_mps, Range{0.1, 40.0});
  v("exit_elevations_rad", k.exit_elevations_rad, Range{0.0, 1.5});
  v("speed_scale_ratio", k.speed_scale_ratio, Range{0.1, 3.0});
  v("drift_sd_ratio", k.drift_sd_ratio, Range{0.0, 0.15});
  v("drop_ratio", k.drop_ratio, Range{-0.3, 0.3});
  v("drop_after_kicks", k.drop_after_kicks, Range{0.0, 1e6});
  v("delay_s", k.delay_s, Range{0.0, 1.0});
  v("delay_sd_s", k.delay_sd_s, Range{0.0, 0.5});
  v("speed_sd_ratio", k.speed_sd_ratio, Range{0.0, 0.3});
  v("direction_sd_deg", Degrees{k.direction_sd_rad}, Range{0.0, 30.0});
  v("transfer_forward_ratio", k.transfer_forward_ratio, Range{0.0, 1.5});
  v("transfer_backward_ratio", k.transfer_backward_ratio, Range{0.0, 1.5});
  v("transfer_lateral_ratio", k.transfer_lateral_ratio, Range{0.0, 1.5});
  v("flat", k.flat);
  v("charge_per_kick_ratio", k.charge_per_kick_ratio, kRatio);
  v("recharge_per_s", k.recharge_per_s, Range{0.0, 100.0});
}

void fields(auto& v, Possession& p) {
  v("goal_distance_min_m", p.goal_distance_min_m, Range{0.5, 18.0});
  v("goal_distance_max_m", p.goal_distance_max_m, Range{0.5, 18.0});
  v("lateral_max_m", p.lateral_max_m, Range{0.0, 10.0});
  v("aim_error_sd_deg", Degrees{p.aim_error_sd_rad}, Range{0.0, 360.0});
  v("speed_min_mps", p.speed_min_mps, Range{0.0, 10.0});
  v("speed_max_mps", p.speed_max_mps, Range{0.0, 10.0});
  v("travel_direction_sd_deg", Degrees{p.travel_direction_sd_rad}, Range{0.0, 360.0});
  v("time_limit_s", p.time_limit_s, Range{0.1, 120.0});
  v("stop_s", p.stop_s, Range{0.0, 60.0});
  v("flight_limit_s", p.flight_limit_s, Range{0.1, 30.0});
  v("after_crossing_s", p.after_crossing_s, Range{0.0, 10.0});
}

void fields(auto& v, Opponent& o) {
  v("count", o.count, Range{1.0, 5.0});
  v("distance_median_m", o.distance_median_m, Range{0.1, 100.0});
  v("distance_sigma_ln", o.distance_sigma_ln, Range{0.0, 3.0});
  v("further_median_m", o.further_median_m, Range{0.1, 100.0});
  v("closing_min_mps", o.closing_min_mps, Range{0.0, 10.0});
  v("closing_max_mps", o.closing_max_mps, Range{0.0, 10.0});
  v("dispute_distance_m", o.dispute_distance_m, Range{0.0, 5.0});
  v("body_radius_m", o.body_radius_m, Range{0.0, 1.0});
  v("body_height_m", o.body_height_m, Range{0.0, 2.0});
}

/// Keys of whoever has a guard's body, in the same section.
void guard_fields(auto& v, Guard& g) {
  v("reaction_s", g.reaction_s, Range{0.0, 5.0});
  v("sight_sd_mps", g.sight_sd_mps, Range{0.0, 5.0});
  v("speed_mps", g.speed_mps, Range{0.0, 10.0});
  v("acceleration_mps2", g.acceleration_mps2, Range{0.1, 200.0});
  v("half_width_m", g.half_width_m, Range{0.0, 1.0});
  v("height_m", g.height_m, Range{0.0, 2.0});
  v("overlap_m", g.overlap_m, Range{0.0, 0.2});
}

void fields(auto& v, Keeper& k) {
  v("enabled", k.enabled);
  guard_fields(v, k.guard);
  v("side_extension_m", k.side_extension_m, Range{0.0, 1.0});
  v("up_extension_m", k.up_extension_m, Range{0.0, 1.0});
  v("extension_s", k.extension_s, Range{0.0, 5.0});
  v("advance_m", k.advance_m, Range{0.0, 0.7});
  v("guess_m", k.guess_m, Range{0.0, 1.2});
}

void fields(auto& v, Defenders& d) {
  v("count", d.count, Range{0.0, 4.0});
  v("line_distance_m", d.line_distance_m, Range{0.1, 9.0});
  v("spread_sd_m", d.spread_sd_m, Range{0.0, 10.0});
  guard_fields(v, d.guard);
}

void fields(auto& v, Referee& r) {
  v("stops_per_min", r.stops_per_min, Range{0.0, 60.0});
  v("half_minutes", r.half_minutes, Range{0.01, 1000.0});
  v("set_pieces", r.set_pieces);
}

void fields(auto& v, Team& t) {
  v("robots", t.robots, Range{1.0, 5.0});
  v("speed_scale_ratios", t.speed_scale_ratios, Range{0.5, 1.5});
}

void fields(auto& v, Odometry& o) {
  v("wheel_sd_radps", o.wheel_sd_radps, Range{0.0, 100.0});
  v("slip_sd_ratio", o.slip_sd_ratio, Range{0.0, 0.5});
  v("gyro_sd_radps", o.gyro_sd_radps, Range{0.0, 10.0});
  v("gyro_bias_sd_radps", o.gyro_bias_sd_radps, Range{0.0, 10.0});
}

void fields(auto& v, Vision& s) {
  v("latency_s", s.latency_s, Range{0.0, 0.5});
  v("position_white_sd_m", s.position_white_sd_m, Range{0.0, 5.0});
  v("position_slow_sd_m", s.position_slow_sd_m, Range{0.0, 5.0});
  v("heading_white_sd_deg", Degrees{s.heading_white_sd_rad}, Range{0.0, 90.0});
  v("heading_slow_sd_deg", Degrees{s.heading_slow_sd_rad}, Range{0.0, 90.0});
  v("slow_time_s", s.slow_time_s, Range{0.001, 1000.0});
  v("ball_sd_m", s.ball_sd_m, Range{0.0, 5.0});
  v("ball_sd_ratio", s.ball_sd_ratio, kRatio);
  v("ball_range_m", s.ball_range_m, Range{0.0, 100.0});
  v("ball_height_max_m", s.ball_height_max_m, Range{0.0, 10.0});
  v("opponent_sd_m", s.opponent_sd_m, Range{0.0, 5.0});
  v("opponent_range_m", s.opponent_range_m, Range{0.0, 100.0});
  v("dropout_ratio", s.dropout_ratio, kRatio);
}

void fields(auto& v, FlightCamera& c) {
  v("latency_s", c.latency_s, Range{0.0, 0.5});
  v("period_s", c.period_s, Range{0.001, 1.0});
  v("position_sd_m", c.position_sd_m, Range{0.0, 5.0});
  v("dropout_ratio", c.dropout_ratio, kRatio);
  v("bias_x_m", c.bias_x_m, Range{-1.0, 1.0});
  v("bias_y_m", c.bias_y_m, Range{-1.0, 1.0});
  v("bias_z_m", c.bias_z_m, Range{-1.0, 1.0});
}

void fields(auto& v, Laser& l) {
  v("enabled", l.enabled);
  v("x_m", l.x_m, Range{-30.0, 30.0});
  v("y_m", l.y_m, Range{-30.0, 30.0});
  v("z_m", l.z_m, Range{0.01, 5.0});
  v("heading_deg", Degrees{l.heading_rad}, Range{-360.0, 360.0});
  v("front_elevation_deg", Degrees{l.front_elevation_rad}, Range{-180.0, 180.0});
  v("range_sd_m", l.range_sd_m, Range{0.0, 1.0});
  v("dropout_ratio", l.dropout_ratio, kRatio);
  v("mixed_ratio", l.mixed_ratio, kRatio);
  v("mixed_depth_m", l.mixed_depth_m, Range{0.0, 10.0});
  v("wall_ahead_m", l.wall_ahead_m, Range{0.5, 60.0});
}

void fields(auto& v, HandTable& h) {
  v("distances_m", h.distances_m, Range{1.7, 20.0});
  v("target_height_m", h.target_height_m, Range{0.11, 2.0});
  v("kicks_per_distance", h.kicks_per_distance, Range{1.0, 100.0});
  v("eye_height_sd_m", h.eye_height_sd_m, Range{0.0, 2.0});
  v("eye_bias_sd_m", h.eye_bias_sd_m, Range{0.0, 2.0});
  v("day_sd_ratio", h.day_sd_ratio, Range{0.0, 0.15});
  v("one_for_all", h.one_for_all);
}

void fields(auto& v, Scenario& s) {
  v("cycle_s", s.cycle_s, Range{0.001, 0.5});
  v("substep_s", s.substep_s, Range{0.00001, 0.02});
  v("field", s.field);
  v("rules", s.rules);
  v("ball", s.ball);
  v("robot", s.robot);
  v("kicker", s.kicker);
  v("possession", s.possession);
  v("opponent", s.opponent);
  v("keeper", s.keeper);
  v("defenders", s.defenders);
  v("referee", s.referee);
  v("team", s.team);
  v("odometry", s.odometry);
  v("vision", s.vision);
  v("flight_camera", s.flight_camera);
  v("laser", s.laser);
  v("hand_table", s.hand_table);
}

/// What is wrong with a scenario: the dotted key and a sentence.
struct Problem {
  std::string key;
  std::string why;
};

/// The first rule that `scenario` breaks: a value outside its range, a minimum above its maximum, tables of unequal
/// length, powers that do not rise, a base of other than 3 or 4 wheels, a count that is not whole. None: the scenario
/// can be played.
std::optional<Problem> first_problem(const Scenario& scenario);

}  // namespace trivela::sim
