#include "experiment/sensitivity/inputs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "config/settings_fields.hpp"
#include "kicking/geometry/angle.hpp"
#include "sim/scenario_fields.hpp"

namespace trivela::experiment {
namespace {

const std::string kSection = "policy.";

constexpr UncertainInput kInputs[] = {
    {"ball.drag_coefficient", 0.20, 0.35, "spread of published footballs below 12 m/s"},
    {"ball.restitution_ratio", 0.60, 0.75, "carpet, soft to hard"},
    {"ball.retention_ratio", 0.60, 0.95, "rough to smooth floor"},
    {"ball.mass_kg", 0.41, 0.45, "FIFA size 5"},
    {"ball.radius_m", 0.108, 0.1114, "FIFA size 5"},
    {"ball.air_density_kgpm3", 1.0, 1.29, "1,800 m above the sea; at freezing point"},
    {"ball.roll_below_mps", 0.1, 0.6, "a third, twice"},
    {"ball.rolling_deceleration_mps2", 0.2, 1.0, "smooth floor to carpet"},
    {"ball.frame_restitution_ratio", 0.2, 0.8, "loose frame, stiff one"},
    {"ball.body_restitution_ratio", 0.1, 0.6, "a third, twice"},
    {"robot.max_acceleration_mps2", 1.5, 4.0, "ball nearly lost, to a good handler"},
    {"robot.max_turn_rate_radps", 1.5, 4.0, "ball nearly lost, to a good handler"},
    {"robot.max_turn_acceleration_radps2", 3.0, 8.0, "Falcons configuration; twice the default"},
    {"robot.max_speed_mps", 1.5, 3.0, "two thirds, one and a third"},
    {"robot.ball_offset_m", 0.25, 0.29, "2 cm off"},
    {"robot.wheel_radius_m", 0.049, 0.051, "rollers 2 % off"},
    {"robot.wheel_distance_m", 0.21, 0.23, "5 % off"},
    {"kicker.drift_sd_ratio", 0.0, 0.03, "a day without change; that of the hand table nearly"},
    {"kicker.delay_s", 0.05, 0.08, "CAMBADA release 1.0: mean, maximum"},
    {"kicker.delay_sd_s", 0.005, 0.03, "a third, twice"},
    {"kicker.speed_sd_ratio", 0.01, 0.04, "half, twice"},
    {"kicker.direction_sd_deg", 0.5, 3.0, "a third, twice"},
    {"kicker.transfer_forward_ratio", 0.8, 1.0, "a fifth lost to the floor; none"},
    {"kicker.transfer_lateral_ratio", 0.8, 1.0, "a fifth lost to the floor; none"},
    {"kicker.speed_scale_ratio", 0.97, 1.03, "3 % slower or faster than it was calibrated"},
    {"kicker.transfer_backward_ratio", 0.8, 1.0, "a fifth lost to the floor; none"},
    {"kicker.charge_per_kick_ratio", 0.25, 0.9, "half; nearly all"},
    {"kicker.recharge_per_s", 0.15, 1.0, "half, three times"},
    {"possession.goal_distance_min_m", 1.5, 4.0, "gained near the goal, or farther"},
    {"possession.goal_distance_max_m", 7.0, 11.0, "never far, or beyond the middle"},
    {"possession.lateral_max_m", 1.5, 5.0, "before the goal, or over the field's width"},
    {"possession.aim_error_sd_deg", 30.0, 120.0, "mostly facing the goal; any way"},
    {"possession.speed_max_mps", 1.0, 2.2, "half; the robot's own limit"},
    {"possession.travel_direction_sd_deg", 15.0, 90.0, "mostly forward; any way"},
    {"possession.speed_min_mps", 0.0, 0.8, "from rest; always on the run"},
    {"possession.time_limit_s", 4.0, 12.0, "half, one and a half"},
    {"possession.stop_s", 0.3, 1.0, "hardly found itself; long"},
    {"possession.flight_limit_s", 2.0, 5.0, "two thirds, nearly twice"},
    {"possession.after_crossing_s", 0.1, 0.4, "half, twice"},
    {"opponent.count", 1.0, 5.0, "one, a whole team"},
    {"opponent.distance_median_m", 1.0, 2.5, "19 situations of one log; other leagues and opponents"},
    {"opponent.closing_min_mps", 0.3, 1.2, "half, one and a half"},
    {"opponent.closing_max_mps", 1.3, 3.0, "two thirds, one and a half"},
    {"opponent.dispute_distance_m", 0.4, 0.8, "bodies touch; an arm's length"},
    {"opponent.distance_sigma_ln", 0.35, 0.8, "two thirds, one and a half"},
    {"opponent.further_median_m", 2.5, 6.0, "matters with more than one"},
    {"opponent.body_radius_m", 0.2, 0.3, "a narrow one; two at once"},
    {"opponent.body_height_m", 0.4, 0.8, "half; the rules' limit"},
    {"keeper.reaction_s", 0.15, 0.5, "sense to act alone (CAMBADA, 140 ms); twice"},
    {"keeper.sight_sd_mps", 0.2, 1.5, "0.04 m a picture; three times"},
    {"keeper.speed_mps", 1.0, 3.0, "half, one and a half"},
    {"keeper.acceleration_mps2", 2.0, 6.0, "half, one and a third"},
    {"keeper.half_width_m", 0.2, 0.3, "a narrow one; the frame always out"},
    {"keeper.height_m", 0.5, 0.9, "low; the frame always out"},
    {"keeper.overlap_m", 0.0, 0.11, "a touch; half the ball"},
    {"keeper.side_extension_m", 0.0, 0.3, "none; a wide one"},
    {"keeper.up_extension_m", 0.0, 0.2, "none; twice"},
    {"keeper.extension_s", 0.05, 0.3, "half, three times"},
    {"defenders.line_distance_m", 0.75, 2.25, "edge of the goal area, of the penalty area"},
    {"defenders.spread_sd_m", 0.25, 1.0, "half, twice"},
    {"defenders.reaction_s", 0.15, 0.5, "as the keeper's"},
    {"defenders.sight_sd_mps", 0.2, 1.5, "as the keeper's"},
    {"defenders.speed_mps", 1.0, 3.0, "half, one and a half"},
    {"defenders.acceleration_mps2", 2.0, 6.0, "half, one and a third"},
    {"defenders.half_width_m", 0.2, 0.3, "a narrow one; a wide one"},
    {"defenders.height_m", 0.4, 0.8, "half; the rules' limit"},
    {"defenders.overlap_m", 0.0, 0.11, "a touch; half the ball"},
    {"referee.stops_per_min", 0.0, 3.0, "none; six times"},
    {"odometry.wheel_sd_radps", 0.2, 1.8, "a third, three times"},
    {"odometry.slip_sd_ratio", 0.0, 0.06, "none; three times"},
    {"odometry.gyro_bias_sd_radps", 0.0, 0.05, "none; five times"},
    {"odometry.gyro_sd_radps", 0.005, 0.06, "a quarter, three times"},
    {"vision.latency_s", 0.03, 0.10, "half; with the rest of 140 ms sense-to-act"},
    {"vision.position_white_sd_m", 0.02, 0.12, "all of the published noise slow; all of it white"},
    {"vision.position_slow_sd_m", 0.03, 0.20, "a quarter, nearly twice"},
    {"vision.heading_white_sd_deg", 0.2, 1.5, "a third, nearly three times"},
    {"vision.heading_slow_sd_deg", 0.2, 1.5, "a third, nearly three times"},
    {"vision.slow_time_s", 0.5, 8.0, "a quarter, four times"},
    {"vision.opponent_sd_m", 0.05, 0.40, "a third, three times"},
    {"vision.dropout_ratio", 0.0, 0.20, "none; every fifth frame"},
    {"vision.ball_sd_m", 0.01, 0.05, "half, two and a half times"},
    {"vision.ball_sd_ratio", 0.005, 0.05, "a quarter, two and a half times"},
    {"vision.ball_range_m", 5.0, 12.0, "two thirds, one and a half"},
    {"vision.ball_height_max_m", 0.25, 0.8, "two thirds, twice"},
    {"vision.opponent_range_m", 3.0, 9.0, "half, one and a half"},
    {"flight_camera.position_sd_m", 0.01, 0.10, "a third, three times: what is observed, not what is kicked"},
    {"flight_camera.latency_s", 0.02, 0.1, "half, two and a half times"},
    {"flight_camera.period_s", 0.02, 0.1, "each cycle; ten frames a second"},
    {"flight_camera.dropout_ratio", 0.0, 0.2, "none; every fifth frame"},
    {"hand_table.eye_height_sd_m", 0.05, 0.30, "a third, twice: arms with the old table alone"},
    {"hand_table.day_sd_ratio", 0.0, 0.06, "the same day; half as much again"},
    {"hand_table.kicks_per_distance", 1.0, 10.0, "one; an afternoon of them"},
    {"hand_table.target_height_m", 0.4, 0.8, "low; nearly at the bar"},
};

/// Settings of the policies: what the comparison of policies rests on beside the world. Laws by their place.
constexpr UncertainInput kSettings[] = {
    {"policy.height_law", 0, 2, "the paper's range law; the crossing of the target"},
    {"policy.motion_law", 0, 1, "the paper's V0 - k v cos(theta); velocities added at the release"},
    {"policy.alpha_law", 0, 1, "the paper's line; velocities added"},
    {"policy.target_height_m", 0.3, 0.8, "low; nearly at the bar; the paper's height law has none"},
    {"policy.alignment.half_width_m", 0.1, 1.0, "the paper's w; the whole goal"},
    {"policy.alignment.extension", 0, 1, "max(w, d tan beta); w + d tan beta"},
    {"policy.aim_tolerance_deg", 0.5, 8.0, "finer than the compass; half the goal from 7 m"},
    {"policy.settle_s", 0.0, 0.4, "none; longer than the Falcons'"},
    {"policy.rest_speed_mps", 0.1, 0.3, "two standard deviations of odometry; twice the assumed one"},
    {"policy.rest_turn_rate_radps", 0.1, 0.5, "two standard deviations of odometry; thrice the assumed one"},
    {"policy.stopped_turn_gain_hz", 3.0, 16.0, "half; nearly three times"},
    {"policy.moving_turn_gain_hz", 6.0, 40.0, "half; three times"},
    {"policy.dribble_mps", 0.0, 2.2, "stands where it gained the ball; the limit with the ball"},
    {"policy.keep_off_m", 1.5, 4.0, "near; far"},
    {"policy.predictive.threshold", 0.0, 0.6, "none; careful"},
    {"policy.predictive.horizon_s", 0.4, 2.0, "a third; nearly twice"},
    {"policy.predictive.step_s", 0.02, 0.1, "every cycle; every fifth"},
    {"policy.predictive.bounce_ratio", 0.5, 1.0, "every second bounces over; all go in"},
    {"policy.predictive.position_sd_m", 0.05, 0.25, "half; twice the published noise"},
    {"policy.predictive.heading_sd_deg", 0.2, 2.0, "a quarter; two and a half times"},
    {"policy.predictive.speed_sd_mps", 0.0, 0.2, "none; four times"},
    {"policy.predictive.turn_rate_sd_radps", 0.0, 0.2, "none; four times"},
    {"policy.predictive.twist_lag_s", 0.0, 0.06, "none; three times"},
    {"policy.predictive.dispute_distance_m", 0.3, 0.8, "the bodies overlap; an arm's length"},
    {"policy.predictive.closing_mps", 0.3, 2.0, "the log of 2016; half as fast again"},
    {"policy.predictive.closing_sd_mps", 0.2, 1.0, "a third; twice"},
    {"policy.predictive.closing_walk_mps2", 0.1, 1.5, "a fifth; three times"},
    {"policy.predictive.opponent_sd_m", 0.05, 0.4, "a third; three times"},
    {"policy.predictive.opponent_lag_s", 0.0, 0.12, "none; twice"},
    {"policy.predictive.hazard_per_s", 0.02, 0.5, "a fifth; five times"},
    {"policy.predictive.opponent_radius_m", 0.2, 0.3, "a narrow one; two at once"},
    {"policy.predictive.opponent_height_m", 0.4, 0.8, "half; the rules' limit"},
};

/// Finds one number or law by its key, reads it and may set it.
struct Finder {
  std::string_view key;
  std::optional<double> set;
  std::string section{};
  std::optional<double> found{};
  std::string label{};  // of a law

