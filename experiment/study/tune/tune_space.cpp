#include "experiment/study/tune/tune_space.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "config/arms.hpp"
#include "config/text/error.hpp"

namespace trivela::experiment {
namespace {

/// "KEY", "V1|V2".
Coordinate coordinate(const std::string& key, const std::string& values) {
  Coordinate made{key, {}};
  for (const std::string& value : split(values, '|')) made.choices.push_back(fmt::format("{} = {}", key, value));
  return made;
}

/// The paper's law has no height, the others have nothing but one: law and height are chosen together.
Coordinate height() {
  Coordinate made{"policy.height_law", {"policy.height_law = \"paper\"\npolicy.target_height_m = 0.7"}};
  for (const char* law : {"extended_range", "exact"})
    for (const char* height_m : {"0.2", "0.3", "0.4", "0.5", "0.6", "0.7"})
      made.choices.push_back(fmt::format("policy.height_law = \"{}\"\npolicy.target_height_m = {}", law, height_m));
  return made;
}

struct Tuned {
  kicking::PolicyName policy;
  const char* key;
  const char* values;
};
using enum kicking::PolicyName;
constexpr Tuned kTuned[] = {
    {kStopped, "policy.aim_tolerance_deg", "0.5|1.0|2.0|3.0|4.0|5.0|6.0|8.0"},
    {kStopped, "policy.settle_s", "0.0|0.02|0.04|0.06|0.1|0.15|0.25|0.4"},
    // At rest stays at rest: faster than this it would be a moving policy that allows for no motion.
    {kStopped, "policy.rest_speed_mps", "0.1|0.15|0.2|0.25|0.3"},
    {kStopped, "policy.rest_turn_rate_radps", "0.1|0.15|0.2|0.3|0.4|0.5"},
    {kStopped, "policy.stopped_turn_gain_hz", "3.0|4.0|6.0|8.0|12.0|16.0"},
    {kStopped, "policy.dribble_mps", "0.6|0.9|1.2|1.6|2.0"},
    {kMoving, "policy.motion_law", "\"paper\"|\"exact\""},
    {kMoving, "policy.alpha_law", "\"paper_line\"|\"physical\""},
    {kMoving, "policy.alignment.half_width_m", "0.05|0.1|0.2|0.3|0.4|0.5|0.6|0.7|0.8|0.9|1.0"},
    {kMoving, "policy.alignment.extension", "\"max\"|\"add\""},
    {kMoving, "policy.moving_turn_gain_hz", "6.0|8.0|12.0|16.0|24.0|40.0"},
    {kMoving, "policy.dribble_mps", "0.0|0.3|0.6|0.9|1.2|1.6|2.0"},
    {kMoving, "policy.keep_off_m", "1.5|2.0|2.5|3.0|4.0"},
    {kPredictive, "policy.predictive.threshold", "0.0|0.1|0.2|0.3|0.4|0.5"},
    {kPredictive, "policy.predictive.bounce_ratio", "0.6|0.7|0.8|0.9|0.95|1.0"},
    {kPredictive, "policy.predictive.position_sd_m", "0.06|0.09|0.12|0.16|0.2"},
    {kPredictive, "policy.predictive.heading_sd_deg", "0.4|0.8|1.2|1.6"},
    {kPredictive, "policy.predictive.speed_sd_mps", "0.0|0.05|0.1|0.2"},
    {kPredictive, "policy.predictive.turn_rate_sd_radps", "0.0|0.05|0.1|0.2"},
    {kPredictive, "policy.predictive.twist_lag_s", "0.0|0.02|0.04"},
    {kPredictive, "policy.predictive.closing_mps", "0.7|1.0|1.3|1.6"},
    {kPredictive, "policy.predictive.closing_sd_mps", "0.25|0.5|0.8"},
    {kPredictive, "policy.predictive.closing_walk_mps2", "0.2|0.5|1.0"},
    {kPredictive, "policy.predictive.dispute_distance_m", "0.4|0.45|0.5|0.55|0.6|0.7"},
    {kPredictive, "policy.predictive.hazard_per_s", "0.02|0.05|0.1|0.2|0.4"},
    {kPredictive, "policy.predictive.horizon_s", "0.6|0.9|1.2|1.6"},
    {kPredictive, "policy.dribble_mps", "0.0|0.3|0.6|0.9|1.2|1.6|2.0"},
    {kPredictive, "policy.keep_off_m", "1.5|2.0|2.5|3.0|4.0"}};

/// Seven values of each setting, from its least to its greatest, and the usual one.
std::vector<Coordinate> of_own(const kicking::Policy& policy) {
  constexpr int kValues = 7;
  std::vector<Coordinate> space;
  for (const kicking::PolicySetting& setting : policy.settings()) {
    std::set<double> values{setting.usual};
    for (int i = 0; i < kValues; ++i)
      values.insert(setting.range.min + (setting.range.max - setting.range.min) * i / (kValues - 1));
    Coordinate made{fmt::format("policy.own.{}.{}", policy.facts().name, setting.key), {}};
    for (const double value : values) made.choices.push_back(fmt::format("{} = {:e}", made.name, value));
    space.push_back(std::move(made));
  }
  return space;
}

}  // namespace

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream rest{text};
  for (std::string part; std::getline(rest, part, at);) parts.push_back(part);
  return parts;
}

