#include "experiment/study/studies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "config/text/error.hpp"

namespace trivela::experiment {
namespace {

/// Gives rows behind the first world's, `arms` a world, what they change of its differences. The largest change by each
/// input, without its sign; beyond all that of none.
std::map<std::string, double> compare(std::vector<StudyRow>& rows, std::size_t arms, Measure measure) {
  std::map<std::string, double> largest{{"", std::numeric_limits<double>::infinity()}};
  for (std::size_t i = arms; i < rows.size(); ++i) {
    const std::size_t arm = i % arms;
    if (arm == 0) continue;
    const Term terms[] = {{&rows[i].matches, 1.0},
                          {&rows[i - 1].matches, -1.0},
                          {&rows[arm].matches, -1.0},
                          {&rows[arm - 1].matches, 1.0}};
    rows[i].changes = {contrast(terms, measure)};
    double& change = largest[rows[i].label("input")];
    change = std::max(change, std::abs(rows[i].changes[0].value));
  }
  return largest;
}

Json value_of_text(const std::string& text) {
  const Json number = Json::parse(text, nullptr, false);
  return number.is_discarded() ? Json(text) : number;
}

StudyAnswer answer_of(const Study& study, std::vector<StudyRow>& rows, Measure measure,
                      std::vector<UncertainInput> inputs) {
  const StudyWorld& usual = study.worlds.front();
  const std::size_t arms = usual.arms.size();
  auto largest = compare(rows, arms, measure);
  std::ranges::stable_sort(inputs, std::ranges::greater{}, [&](const auto& input) { return largest[input.key]; });
  std::ranges::stable_sort(rows, std::ranges::greater{}, [&](const auto& row) { return largest[row.label("input")]; });
  const bool goals = measure == Measure::kGoals;
  StudyAnswer answer{
      .text = fmt::format("\n{} per 100 opportunities; no robot is calibrated again:\n",
                          goals ? "Goals past the keeper" : "Shots on target"),
      .more = {{"measure", goals ? "goals" : "on_target"}},
      .svg = chart_of({rows.begin() + static_cast<std::ptrdiff_t>(arms), rows.end()}, "arm", {}, study.changes)};
  for (std::size_t i = 1; i < arms; ++i) {
    const std::string name = fmt::format("{} - {}", rows[i].label("arm"), rows[i - 1].label("arm"));
    const Effect effect = difference(rows[i].matches, rows[i - 1].matches, measure);
    answer.text += fmt::format("  {}: {}\n", name, points_text(effect));
    Json line = json_of(effect);
    line["headline"] = name;
    answer.more["headlines"].push_back(std::move(line));
  }
  answer.text += "Instead of the values above it is:\n";
  for (const UncertainInput& input : inputs) {
    const std::string value = value_of({usual.scenario, usual.arms.front().settings}, input.key);
    answer.text += fmt::format("  {} = {} ({})\n", input.key, value, input.why);
    answer.more["inputs"].push_back({{"input", input.key}, {"value", value_of_text(value)}, {"why", input.why}});
  }
  return answer;
}

}  // namespace

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