  bool is(std::string_view name) const {
    return key.size() == section.size() + name.size() && key.starts_with(section) && key.ends_with(name);
  }

  template <class T, class... Limits>
  void operator()(std::string_view name, T&& field, const Limits&... limits) {
    using Field = std::remove_cvref_t<T>;
    if constexpr (std::same_as<Field, double>) {
      if (is(name)) number(field, field, 1.0, limits...);
    } else if constexpr (std::same_as<Field, kicking::Degrees>) {
      if (is(name)) number(field.rad, kicking::degrees(field.rad), kicking::radians(1.0), limits...);
    } else if constexpr (config::NamedEnum<Field>) {
      if (is(name)) law(field);
    } else if constexpr (config::Section<Field>) {
      const std::string outer = section;
      section += std::string{name} + '.';
      fields(*this, field);
      section = outer;
    }
  }

  /// `shown` is the field in the unit of its key, which is `unit` of the field's.
  void number(double& field, double shown, double unit, const auto&... limits) {
    found = shown;
    if (!set) return;
    ((limits.contains(*set) ? void() : refuse()), ...);
    field = *set * unit;
  }

  template <class E>
  void law(E& field) {
    const auto& entries = config::Names<E>::entries;
    if (set && (*set < 0.0 || *set > static_cast<double>(entries.size() - 1) || *set != std::floor(*set))) refuse();
    if (set) field = entries[static_cast<std::size_t>(*set)].second;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (entries[i].second != field) continue;
      found = static_cast<double>(i);
      label = entries[i].first;
    }
  }

