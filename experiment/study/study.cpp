#include "experiment/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "config/scenario/scenario.hpp"
#include "evaluator/render/table.hpp"
#include "evaluator/render/text_table.hpp"

namespace trivela::experiment {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string cell;
  for (const char c : text) cell += c == '"' ? std::string{"\"\""} : std::string{c};
  return '"' + cell + '"';
}

/// Of programs: labels, counts, efficiency, on target per opportunity, changes. Of people: labels, kicks, kicks and
/// shots on target per opportunity, efficiency, goals where there is a keeper, blocked of kicks, bounced of those on
/// target, changes.
evaluator::Table table_of(const Study& study, const std::vector<StudyRow>& rows, const StudyPlayed& played) {
  evaluator::Table table;
  for (const KeyText& label : rows.front().labels) table.columns.push_back({label.key, evaluator::words(label.key)});
  // What is true of all kicks is said where the labels are doubted.
  const auto counts = std::span{log::kTallyFields}.first<6>();
  for (const log::TallyField& count : counts)
    table.columns.push_back({count.name, "kicks", count.field == &MatchTally::kicks ? "{}" : ""});
  table.columns.insert(table.columns.end(), {{"", "kicks/opp.", "{:.3f}"},
                                             {"efficiency", "efficiency [%]", "{:.1f}", 100.0},
                                             {"on_target_per_opportunity", "on target/opp. [%]", "{:.1f}", 100.0},
                                             {"", "goals/opp. [%]", played.keeper ? "{:.1f}" : "", 100.0},
                                             {"", "blocked [%]", "{:.1f}"},
                                             {"", "bounced in [%]", "{:.1f}"}});
  for (const KeyText& change : study.changes)
    table.columns.push_back({change.key, change.text + " [points]", "{:+.1f}", 100.0});
  for (const StudyRow& row : rows) {
    std::vector<Json>& cells = table.rows.emplace_back();
    const MatchTally total = total_of(row.matches);
    for (const KeyText& label : row.labels) cells.push_back(label.text.empty() ? Json() : Json(label.text));
    for (const log::TallyField& count : counts) cells.emplace_back(total.*count.field);
    cells.emplace_back(share_of(row.matches, Measure::kKicks).value);
    for (const Measure measure : {played.efficiency, Measure::kPerOpportunity, Measure::kGoals})
      cells.push_back(json_of(share_of(row.matches, measure)));
    for (const Measure measure : {Measure::kBlocked, Measure::kBounced}) {
      const auto [inside, n] = counts_of(total, measure);
      cells.push_back(n == 0 ? Json() : Json(100.0 * static_cast<double>(inside) / static_cast<double>(n)));
    }
    for (const Effect& change : row.changes) cells.push_back(json_of(change));
    cells.resize(table.columns.size(), Json::value_t::discarded);
  }
  return table;
}

/// Values, effects with their interval (_low, _high), simulated. Empty: there are too few kicks.
std::string csv_of(const evaluator::Table& table) {
  std::vector<std::string> lines(table.rows.size() + 1);
  const auto number = [](const Json& value) { return fmt::format("{:.6f},", value.get<double>()); };
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    std::string name = table.columns[i].key;
    if (name.empty()) continue;
    if (name == "on_target_per_opportunity") name = "per_opportunity";
    std::ranges::replace(name, '/', '_');
    const bool is_effect = table.columns[i].scale != 1.0;
    lines[0] += is_effect ? fmt::format("{0},{0}_low,{0}_high,", name) : name + ',';
    for (std::size_t j = 0; j < table.rows.size(); ++j) {
      const Json& cell = table.rows[j][i];
      const Json ci = cell.is_object() ? cell.at("ci") : Json();
      if (is_effect)
        lines[j + 1] +=
            (cell.is_object() ? number(cell.at("value")) : ",") + (ci.is_null() ? ",," : number(ci[0]) + number(ci[1]));
      else
        lines[j + 1] += (cell.is_string() ? quoted(cell.get<std::string>()) : cell.is_null() ? "" : cell.dump()) + ',';
    }
  }
  std::string csv = lines[0] + "simulated\n";
  for (std::size_t j = 1; j < lines.size(); ++j) csv += lines[j] + "1\n";
  return csv;
}

}  // namespace

StudyReport report_of(const Study& study, std::vector<StudyRow> rows, const StudyPlayed& played) {
  StudyReport report = study.answer(study, rows, played);
  const evaluator::Table table = table_of(study, rows, played);
  const std::string intervals =
      played.calibrations == 0 ? "95 % intervals by match, for these robot files alone (--calibrations)"
                               : fmt::format("95 % intervals by match and by {} calibrations", played.calibrations);
  report.text = fmt::format("{}{} matches of {} opportunities, the same for every {}; {}, seed {}; {}.\n\n{}{}",
                            evaluator::kSimulated, played.matches, played.possessions, study.whom, played.scenario,
                            played.seed, intervals, evaluator::text_table(texts_of(table)), report.text);
  report.csv = csv_of(table);
  Json json = {{"simulated", true},
               {"study", study.name},
               {"scenario", played.scenario},
               {"seed", played.seed},
               {"matches", played.matches},
               {"possessions", played.possessions},
               {"calibrations", played.calibrations},
               {"blocked", played.efficiency == Measure::kUnblocked ? "apart" : "outside"},
               {"notes", {"on_target, blocked: as robots observed them; goals, bounced: the simulator's truth"}},
               {"rows", rows_json(table)}};
  json.update(report.json);
  report.json = std::move(json);
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