std::vector<std::string> tuned_policies() {
  std::vector<std::string> names;
  for (const auto policy : {kStopped, kMoving, kPredictive}) names.emplace_back(kicking::name(policy));
  for (const kicking::Policy* own : kicking::policies().subspan(kicking::kPolicyCount))
    if (!own->facts().needs_program() && !own->settings().empty()) names.emplace_back(own->facts().name);
  return names;
}

std::vector<Coordinate> tuned_space(kicking::PolicyName policy) {
  std::vector<Coordinate> space;
  if (policy == kStopped || policy == kMoving) space.push_back(height());
  for (const Tuned& tuned : kTuned)
    if (tuned.policy == policy) space.push_back(coordinate(tuned.key, tuned.values));
  if (!space.empty()) return space;
  if (from_outside(policy)) return of_own(*kicking::policies()[static_cast<std::size_t>(policy)]);
  throw std::invalid_argument{fmt::format("{} has no settings to choose", kicking::name(policy))};
}

Coordinate coordinate_of(const std::string& text, const std::vector<Coordinate>& space, const std::string& called) {
  const auto refuse = [&](const std::string& why) {
    throw config::BadArgument{fmt::format("{} {}: {}", called, text, why)};
  };
  const std::string key = text.substr(0, text.find('='));
  const auto known = config::setting_values({});
  if (!key.starts_with("policy.") || key.starts_with("policy.test_drive.") || !known.contains(key))
    refuse(fmt::format("\"{}\" is no setting of [policy] (config/default.toml)", key));
  if (key.size() == text.size()) {
    const auto found = std::ranges::find(space, key, &Coordinate::name);
    if (found != space.end()) return *found;
    refuse(fmt::format("write its values, too: {} '{}=V1|V2'", called, key));
  }
  Coordinate made = coordinate(key, text.substr(key.size() + 1));
  std::set<std::string> values;
  try {
    for (const std::string& choice : made.choices)
      values.insert(config::setting_values(with_choice({}, choice)).at(key));
  } catch (const config::Error& error) {
    refuse(error.what());
  }
  if (values.size() < 2 || values.size() != made.choices.size())
    refuse(fmt::format("two or more values, each once: {} '{}=V1|V2'", called, key));
  return made;
}

config::Settings with_choice(config::Settings settings, const std::string& choice) {
  for (const std::string& line : split(choice, '\n')) config::override_setting(settings, {line, line});
  return settings;
}

std::string present_choice(const config::Settings& settings, const Coordinate& coordinate) {
  const auto values = config::setting_values(settings);
  std::vector<std::string> lines;
  for (const std::string& line : split(coordinate.choices.front(), '\n')) {
    const std::string key = line.substr(0, line.find(" = "));
    lines.push_back(fmt::format("{} = {}", key, values.at(key)));
  }
  return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace trivela::experiment
