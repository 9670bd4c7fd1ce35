#include "experiment/study/sensitivity.hpp"

#include <fmt/format.h>

#include "evaluator/render/text_table.hpp"

namespace trivela::experiment {
namespace {

std::string headline_name(const SensitivityReport& report, std::size_t i) {
  return fmt::format("{} - {}", report.arms[i + 1], report.arms[i]);
}

bool goals(const SensitivityReport& report) { return report.measure == Measure::kGoals; }

/// The value that the ends stand instead of; a scenario's angles have more digits than anybody wrote.
std::string shown(const PlayedInput& input) {
  return is_setting(input.input.key) ? value_text(input.input.key, input.value) : fmt::format("{:.3g}", input.value);
}

/// Of the columns by arm: efficiency, or goals of opportunities, in per cent.
std::string share_of_arm(const SensitivityReport& report, const ArmTally& arm) {
  const MatchTally total = total_of(arm);
  if (goals(report))
    return fmt::format("{:.1f}", 100.0 * static_cast<double>(total.goals) / static_cast<double>(total.opportunities));
  if (total.kicks == 0) return "-";
  return fmt::format("{:.1f}", 100.0 * static_cast<double>(total.on_target) / static_cast<double>(total.kicks));
}

}  // namespace

std::vector<StudyRow> rows_of(const SensitivityReport& report) {
  std::vector<StudyRow> rows;
  const auto add = [&](const std::string& key, const std::string& value, const std::vector<ArmTally>& arms) {
    for (std::size_t i = 0; i < arms.size(); ++i)
      rows.push_back({{{"input", key}, {"value", value}, {"arm", report.arms[i]}}, arms[i]});
  };
  add("", "", report.base);
  for (const PlayedInput& input : report.inputs) {
    for (const PlayedEnd& end : input.ends) {
      const std::size_t first = rows.size();
      add(input.input.key, value_text(input.input.key, end.value), end.arms);
      for (std::size_t i = 1; i < end.arms.size(); ++i) rows[first + i].change = change(report, end, i - 1);
    }
  }
  return rows;
}

std::string to_text(const SensitivityReport& report) {
  std::string text = heading(report.played, "arm and value");
  text += fmt::format("{} per 100 opportunities. No robot is calibrated again for a changed world.\n\n",
                      goals(report) ? "Goals past the keeper (the simulator's truth)" : "Shots on target");
  for (std::size_t i = 0; i + 1 < report.arms.size(); ++i)
    text += fmt::format("{}: {}\n", headline_name(report, i), points_text(headline(report.base, i, report.measure)));
  std::vector<std::vector<std::string>> rows{{"input", "value", "instead of"}};
  for (std::size_t i = 0; i + 1 < report.arms.size(); ++i) rows[0].push_back("change of " + headline_name(report, i));
  for (const std::string& arm : report.arms)
    rows[0].push_back(arm + (goals(report) ? " [goals/opp., %]" : " [% of kicks]"));
  const auto add = [&](std::vector<std::string> row, const std::vector<ArmTally>& arms) {
    for (const ArmTally& arm : arms) row.push_back(share_of_arm(report, arm));
    rows.push_back(std::move(row));
  };
  for (const PlayedInput& input : report.inputs) {
    for (const PlayedEnd& end : input.ends) {
      std::vector<std::string> row{input.input.key, value_text(input.input.key, end.value), shown(input)};
      for (std::size_t i = 0; i + 1 < report.arms.size(); ++i) row.push_back(points_text(change(report, end, i)));
      add(std::move(row), end.arms);
    }
  }
  std::vector<std::string> base(report.arms.size() + 2);
  base.front() = "(the scenario)";
  add(std::move(base), report.base);
  return text + "\n" + evaluator::text_table(rows);
}

Json to_json(const SensitivityReport& report) {
  Json json = json_of("sensitivity", rows_of(report), report.played);
  json["measure"] = goals(report) ? "goals" : "on_target";
  json["headlines"] = json["inputs"] = Json::array();
  for (std::size_t i = 0; i + 1 < report.arms.size(); ++i) {
    Json line = json_of(headline(report.base, i, report.measure));
    line["headline"] = headline_name(report, i);
    json["headlines"].push_back(std::move(line));
  }
  for (const PlayedInput& input : report.inputs)
    json["inputs"].push_back({{"input", input.input.key}, {"value", input.value}, {"why", input.input.why}});
  return json;
}

}  // namespace trivela::experiment
