#include "experiment/study/studies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "config/arms.hpp"
#include "config/text/csv_row.hpp"
#include "config/text/error.hpp"

namespace trivela::experiment {
namespace {

/// Is it a setting of the policies?
bool is_setting(const std::string& key) { return key.starts_with("policy."); }

/// As TOML has it: a number, or a law's name in quotes. Throws config::Error where the key has neither.
std::string toml_value_of(const Inputs& inputs, const std::string& key) {
  const auto values =
      is_setting(key) ? config::setting_values(inputs.settings) : config::scenario_values(inputs.scenario);
  const auto found = values.find(key);
  const bool holds = found != values.end() && (found->second.starts_with('"') ||
                                               found->second.find_first_not_of("+-.0123456789e") == std::string::npos);
  if (!holds)
    throw config::Error{
        fmt::format("\"{}\" is no number of a {}", key, is_setting(key) ? "policy's settings" : "scenario")};
  return found->second;
}

StudyReport answer_of(const Study& study, std::vector<StudyRow>& rows, Measure measure,
                      std::vector<UncertainInput> inputs) {
  const StudyWorld& usual = study.worlds.front();
  const std::size_t arms = usual.arms.size();
  // The largest change by each input, without its sign; beyond all that of none.
  std::map<std::string, double> largest{{"", std::numeric_limits<double>::infinity()}};
  for (std::size_t i = arms; i < rows.size(); ++i) {
    const std::size_t arm = i % arms;
    if (arm == 0) continue;
    rows[i].changes = {contrast({{&rows[i].matches, 1.0},
                                 {&rows[i - 1].matches, -1.0},
                                 {&rows[arm].matches, -1.0},
                                 {&rows[arm - 1].matches, 1.0}},
                                measure)};
    double& change = largest[rows[i].label("input")];
    change = std::max(change, std::abs(rows[i].changes[0].value));
  }
  std::ranges::stable_sort(inputs, std::ranges::greater{}, [&](const auto& input) { return largest[input.key]; });
  std::ranges::stable_sort(rows, std::ranges::greater{}, [&](const auto& row) { return largest[row.label("input")]; });
  const bool goals = measure == Measure::kGoals;
  StudyReport answer{
      .text = fmt::format("\n{} per 100 opportunities; no robot is calibrated again:\n",
                          goals ? "Goals past the keeper" : "Shots on target"),
      .json = {{"measure", goals ? "goals" : "on_target"}},
      .svg = chart_of({rows.begin() + static_cast<std::ptrdiff_t>(arms), rows.end()}, "arm", {}, study.changes)};
  for (std::size_t i = 1; i < arms; ++i) {
    const std::string name = fmt::format("{} - {}", rows[i].label("arm"), rows[i - 1].label("arm"));
    const Effect effect = difference(rows[i].matches, rows[i - 1].matches, measure);
    answer.text += fmt::format("  {}: {}\n", name, points_text(effect));
    answer.json["headlines"].push_back(json_of(effect));
    answer.json["headlines"].back()["headline"] = name;
  }
  answer.text += "Instead of the values above it is:\n";
  for (const UncertainInput& input : inputs) {
    const std::string value = value_of({usual.scenario, usual.arms.front().settings}, input.key);
    answer.text += fmt::format("  {} = {} ({})\n", input.key, value, input.why);
    const Json number = Json::parse(value, nullptr, false);
    answer.json["inputs"].push_back(
        {{"input", input.key}, {"value", number.is_discarded() ? Json(value) : number}, {"why", input.why}});
  }
  return answer;
}

}  // namespace

std::vector<UncertainInput> load_inputs(const std::string& path) {
  std::vector<UncertainInput> inputs;
  config::each_row(path, [&](const config::Row& row) {
    UncertainInput& input =
        inputs.emplace_back(UncertainInput{row.word("key").value_or(""), row.word("low").value_or(""),
                                           row.word("high").value_or(""), row.word("why").value_or("")});
    if (!toml_value_of({}, input.key).starts_with('"')) {
      const double low = row.number("low"), high = row.number("high");
      if (!(low < high)) throw std::invalid_argument{"low is not below high"};
      input.low = fmt::format("{}", low);
      input.high = fmt::format("{}", high);
    }
    if (is_setting(input.key))
      for (const std::string& end : {input.low, input.high}) with({}, input.key, end);
  });
  if (inputs.empty()) throw config::Error{fmt::format("{}: names no input (key,low,high,why)", path)};
  return inputs;
}

bool in_force(const sim::Scenario& scenario, const UncertainInput& input) {
  const std::string& key = input.key;
  if (key.starts_with("keeper.") || key.starts_with("policy.keeper.")) return scenario.keeper.enabled;
  return !key.starts_with("defenders.") || scenario.defenders.count > 0.0;
}

std::string value_of(const Inputs& inputs, const std::string& key) {
  const std::string value = toml_value_of(inputs, key);
  return value.starts_with('"') ? value.substr(1, value.size() - 2) : fmt::format("{:g}", std::stod(value));
}

Inputs with(Inputs inputs, const std::string& key, const std::string& value) {
  const bool text = toml_value_of(inputs, key).starts_with('"');
  const std::string line = text ? fmt::format("{} = \"{}\"", key, value) : fmt::format("{} = {}", key, value);
  if (is_setting(key)) {
    config::override_setting(inputs.settings, {line, "input"});
  } else {
    config::override_scenario(inputs.scenario, line, "input");
  }
  return inputs;
}

Study sensitivity_study(const sim::Scenario& scenario, const std::vector<Arm>& arms,
                        const std::vector<UncertainInput>& inputs, Measure measure,
                        const std::function<void(const std::string&)>& left_out) {
  Study study{.name = "sensitivity",
              .whom = "arm and value",
              .changes = {{"change", "change of the difference to the arm before"}}};
  const auto add = [&](const std::string& key, const std::string& value) {
    StudyWorld world{key.empty() ? "the scenario" : fmt::format("{} = {}", key, value), scenario, arms};
    for (Arm& arm : world.arms) {
      world.labels.push_back({{"input", key}, {"value", value}, {"arm", arm.name}});
      if (key.empty()) continue;
      Inputs changed = with({scenario, std::move(arm.settings)}, key, value);
      arm.settings = std::move(changed.settings);
      world.scenario = std::move(changed.scenario);
    }
    study.worlds.push_back(std::move(world));
  };
  add("", "");
  for (const UncertainInput& input : inputs) {
    const std::string usual = value_of({scenario, arms.front().settings}, input.key);
    for (const std::string& value : {input.low, input.high}) {
      try {
        if (value != usual) add(input.key, value);
      } catch (const config::Error& error) {
        left_out(error.what());
      }
    }
  }
  study.answer = [=](const Study& asked, std::vector<StudyRow>& rows, const StudyPlayed&) {
    return answer_of(asked, rows, measure, inputs);
  };
  return study;
}

}  // namespace trivela::experiment
