#include "experiment/study/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "evaluator/render/simulated.hpp"
#include "evaluator/render/text_table.hpp"

namespace trivela::experiment {
namespace {

struct Count {
  const char* key;
  std::int64_t MatchTally::*field;
};
constexpr std::array kCounts{Count{"opportunities", &MatchTally::opportunities},
                             Count{"kicks", &MatchTally::kicks},
                             Count{"on_target", &MatchTally::on_target},
                             Count{"blocked", &MatchTally::blocked},
                             Count{"bounced", &MatchTally::bounced},
                             Count{"goals", &MatchTally::goals}};

double part_of(std::int64_t part, std::int64_t whole) { return static_cast<double>(part) / static_cast<double>(whole); }

std::string csv_cell(double number) { return std::isfinite(number) ? fmt::format("{:.6f}", number) : ""; }

std::string csv_cells(const Effect& effect) {
  return fmt::format("{},{},{}", csv_cell(effect.value), csv_cell(effect.ci.lo), csv_cell(effect.ci.hi));
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string cell;
  for (const char c : text) cell += c == '"' ? std::string{"\"\""} : std::string{c};
  return '"' + cell + '"';
}

bool has_changes(const std::vector<StudyRow>& rows) {
  return std::ranges::any_of(rows, [](const StudyRow& row) { return row.change.has_value(); });
}

}  // namespace

std::string effect_text(const Effect& effect, const std::function<std::string(double)>& number) {
  if (!std::isfinite(effect.value)) return "-";
  return fmt::format("{} ({})", number(effect.value),
                     has_interval(effect) ? fmt::format("{} to {}", number(effect.ci.lo), number(effect.ci.hi)) : "-");
}

std::string share_text(const Effect& effect) {
  return effect_text(effect, [](double share) { return fmt::format("{:.1f}", 100.0 * share); });
}

std::string points_text(const Effect& effect) {
  return effect_text(effect, [](double difference) { return fmt::format("{:+.1f}", 100.0 * difference); });
}

Json json_of(const Effect& effect) {
  if (!std::isfinite(effect.value)) return nullptr;
  return {{"value", effect.value}, {"ci", has_interval(effect) ? evaluator::json_of(effect.ci) : Json()}};
}

std::string heading(const StudyPlayed& played, const std::string& whom) {
  const std::string intervals =
      played.calibrations == 0 ? "95 % intervals by match, for these robot files alone (--calibrations)"
                               : fmt::format("95 % intervals by match and by {} calibrations", played.calibrations);
  return fmt::format("{}{} matches of {} opportunities, the same for every {}; {}, seed {}; {}.\n\n",
                     evaluator::kSimulated, played.matches, played.possessions, whom, played.scenario, played.seed,
                     intervals);
}

const std::string& StudyRow::label(const std::string& key) const {
  const auto found = std::ranges::find(labels, key, &Label::key);
  if (found == labels.end()) throw std::out_of_range{"a study's row has no label " + key};
  return found->text;
}

StudyColumn label_column(const std::string& heading, const std::string& key) {
  return {heading, [key](const StudyRow& row) { return row.label(key); }};
}

StudyColumn kicks_column() {
  return {"kicks", [](const StudyRow& row) { return std::to_string(total_of(row.matches).kicks); }};
}

StudyColumn kicks_per_opportunity_column(const std::string& heading) {
  return {heading,
          [](const StudyRow& row) { return fmt::format("{:.3f}", kicks_per_opportunity(total_of(row.matches))); }};
}

StudyColumn share_column(const std::string& heading, Measure measure) {
  return {heading, [measure](const StudyRow& row) { return share_text(share_of(row.matches, measure)); }};
}

std::vector<StudyColumn> share_columns(const StudyPlayed& played) {
  std::vector<StudyColumn> columns{share_column("efficiency [%]", played.efficiency),
                                   share_column("on target/opp. [%]", Measure::kPerOpportunity)};
  if (played.keeper) columns.push_back(share_column("goals/opp. [%]", Measure::kGoals));
  return columns;
}

std::string table_of(const std::vector<StudyRow>& rows, const std::vector<StudyColumn>& columns) {
  std::vector<std::vector<std::string>> cells(1);
  for (const StudyColumn& column : columns) cells[0].push_back(column.heading);
  for (const StudyRow& row : rows) {
    auto& line = cells.emplace_back();
    for (const StudyColumn& column : columns) line.push_back(column.cell(row));
  }
  return evaluator::text_table(cells);
}

std::string csv_of(const std::vector<StudyRow>& rows, const StudyPlayed& played) {
  std::string csv;
  const bool changes = has_changes(rows);
  for (const StudyRow::Label& label : rows.front().labels) csv += label.key + ',';
  for (const Count& count : kCounts) csv += fmt::format("{},", count.key);
  csv += "efficiency,efficiency_low,efficiency_high,per_opportunity,per_opportunity_low,per_opportunity_high,";
  if (changes) csv += "change,change_low,change_high,";
  csv += "simulated\n";
  for (const StudyRow& row : rows) {
    const MatchTally total = total_of(row.matches);
    for (const StudyRow::Label& label : row.labels) csv += quoted(label.text) + ',';
    for (const Count& count : kCounts) csv += fmt::format("{},", total.*count.field);
    csv += fmt::format("{},{},", csv_cells(share_of(row.matches, played.efficiency)),
                       csv_cells(share_of(row.matches, Measure::kPerOpportunity)));
    if (changes) csv += (row.change ? csv_cells(*row.change) : ",,") + ',';
    csv += "1\n";
  }
  return csv;
}

Json json_of(const std::string& study, const std::vector<StudyRow>& rows, const StudyPlayed& played) {
  Json json{{"simulated", true},
            {"study", study},
            {"scenario", played.scenario},
            {"seed", played.seed},
            {"matches", played.matches},
            {"possessions", played.possessions},
            {"calibrations", played.calibrations},
            {"blocked", played.efficiency == Measure::kUnblocked ? "apart" : "outside"},
            {"rows", Json::array()}};
  for (const StudyRow& row : rows) {
    Json cells;
    for (const StudyRow::Label& label : row.labels) cells[label.key] = label.text.empty() ? Json() : Json(label.text);
    const MatchTally total = total_of(row.matches);
    for (const Count& count : kCounts) cells[count.key] = total.*count.field;
    cells["efficiency"] = json_of(share_of(row.matches, played.efficiency));
    cells["on_target_per_opportunity"] = json_of(share_of(row.matches, Measure::kPerOpportunity));
    if (row.change) cells["change"] = json_of(*row.change);
    json["rows"].push_back(std::move(cells));
  }
  return json;
}

double kicks_per_opportunity(const MatchTally& total) { return part_of(total.kicks, total.opportunities); }
double on_target_per_opportunity(const MatchTally& total) { return part_of(total.on_target, total.opportunities); }
double efficiency_of(const MatchTally& total) { return part_of(total.on_target, total.kicks); }

std::string label_warning(const std::string& arm, const ArmTally& observed) {
  if (total_of(observed).kicks == 0) return {};
  ArmTally truth = observed;
  for (MatchTally& match : truth) match.on_target = match.true_on_target;
  const Effect said = share_of(observed, Measure::kPerOpportunity), is = share_of(truth, Measure::kPerOpportunity);
  if (!has_interval(said) || (is.value >= said.ci.lo && is.value <= said.ci.hi)) return {};
  return fmt::format(
      "{}: many labels are wrong or unknown: {:.4f} ({:.4f} to {:.4f}) on target an opportunity by the observer, "
      "{:.4f} "
      "by the simulator's truth\n",
      arm, said.value, said.ci.lo, said.ci.hi, is.value);
}

}  // namespace trivela::experiment
