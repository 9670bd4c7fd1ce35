#include "experiment/study/sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "config/text/error.hpp"

namespace trivela::experiment {
namespace {

/// An input with the value that the scenario, or the first arm's settings, have.
struct Known {
  UncertainInput input;
  std::string value;
  double largest = 0.0;  ///< change by it, without its sign
};

/// Gives rows behind the first world's, `arms` a world, what they change of its differences, and the inputs the
/// largest change.
void compare(std::vector<StudyRow>& rows, std::size_t arms, Measure measure, std::vector<Known>& inputs) {
  for (std::size_t i = arms; i < rows.size(); ++i) {
    const std::size_t arm = i % arms;
    if (arm == 0) continue;
    const Term terms[] = {{&rows[i].matches, 1.0},
                          {&rows[i - 1].matches, -1.0},
                          {&rows[arm].matches, -1.0},
                          {&rows[arm - 1].matches, 1.0}};
    rows[i].changes = {contrast(terms, measure)};
    for (Known& known : inputs)
      if (known.input.key == rows[i].label("input"))
        known.largest = std::max(known.largest, std::abs(rows[i].changes[0].value));
  }
}

/// The first world's rows, then those of each input.
void sort(std::vector<StudyRow>& rows, const std::vector<Known>& inputs) {
  std::map<std::string, std::size_t> places{{"", 0}};
  for (const Known& known : inputs) places.emplace(known.input.key, places.size());
  std::ranges::stable_sort(rows, {}, [&](const StudyRow& row) { return places.at(row.label("input")); });
}

Json value_of_text(const std::string& text) {
  const Json number = Json::parse(text, nullptr, false);
  return number.is_discarded() ? Json(text) : number;
}

StudyAnswer answer_of(const Study& study, std::vector<StudyRow>& rows, Measure measure, std::vector<Known> inputs) {
  const std::size_t arms = study.worlds.front().arms.size();
  compare(rows, arms, measure, inputs);
  std::ranges::stable_sort(inputs, std::ranges::greater{}, &Known::largest);
  sort(rows, inputs);
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
  for (const auto& [input, value, largest] : inputs) {
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
  const auto add = [&](const std::string& what, const std::string& key, const std::string& value,
                       const sim::Scenario& world) -> std::vector<Arm>& {
    StudyWorld& added = study.worlds.emplace_back(StudyWorld{what, world, arms});
    for (const Arm& arm : arms) added.labels.push_back({{"input", key}, {"value", value}, {"arm", arm.name}});
    return added.arms;
  };
  add("the scenario", "", "", scenario);
  std::vector<Known> known;
  for (const UncertainInput& input : inputs) {
    const bool setting = is_setting(input.key);
    known.push_back({input, setting ? value_of(arms.front().settings, input.key) : value_of(scenario, input.key)});
    for (const std::string& value : {input.low, input.high}) {
      const std::string what = fmt::format("{} = {}", input.key, value);
      if (value == known.back().value) continue;
      if (setting) {
        for (Arm& arm : add(what, input.key, value, scenario)) arm.settings = with(arm.settings, input.key, value);
        continue;
      }
      try {
        add(what, input.key, value, with(scenario, input.key, value));
      } catch (const config::Error& error) {
        left_out(error.what());
      }
    }
  }
  study.answer = [=](const Study& asked, std::vector<StudyRow>& rows, const StudyPlayed&) {
    return answer_of(asked, rows, measure, known);
  };
  return study;
}

}  // namespace trivela::experiment
