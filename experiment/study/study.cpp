#include "experiment/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "config/scenario/scenario.hpp"
#include "evaluator/render/text_table.hpp"
#include "experiment/run/arms.hpp"

namespace trivela::experiment {
namespace {

/// The counts of a row; what is true of all kicks is said where the labels are doubted.
constexpr auto kCounts = std::span{log::kTallyFields}.first<6>();

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string cell;
  for (const char c : text) cell += c == '"' ? std::string{"\"\""} : std::string{c};
  return '"' + cell + '"';
}

/// "12.5", without an interval.
std::string plain_share(const StudyRow& row, Measure measure) {
  const auto counts = counts_of(total_of(row.matches), measure);
  if (counts.n == 0) return "-";
  return fmt::format("{:.1f}", 100.0 * static_cast<double>(counts.inside) / static_cast<double>(counts.n));
}

/// Labels, kicks, kicks and shots on target per opportunity, efficiency, goals where there is a keeper, blocked of
/// kicks, bounced of those on target, changes.
std::string table_of(const Study& study, const std::vector<StudyRow>& rows, const StudyPlayed& played) {
  std::vector<std::vector<std::string>> table(1);
  std::vector<std::string>& head = table.front();
  for (const RowLabel& label : rows.front().labels) head.push_back(evaluator::words(label.key));
  head.insert(head.end(), {"kicks", "kicks/opp.", "efficiency [%]", "on target/opp. [%]"});
  if (played.keeper) head.emplace_back("goals/opp. [%]");
  head.insert(head.end(), {"blocked [%]", "bounced in [%]"});
  for (const RowChange& change : study.changes) head.push_back(change.heading + " [points]");
  for (const StudyRow& row : rows) {
    std::vector<std::string>& line = table.emplace_back();
    for (const RowLabel& label : row.labels) line.push_back(label.text.empty() ? "-" : label.text);
    const auto share = [&](Measure measure) { return share_of(row.matches, measure); };
    line.insert(line.end(),
                {fmt::format("{}", total_of(row.matches).kicks), fmt::format("{:.3f}", share(Measure::kKicks).value),
                 share_text(share(played.efficiency)), share_text(share(Measure::kPerOpportunity))});
    if (played.keeper) line.push_back(share_text(share(Measure::kGoals)));
    line.insert(line.end(), {plain_share(row, Measure::kBlocked), plain_share(row, Measure::kBounced)});
    for (const Effect& change : row.changes) line.push_back(points_text(change));
    line.resize(table.front().size());
  }
  return evaluator::text_table(table);
}

/// The shares and changes of a row, by their names in JSON.
std::vector<std::pair<std::string, Effect>> numbers_of(const Study& study, const StudyRow& row, Measure efficiency) {
  std::vector<std::pair<std::string, Effect>> numbers{
      {"efficiency", share_of(row.matches, efficiency)},
      {"on_target_per_opportunity", share_of(row.matches, Measure::kPerOpportunity)}};
  for (std::size_t i = 0; i < row.changes.size(); ++i) numbers.emplace_back(study.changes[i].key, row.changes[i]);
  return numbers;
}

/// Labels; opportunities, kicks, on_target, blocked, bounced, goals; efficiency and per_opportunity, each with its
/// interval (_low, _high); changes; simulated. Empty: there are too few kicks.
std::string csv_of(const Study& study, const std::vector<StudyRow>& rows, const StudyPlayed& played) {
  std::string csv;
  for (const RowLabel& label : rows.front().labels) csv += label.key + ',';
  for (const log::TallyField& count : kCounts) csv += fmt::format("{},", count.name);
  std::vector<std::string> names{"efficiency", "per_opportunity"};
  for (const RowChange& change : study.changes) names.push_back(change.key);
  for (std::string& name : names) {
    std::ranges::replace(name, '/', '_');
    csv += fmt::format("{0},{0}_low,{0}_high,", name);
  }
  csv += "simulated\n";
  for (const StudyRow& row : rows) {
    for (const RowLabel& label : row.labels) csv += quoted(label.text) + ',';
    for (const log::TallyField& count : kCounts) csv += fmt::format("{},", total_of(row.matches).*count.field);
    for (const auto& [key, effect] : numbers_of(study, row, played.efficiency))
      for (const double number : {effect.value, effect.ci.lo, effect.ci.hi})
        csv += std::isfinite(number) ? fmt::format("{:.6f},", number) : ",";
    for (std::size_t i = row.changes.size(); i < study.changes.size(); ++i) csv += ",,,";
    csv += "1\n";
  }
  return csv;
}

/// The head of every study's JSON, with "rows" of the same columns.
Json json_of(const Study& study, const std::vector<StudyRow>& rows, const StudyPlayed& played) {
  Json json{
      {"simulated", true},
      {"study", study.name},
      {"scenario", played.scenario},
      {"seed", played.seed},
      {"matches", played.matches},
      {"possessions", played.possessions},
      {"calibrations", played.calibrations},
      {"blocked", played.efficiency == Measure::kUnblocked ? "apart" : "outside"},
      {"notes", {"on_target and blocked are as the robots observed them, goals and bounced the simulator's truth"}},
      {"rows", Json::array()}};
  for (const StudyRow& row : rows) {
    Json cells;
    for (const RowLabel& label : row.labels) cells[label.key] = label.text.empty() ? Json() : Json(label.text);
    for (const log::TallyField& count : kCounts) cells[count.name] = total_of(row.matches).*count.field;
    for (const auto& [key, effect] : numbers_of(study, row, played.efficiency))
      cells[Json::json_pointer('/' + key)] = json_of(effect);
    json["rows"].push_back(std::move(cells));
  }
  return json;
}

}  // namespace

const std::string& StudyRow::label(const std::string& key) const {
  const auto found = std::ranges::find(labels, key, &RowLabel::key);
  if (found == labels.end()) throw std::out_of_range{"a study's row has no label " + key};
  return found->text;
}

StudyReport report_of(const Study& study, std::vector<StudyRow> rows, const StudyPlayed& played) {
  StudyAnswer answer = study.answer(study, rows, played);
  const std::string intervals =
      played.calibrations == 0 ? "95 % intervals by match, for these robot files alone (--calibrations)"
                               : fmt::format("95 % intervals by match and by {} calibrations", played.calibrations);
  StudyReport report{
      .text = fmt::format("{}{} matches of {} opportunities, the same for every {}; {}, seed {}; {}.\n\n{}{}",
                          evaluator::kSimulated, played.matches, played.possessions, study.whom, played.scenario,
                          played.seed, intervals, table_of(study, rows, played), answer.text),
      .csv = csv_of(study, rows, played),
      .json = json_of(study, rows, played),
      .svg = std::move(answer.svg)};
  report.json.update(answer.more);
  return report;
}

std::string arguments_of(const Study& study) {
  const StudyWorld& first = study.worlds.front();
  std::string text = config::to_toml_text(first.scenario);
  for (const Arm& arm : first.arms) text += "\n### arm\n" + describe(arm);
  const auto usual = config::scenario_values(first.scenario);
  for (const StudyWorld& world : study.worlds) {
    text += fmt::format("\n### {}\n", world.what);
    for (const Arm& arm : world.arms) text += arm.name + '\n';
    for (const auto& [key, value] : config::scenario_values(world.scenario))
      if (const auto known = usual.find(key); known == usual.end() || known->second != value)
        text += fmt::format("{} = {}\n", key, value);
  }
  return text;
}

}  // namespace trivela::experiment
