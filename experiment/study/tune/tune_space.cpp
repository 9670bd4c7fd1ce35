#include "experiment/study/tune/tune.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>

#include "config/arms.hpp"
#include "config/text/csv_row.hpp"
#include "config/text/error.hpp"
#include "config/text/installation.hpp"

namespace trivela::experiment {
namespace {

using enum kicking::PolicyName;

/// The parts of a text between these characters, without blanks around them.
std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream rest{text};
  for (std::string part; std::getline(rest, part, at);) parts.push_back(config::trimmed(part));
  return parts;
}

/// "KEY", "V1|V2".
Coordinate coordinate(const std::string& key, const std::string& values) {
  Coordinate made{key, {}};
  for (const std::string& value : split(values, '|')) made.choices.push_back({fmt::format("{} = {}", key, value)});
  return made;
}

/// Seven values of each setting, from its least to its greatest, and the usual one.
std::vector<Coordinate> of_own(const kicking::Policy& policy) {
  constexpr int kValues = 7;
  std::vector<Coordinate> space;
  for (const kicking::PolicySetting& setting : policy.settings()) {
    std::set<double> values{setting.usual};
    for (int i = 0; i < kValues; ++i)
      values.insert(setting.range.min + (setting.range.max - setting.range.min) * i / (kValues - 1));
    Coordinate made{fmt::format("policy.own.{}.{}", policy.facts().name, setting.key), {}};
    for (const double value : values) made.choices.push_back({fmt::format("{} = {:e}", made.name, value)});
    space.push_back(std::move(made));
  }
  return space;
}

}  // namespace

std::vector<std::string> tuned_policies() {
  std::vector<std::string> names;
  for (const auto policy : {kStopped, kMoving, kPredictive}) names.emplace_back(kicking::name(policy));
  for (const kicking::Policy* own : kicking::policies().subspan(kicking::kPolicyCount))
    if (!own->facts().needs_program() && !own->settings().empty()) names.emplace_back(own->facts().name);
  return names;
}

std::vector<Coordinate> tuned_space(kicking::PolicyName policy) {
  std::vector<Coordinate> space;
  config::each_row(config::shipped("studies/tune.csv"), [&](const config::Row& row) {
    if (row.word("policy") != kicking::name(policy)) return;
    space.push_back(coordinate(row.word("setting").value_or(""), row.word("values").value_or("")));
    for (Choice& choice : space.back().choices) choice = split(choice.front(), ';');
  });
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
    for (const Choice& choice : made.choices) values.insert(config::setting_values(with_choice({}, choice)).at(key));
  } catch (const config::Error& error) {
    refuse(error.what());
  }
  if (values.size() < 2 || values.size() != made.choices.size())
    refuse(fmt::format("two or more values, each once: {} '{}=V1|V2'", called, key));
  return made;
}

config::Settings with_choice(config::Settings settings, const Choice& choice) {
  for (const std::string& line : choice) config::override_setting(settings, {line, line});
  return settings;
}

Choice present_choice(const config::Settings& settings, const Coordinate& coordinate) {
  const auto values = config::setting_values(settings);
  Choice lines = coordinate.choices.front();
  for (std::string& line : lines) {
    const std::string key = line.substr(0, line.find(" = "));
    line = fmt::format("{} = {}", key, values.at(key));
  }
  return lines;
}

}  // namespace trivela::experiment
