#include "experiment/study/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "evaluator/render/simulated.hpp"
#include "evaluator/render/text_table.hpp"

namespace trivela::experiment {
namespace {

/// Those of a row; what is true of all kicks is said where the labels are doubted.
constexpr auto kCounts = std::span{log::kTallyFields}.first<6>();

std::string csv_cell(double number) { return std::isfinite(number) ? fmt::format("{:.6f}", number) : ""; }

std::string csv_cells(const Effect& effect) {
  return fmt::format("{},{},{},", csv_cell(effect.value), csv_cell(effect.ci.lo), csv_cell(effect.ci.hi));
}

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

std::vector<std::string> head_of(const StudyRow& row, const std::vector<RowChange>& changes, bool keeper) {
  std::vector<std::string> head;
  for (const RowLabel& label : row.labels) head.push_back(evaluator::words(label.key));
  head.insert(head.end(), {"kicks", "kicks/opp.", "efficiency [%]", "on target/opp. [%]"});
  if (keeper) head.emplace_back("goals/opp. [%]");
  head.insert(head.end(), {"blocked [%]", "bounced in [%]"});
  for (const RowChange& change : changes) head.push_back(change.heading + " [points]");
  return head;
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
  const auto found = std::ranges::find(labels, key, &RowLabel::key);
  if (found == labels.end()) throw std::out_of_range{"a study's row has no label " + key};
  return found->text;
}

std::string table_of(const std::vector<StudyRow>& rows, const std::vector<RowChange>& changes,
                     const StudyPlayed& played) {
  std::vector<std::vector<std::string>> table{head_of(rows.front(), changes, played.keeper)};
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

std::string csv_of(const std::vector<StudyRow>& rows, const std::vector<RowChange>& changes,
                   const StudyPlayed& played) {
  std::string csv;
  for (const RowLabel& label : rows.front().labels) csv += label.key + ',';
  for (const log::TallyField& count : kCounts) csv += fmt::format("{},", count.name);
  const auto add_head = [&](std::string key) {
    std::ranges::replace(key, '/', '_');
    csv += fmt::format("{0},{0}_low,{0}_high,", key);
  };
  add_head("efficiency");
  add_head("per_opportunity");
  for (const RowChange& change : changes) add_head(change.key);
  csv += "simulated\n";
  for (const StudyRow& row : rows) {
    const MatchTally total = total_of(row.matches);
    for (const RowLabel& label : row.labels) csv += quoted(label.text) + ',';
    for (const log::TallyField& count : kCounts) csv += fmt::format("{},", total.*count.field);
    csv += csv_cells(share_of(row.matches, played.efficiency)) +
           csv_cells(share_of(row.matches, Measure::kPerOpportunity));
    for (std::size_t i = 0; i < changes.size(); ++i) csv += i < row.changes.size() ? csv_cells(row.changes[i]) : ",,,";
    csv += "1\n";
  }
  return csv;
}

Json json_of(const std::string& study, const std::vector<StudyRow>& rows, const std::vector<RowChange>& changes,
             const StudyPlayed& played) {
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
    for (const RowLabel& label : row.labels) cells[label.key] = label.text.empty() ? Json() : Json(label.text);
    const MatchTally total = total_of(row.matches);
    for (const log::TallyField& count : kCounts) cells[count.name] = total.*count.field;
    cells["efficiency"] = json_of(share_of(row.matches, played.efficiency));
    cells["on_target_per_opportunity"] = json_of(share_of(row.matches, Measure::kPerOpportunity));
    for (std::size_t i = 0; i < row.changes.size(); ++i)
      cells[Json::json_pointer('/' + changes[i].key)] = json_of(row.changes[i]);
    json["rows"].push_back(std::move(cells));
  }
  return json;
}

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
