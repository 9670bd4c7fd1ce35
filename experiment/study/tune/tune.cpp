#include "experiment/study/tune/tune.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "evaluator/render/text_table.hpp"

namespace trivela::experiment {
namespace {

Effect gain_of(const ArmTally& tried, const ArmTally& present) {
  return difference(tried, present, Measure::kPerOpportunity);
}

/// Sets one coordinate; true: to something else than before.
bool improve(const Coordinate& coordinate, int round, const PlaySettings& play, TuneState& state) {
  const std::string present = present_choice(state.settings, coordinate);
  const auto before = config::setting_values(state.settings);
  std::vector<config::Settings> candidates;
  for (const std::string& choice : coordinate.choices) {
    config::Settings candidate = with_choice(state.settings, choice);
    if (config::setting_values(candidate) == before) continue;
    candidates.push_back(std::move(candidate));
  }
  if (candidates.empty()) return false;
  std::vector<ArmTally> played = play(candidates);
  state.tried += candidates.size();
  const auto best = std::ranges::max_element(played, {}, [](const ArmTally& arm) { return total_of(arm).on_target; });
  const auto i = static_cast<std::size_t>(best - played.begin());
  const Effect gain = gain_of(*best, state.best);
  if (!((has_interval(gain) ? gain.ci.lo : gain.value) > 0.0)) return false;
  state.steps.push_back({round, present, present_choice(candidates[i], coordinate), gain});
  state.settings = std::move(candidates[i]);
  state.best = std::move(*best);
  return true;
}

namespace fs = std::filesystem;

std::string share(const ArmTally& arm) { return share_text(share_of(arm, Measure::kPerOpportunity)); }

std::string described(const StudyPlayed& matches) {
  const std::string robots =
      matches.calibrations == 0 ? "the robot files" : fmt::format("{} calibrations", matches.calibrations);
  return fmt::format("{} matches of {}, {}, seed {}", matches.matches, matches.possessions, robots, matches.seed);
}

/// "settle_s = 0.1, ..." of lines that begin with "policy.".
std::string in_one_line(const std::string& choice) {
  std::string text;
  for (const std::string& line : split(choice, '\n'))
    text += (text.empty() ? "" : ", ") + (line.starts_with("policy.") ? line.substr(7) : line);
  return text;
}

/// The outcome in lines: the same words for the terminal and the file.
std::string outcome(const TuneReport& report) {
  const TuneState& state = report.state;
  std::string text = fmt::format("tuned on {}: {} %, before {} %; {} settings were tried\n", described(report.tuning),
                                 share(state.best), share(state.start), state.tried);
  if (!state.finished) text += "interrupted: the best so far\n";
  if (!report.held_out_best)
    return text + "not tried on other matches: the share above is too good, it was chosen by\n";
  text += fmt::format("held out, {}: {} %, before {} %; gain {} points where {} were seen\n",
                      described(report.held_out), share(*report.held_out_best), share(*report.held_out_start),
                      points_text(gain_of(*report.held_out_best, *report.held_out_start)),
                      points_text(gain_of(state.best, state.start)));
  return text;
}

/// Keys below [policy] that the file names, with their values.
std::map<std::string, std::string> named(const TuneReport& report) {
  const auto values = config::setting_values(report.state.settings);
  const auto defaults = config::setting_values({});
  std::set<std::string> searched;
  for (const Coordinate& coordinate : report.space)
    for (const std::string& line : split(coordinate.choices.front(), '\n'))
      searched.insert(line.substr(0, line.find(" = ")));
  std::map<std::string, std::string> kept;
  for (const auto& [key, value] : values) {
    const bool own = key.starts_with("policy.") && (searched.contains(key) || defaults.at(key) != value);
    if (own) kept[key] = value;
  }
  return kept;
}

}  // namespace

void coordinate_search(const std::vector<Coordinate>& space, int rounds, const PlaySettings& play, TuneState& state) {
  state.start = state.best = play({state.settings}).front();
  ++state.tried;
  for (int round = 1; round <= rounds; ++round) {
    bool changed = false;
    for (const Coordinate& coordinate : space) changed = improve(coordinate, round, play, state) || changed;
    if (!changed) break;
  }
  state.finished = true;
}

std::string to_text(const TuneReport& report) {
  std::string text = fmt::format(
      "SIMULATED: settings of {} for the world {}; observed shots on target per opportunity, 95 % intervals.\n\n",
      report.policy, report.tuning.scenario);
  std::vector<std::vector<std::string>> rows{{"round", "from", "to", "gain [points]"}};
  for (const TuneStep& step : report.state.steps)
    rows.push_back(
        {fmt::format("{}", step.round), in_one_line(step.from), in_one_line(step.to), points_text(step.gain)});
  text += report.state.steps.empty() ? "Nothing was found that is better.\n" : evaluator::text_table(rows);
  return text + '\n' + outcome(report);
}

std::string to_settings_file(const TuneReport& report, const fs::path& out) {
  std::string text = fmt::format(
      "# Settings of {} for the world {}, simulated, found by\n#   {}\n# Objective: observed shots on target per "
      "opportunity [%], 95 % intervals by match{}.\n",
      report.policy, report.tuning.scenario, report.command, report.tuning.calibrations > 0 ? " and calibration" : "");
  for (const std::string& line : split(outcome(report), '\n')) text += "# " + line + '\n';
  const fs::path folder = fs::absolute(out).parent_path();
  const auto relative = [&](const std::string& file) {
    return fs::relative(fs::absolute(file), folder).generic_string();
  };
  const config::Run& run = report.state.settings.run;
  text += fmt::format("\n[run]\nrobot = \"{}\"\nscenario = \"{}\"\n", relative(run.robot), relative(run.scenario));
  std::map<std::string, std::string> sections;  // text by name
  for (const auto& [key, value] : named(report)) {
    const auto dot = key.rfind('.');
    sections[key.substr(0, dot)] += fmt::format("{} = {}\n", key.substr(dot + 1), value);
  }
  for (const auto& [section, keys] : sections) text += fmt::format("\n[{}]\n{}", section, keys);
  return text;
}

}  // namespace trivela::experiment