  void refuse() const { throw std::invalid_argument{fmt::format("{} = {}: beyond its limits", key, *set)}; }
};

Finder visit(auto& where, const std::string& section, const std::string& key, std::optional<double> value) {
  Finder finder{key, value, section};
  fields(finder, where);
  if (finder.found) return finder;
  throw std::invalid_argument{
      fmt::format("\"{}\" is no number of a {}", key, section.empty() ? "scenario" : "policy's settings")};
}

std::vector<UncertainInput> all_inputs() {
  std::vector<UncertainInput> all{std::begin(kInputs), std::end(kInputs)};
  all.insert(all.end(), std::begin(kSettings), std::end(kSettings));
  return all;
}

}  // namespace

std::span<const UncertainInput> uncertain_inputs() {
  static const std::vector<UncertainInput> kAll = all_inputs();
  return kAll;
}

bool is_setting(std::string_view key) { return key.starts_with(kSection); }

bool in_force(const sim::Scenario& scenario, const UncertainInput& input) {
  const std::string_view key = input.key;
  if (key.starts_with("keeper.")) return scenario.keeper.enabled;
  return !key.starts_with("defenders.") || scenario.defenders.count > 0.0;
}

double value_of(const sim::Scenario& scenario, const std::string& key) {
  sim::Scenario copy = scenario;
  return *visit(copy, "", key, std::nullopt).found;
}

double value_of(const kicking::PolicyConfig& policy, const std::string& key) {
  kicking::PolicyConfig copy = policy;
  return *visit(copy, kSection, key, std::nullopt).found;
}

sim::Scenario with(const sim::Scenario& scenario, const std::string& key, double value) {
  sim::Scenario changed = scenario;
  visit(changed, "", key, value);
  if (const auto problem = sim::first_problem(changed)) {
    throw std::invalid_argument{fmt::format("{} = {}: {}: {}", key, value, problem->key, problem->why)};
  }
  return changed;
}

kicking::PolicyConfig with(const kicking::PolicyConfig& policy, const std::string& key, double value) {
  kicking::PolicyConfig changed = policy;
  visit(changed, kSection, key, value);
  return changed;
}

std::string value_text(const std::string& key, double value) {
  if (!is_setting(key)) return fmt::format("{:g}", value);
  kicking::PolicyConfig any;
  const std::string law = visit(any, kSection, key, value).label;
  return law.empty() ? fmt::format("{:g}", value) : law;
}

}  // namespace trivela::experiment
