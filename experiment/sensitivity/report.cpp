#include "experiment/sensitivity/analysis.hpp"

#include <fmt/format.h>

#include "evaluator/report/simulated.hpp"
#include "evaluator/report/text_table.hpp"
#include "experiment/effects/render.hpp"

namespace trivela::experiment {
namespace {

using evaluator::Json;

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

Json json_of(const SensitivityReport& report, const std::vector<ArmTally>& arms) {
  Json json = Json::array();
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const MatchTally total = total_of(arms[i]);
    json.push_back({{"arm", report.arms[i]},
                    {"opportunities", total.opportunities},
                    {"kicks", total.kicks},
                    {"on_target", total.on_target},
                    {"goals", total.goals}});
  }
  return json;
}

}  // namespace

std::string to_text(const SensitivityReport& report) {
  std::string text = evaluator::kSimulated;
  text += fmt::format(
      "{} matches of {} opportunities, the same for every arm and value; {}, seed {}. Robots are as they are: none is\n"
      "calibrated anew for a changed world. {} per 100 opportunities, {}.\n\n",
      report.matches, report.possessions, report.scenario, report.seed,
      goals(report) ? "Goals past the keeper (the simulator's truth)" : "Shots on target",
      interval_words(report.evenings));
  for (std::size_t i = 0; i + 1 < report.arms.size(); ++i)
    text += fmt::format("{}: {}\n", headline_name(report, i), points_text(headline(report.base, i, report.measure)));
  std::vector<std::vector<std::string>> rows{{"input", "value", "instead of"}};
  for (std::size_t i = 0; i + 1 < report.arms.size(); ++i) rows[0].push_back("change of " + headline_name(report, i));
  for (const std::string& arm : report.arms)
    rows[0].push_back(arm + (goals(report) ? " [goals/opp., %]" : " [% of kicks]"));
  for (const PlayedInput& input : report.inputs) {
    for (const PlayedEnd& end : input.ends) {
      std::vector<std::string> row{input.input.key, value_text(input.input.key, end.value), shown(input)};
      for (std::size_t i = 0; i + 1 < report.arms.size(); ++i) row.push_back(points_text(change(report, end, i)));
      for (const ArmTally& arm : end.arms) row.push_back(share_of_arm(report, arm));
      rows.push_back(std::move(row));
    }
  }
  std::vector<std::string> base{"(the scenario)", "", ""};
  for (std::size_t i = 0; i + 1 < report.arms.size(); ++i) base.push_back("");
  for (const ArmTally& arm : report.base) base.push_back(share_of_arm(report, arm));
  rows.push_back(std::move(base));
  return text + "\n" + evaluator::text_table(rows);
}

nlohmann::ordered_json to_json(const SensitivityReport& report) {
  Json json{{"simulated", true},           {"scenario", report.scenario},
            {"seed", report.seed},         {"measure", goals(report) ? "goals" : "on_target"},
            {"matches", report.matches},   {"possessions", report.possessions},
            {"evenings", report.evenings}, {"arms", json_of(report, report.base)},
            {"headlines", Json::array()},  {"inputs", Json::array()}};
  for (std::size_t i = 0; i + 1 < report.arms.size(); ++i) {
    Json line = json_of(headline(report.base, i, report.measure));
    line["headline"] = headline_name(report, i);
    json["headlines"].push_back(std::move(line));
  }
  for (const PlayedInput& input : report.inputs) {
    Json entry{{"input", input.input.key}, {"value", input.value}, {"why", input.input.why}, {"ends", Json::array()}};
    for (const PlayedEnd& end : input.ends) {
      Json changes = Json::array();
      for (std::size_t i = 0; i + 1 < report.arms.size(); ++i) {
        Json line = json_of(change(report, end, i));
        line["headline"] = headline_name(report, i);
        changes.push_back(std::move(line));
      }
      entry["ends"].push_back({{"value", end.value}, {"changes", changes}, {"arms", json_of(report, end.arms)}});
    }
    json["inputs"].push_back(std::move(entry));
  }
  return json;
}

std::string to_csv(const SensitivityReport& report) {
  std::string csv = "input,value,arm,opportunities,kicks,on_target,change,change_low,change_high,simulated\n";
  const auto rows = [&](const char* key, const std::string& value, const std::vector<ArmTally>& arms,
                        const PlayedEnd* end) {
    for (std::size_t i = 0; i < arms.size(); ++i) {
      const MatchTally total = total_of(arms[i]);
      csv += fmt::format("{},{},{},{},{},{},", key, value, report.arms[i], total.opportunities, total.kicks,
                         total.on_target);
      if (end && i > 0) {
        csv += csv_cells(change(report, *end, i - 1)) + ",1\n";
      } else {
        csv += ",,,1\n";
      }
    }
  };
  rows("", "", report.base, nullptr);
  for (const PlayedInput& input : report.inputs) {
    for (const PlayedEnd& end : input.ends)
      rows(input.input.key, value_text(input.input.key, end.value), end.arms, &end);
  }
  return csv;
}

}  // namespace trivela::experiment
