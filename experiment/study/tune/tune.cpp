#include "experiment/study/tune/tune.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "config/arms.hpp"
#include "config/text/csv_row.hpp"
#include "config/text/error.hpp"
#include "config/text/installation.hpp"
#include "evaluator/render/text_table.hpp"

namespace trivela::experiment {
namespace {

namespace fs = std::filesystem;
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

Effect gain_of(const ArmTally& tried, const ArmTally& present) {
  return difference(tried, present, Measure::kPerOpportunity);
}

/// Sets one coordinate; true: to something else than before.
bool improve(const Coordinate& coordinate, int round, const PlaySettings& play, Tuning& tuning) {
  const auto before = config::setting_values(tuning.settings);
  std::vector<config::Settings> candidates;
  for (const Choice& choice : coordinate.choices) {
    config::Settings candidate = with_choice(tuning.settings, choice);
    if (config::setting_values(candidate) != before) candidates.push_back(std::move(candidate));
  }
  if (candidates.empty()) return false;
  const std::vector<ArmTally> played = play(candidates);
  tuning.tried += candidates.size();
  const auto best = std::ranges::max_element(played, {}, [](const ArmTally& arm) { return total_of(arm).on_target; });
  const Effect gain = gain_of(*best, tuning.best);
  if (!((has_interval(gain) ? gain.ci.lo : gain.value) > 0.0)) return false;
  const Choice present = present_choice(tuning.settings, coordinate);
  tuning.settings = candidates[static_cast<std::size_t>(best - played.begin())];
  tuning.best = *best;
  tuning.steps.push_back({round, present, present_choice(tuning.settings, coordinate), gain});
  return true;
}

std::string share(const ArmTally& arm) { return share_text(share_of(arm, Measure::kPerOpportunity)); }

std::string described(const StudyPlayed& matches) {
  const std::string robots =
      matches.calibrations == 0 ? "the robot files" : fmt::format("{} calibrations", matches.calibrations);
  return fmt::format("{} matches of {}, {}, seed {}", matches.matches, matches.possessions, robots, matches.seed);
}

/// "settle_s = 0.1, ..." of lines that begin with "policy.".
std::string in_one_line(Choice lines) {
  for (std::string& line : lines)
    if (line.starts_with("policy.")) line.erase(0, 7);
  return fmt::format("{}", fmt::join(lines, ", "));
}

/// The outcome: the same lines for the terminal and the file.
std::vector<std::string> outcome(const Tuning& tuning) {
  std::vector<std::string> lines{fmt::format("tuned on {}: {} %, before {} %; {} settings were tried",
                                             described(tuning.tuning), share(tuning.best), share(tuning.start),
                                             tuning.tried)};
  if (!tuning.finished) lines.emplace_back("interrupted: the best so far");
  if (tuning.held_out_played.empty()) {
    lines.emplace_back("not tried on other matches: the share above is too good, it was chosen by");
    return lines;
  }
  const ArmTally &start = tuning.held_out_played[0], &best = tuning.held_out_played[1];
  lines.push_back(fmt::format("held out, {}: {} %, before {} %; gain {} points where {} were seen",
                              described(tuning.held_out), share(best), share(start), points_text(gain_of(best, start)),
                              points_text(gain_of(tuning.best, tuning.start))));
  return lines;
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

void coordinate_search(int rounds, const PlaySettings& play, Tuning& tuning) {
  tuning.start = tuning.best = play({tuning.settings}).front();
  ++tuning.tried;
  bool changed = true;
  for (int round = 1; round <= rounds && changed; ++round) {
    changed = false;
    for (const Coordinate& coordinate : tuning.space) changed = improve(coordinate, round, play, tuning) || changed;
  }
  tuning.finished = true;
}

std::string to_text(const Tuning& tuning) {
  std::vector<std::vector<std::string>> rows{{"round", "from", "to", "gain [points]"}};
  for (const TuneStep& step : tuning.steps)
    rows.push_back(
        {fmt::format("{}", step.round), in_one_line(step.from), in_one_line(step.to), points_text(step.gain)});
  return fmt::format(
      "SIMULATED: settings of {} for the world {}; observed shots on target per opportunity, 95 % intervals.\n\n{}\n"
      "{}\n",
      tuning.policy, tuning.tuning.scenario,
      tuning.steps.empty() ? "Nothing was found that is better.\n" : evaluator::text_table(rows),
      fmt::join(outcome(tuning), "\n"));
}

std::string to_settings_file(const Tuning& tuning, const fs::path& out) {
  const fs::path folder = fs::absolute(out).parent_path();
  const auto relative = [&](const std::string& file) {
    return fs::relative(fs::absolute(file), folder).generic_string();
  };
  std::string text = fmt::format(
      "# Settings of {} for the world {}, simulated, found by\n#   {}\n# Objective: observed shots on target per "
      "opportunity [%], 95 % intervals by match{}.\n# {}\n\n[run]\nrobot = \"{}\"\nscenario = \"{}\"\n",
      tuning.policy, tuning.tuning.scenario, tuning.command, tuning.tuning.calibrations > 0 ? " and calibration" : "",
      fmt::join(outcome(tuning), "\n# "), relative(tuning.settings.run.robot), relative(tuning.settings.run.scenario));
  const auto defaults = config::setting_values({});
  std::vector<std::string> searched;  // lines
  for (const Coordinate& coordinate : tuning.space)
    for (const std::string& line : present_choice(tuning.settings, coordinate)) searched.push_back(line);
  std::map<std::string, std::string> sections;  // text by name
  for (const auto& [key, value] : config::setting_values(tuning.settings)) {
    if (!key.starts_with("policy.") ||
        (defaults.at(key) == value && std::ranges::count(searched, fmt::format("{} = {}", key, value)) == 0))
      continue;
    const auto dot = key.rfind('.');
    sections[key.substr(0, dot)] += fmt::format("{} = {}\n", key.substr(dot + 1), value);
  }
  for (const auto& [section, keys] : sections) text += fmt::format("\n[{}]\n{}", section, keys);
  return text;
}

}  // namespace trivela::experiment
