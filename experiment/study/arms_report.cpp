#include "experiment/study/arms_report.hpp"

#include <fmt/format.h>

namespace trivela::experiment {
namespace {

Effect minus_first(const ArmsReport& report, const ArmTally& matches, Measure measure) {
  const Term terms[] = {{&matches, 1.0}, {&report.arms.front().matches, -1.0}};
  return contrast(terms, measure);
}

StudyColumn difference_column(const ArmsReport& report, const std::string& heading, Measure measure) {
  return {heading,
          [&report, measure](const StudyRow& row) { return points_text(minus_first(report, row.matches, measure)); }};
}

}  // namespace

std::vector<StudyRow> rows_of(const ArmsReport& report) {
  std::vector<StudyRow> rows;
  for (const ArmsReport::PlayedArm& arm : report.arms) rows.push_back({{{"arm", arm.name}}, arm.matches});
  return rows;
}

std::string to_text(const ArmsReport& report) {
  std::vector<StudyRow> rows = rows_of(report);
  const auto count = [](const char* heading, std::int64_t MatchTally::*field) {
    return StudyColumn{heading, [field](const StudyRow& row) { return fmt::to_string(total_of(row.matches).*field); }};
  };
  std::vector<StudyColumn> columns{label_column("arm", "arm"), count("opportunities", &MatchTally::opportunities),
                                   kicks_column(), count("on target", &MatchTally::on_target),
                                   count("blocked", &MatchTally::blocked)};
  for (StudyColumn& column : share_columns(report.played)) columns.push_back(std::move(column));
  std::string text = heading(report.played, "arm") + table_of(rows, columns);
  if (report.played.keeper) text += "  goals: by the simulator's truth, on target and past its keeper\n";
  for (const ArmsReport::PlayedArm& arm : report.arms) text += label_warning(arm.name, arm.matches);
  if (rows.size() == 1) return text;
  columns = {label_column("minus " + report.arms.front().name, "arm"),
             difference_column(report, "efficiency [points]", report.played.efficiency),
             difference_column(report, "on target/opp. [points]", Measure::kPerOpportunity)};
  rows.erase(rows.begin());
  return text + "\nOn the same matches:\n" + table_of(rows, columns);
}

Json to_json(const ArmsReport& report) {
  Json json = json_of("arms", rows_of(report), report.played);
  for (std::size_t i = 1; i < report.arms.size(); ++i) {
    const ArmTally& matches = report.arms[i].matches;
    json["rows"][i]["minus_first"] = {
        {"efficiency", json_of(minus_first(report, matches, report.played.efficiency))},
        {"on_target_per_opportunity", json_of(minus_first(report, matches, Measure::kPerOpportunity))}};
  }
  return json;
}

}  // namespace trivela::experiment
