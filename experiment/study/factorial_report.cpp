#include "experiment/study/factorial_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "evaluator/render/svg_chart.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/stats/counts/interval.hpp"

namespace trivela::experiment {
namespace {

using kicking::PolicyName;

constexpr std::array kBlocked{std::pair{"outside", Measure::kEfficiency}, std::pair{"apart", Measure::kUnblocked}};

std::string percent_of(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? fmt::format("{:.1f}", 100.0 * static_cast<double>(part) / static_cast<double>(whole)) : "-";
}

StudyRow row_of(const char* kind, const Cell& cell, const ArmTally& matches, double median_m,
                const std::string& bias_m) {
  return {{{"kind", kind},
           {"table", cell.table},
           {"policy", kicking::name(cell.policy)},
           {"law", cell.policy == PolicyName::kPredictive ? "" : name(cell.law)},
           {"opponent_median_m", fmt::format("{:g}", median_m)},
           {"eye_bias_m", bias_m}},
          matches};
}

std::string cells_text(const FactorialReport& report) {
  std::vector<StudyRow> rows = rows_of(report);
  std::erase_if(rows, [](const StudyRow& row) { return row.label("kind") != "cell"; });
  std::vector<StudyColumn> columns{
      label_column("table", "table"),
      label_column("policy", "policy"),
      {"law", [](const StudyRow& row) { return row.label("law").empty() ? "-" : row.label("law"); }},
      kicks_column(),
      kicks_per_opportunity_column()};
  for (StudyColumn& column : share_columns(report.played)) columns.push_back(std::move(column));
  const auto part = [](const char* heading, std::int64_t MatchTally::*of, std::int64_t MatchTally::*whole) {
    return StudyColumn{heading, [of, whole](const StudyRow& row) {
                         const MatchTally total = total_of(row.matches);
                         return percent_of(total.*of, total.*whole);
                       }};
  };
  columns.insert(columns.begin() + 7, {part("blocked [%]", &MatchTally::blocked, &MatchTally::kicks),
                                       part("bounced in [%]", &MatchTally::bounced, &MatchTally::on_target)});
  return table_of(rows, columns) +
         "  The law is that of height and motion; predictive computes its own crossing and has none. Efficiency: on "
         "target\n  of " +
         (report.played.efficiency == Measure::kUnblocked ? "the kicks that nobody blocked"
                                                          : "kicks, blocked ones included") +
         "; blocked: of kicks. Bounced in: of those on target, by the simulator's truth\n  they touched the floor "
         "before the line; Table 2 counts them.\n" +
         (report.played.keeper ? "  Goals: by the simulator's truth, on target and past its keeper.\n" : "");
}

std::string effects_text(const FactorialReport& report) {
  std::vector<std::vector<std::string>> rows{{"effect [points]", "efficiency", "on target/opp."}};
  std::string legend;
  for (const NamedEffect& effect : effects_of(report.cells, report.played.efficiency)) {
    rows.push_back({effect.key, points_text(effect.efficiency), points_text(effect.per_opportunity)});
    legend += fmt::format("  {}: {}\n", effect.key, effect.what);
  }
  return evaluator::text_table(rows) + legend;
}

/// The answer on calibration and motion, one sentence a measure.
std::string gain_sentence(const FactorialReport& report) {
  const auto sentence = [&](const char* what, Measure measure) {
    const Gain gain = gain_of(report.cells, measure);
    if (!has_interval(gain.gain) || !has_interval(gain.calibration) || !has_interval(gain.motion)) {
      return fmt::format("{} cannot be told, there are too few kicks", what);
    }
    return fmt::format("{} {} points, of which calibration {} and motion {}", what, points_text(gain.gain),
                       points_text(gain.calibration), points_text(gain.motion));
  };
  return fmt::format(
      "From the old table and stopped to the new table and moving, over the three laws: {}; {}. This holds for {} and "
      "its assumptions, among them those on the old table (heights judged by eye to {:g} m, kicker {:g} % from day to "
      "day) and on the opponents (median {:g} m): others give other shares. It says nothing about why the paper's "
      "tournaments differed.\n",
      sentence("efficiency", report.played.efficiency),
      sentence("shots on target per opportunity", Measure::kPerOpportunity), report.played.scenario,
      report.hand_eye_sd_m, 100.0 * report.hand_day_sd_ratio, report.opponent_median_m);
}

std::string sweep_sentence(const FactorialReport& report) {
  const SweepAnswer answer = answer_of(report.sweep, report.played.efficiency);
  const double first_m = report.sweep.front().value_m, last_m = report.sweep.back().value_m;
  std::string text;
  const bool has_ratio = std::ranges::any_of(
      report.sweep, [](const SweepPoint& point) { return std::isfinite(kick_ratio(point.older, point.newer).value); });
  if (!has_ratio) {
    text = "There are too few kicks for a kick ratio. ";
  } else if (answer.ratio_at_m) {
    const auto end = [](const std::optional<double>& metres, const char* beyond) {
      return metres ? fmt::format("{:.2f} m", *metres) : std::string{beyond};
    };
    text =
        fmt::format("The paper's kick ratio of {:.2f} is met with opponents at a median of {:.2f} m (95 %: {} to {}). ",
                    kPaperKickRatio, *answer.ratio_at_m, end(answer.ratio_from_m, "below the sweep"),
                    end(answer.ratio_to_m, "beyond it"));
  } else {
    text = fmt::format("The paper's kick ratio of {:.2f} is not met {}. ", kPaperKickRatio,
                       first_m == last_m ? fmt::format("at {:g} m", first_m)
                                         : fmt::format("between {:g} and {:g} m", first_m, last_m));
  }
  if (!answer.nearest) return text + "There are too few kicks to say where its pair of efficiencies is nearest.\n";
  const SweepPoint& nearest = report.sweep[*answer.nearest];
  std::vector<std::string> within;
  for (const std::size_t i : answer.pair_within) within.push_back(fmt::format("{:g}", report.sweep[i].value_m));
  const auto older = evaluator::stats::wilson(kPaperOlder), newer = evaluator::stats::wilson(kPaperNewer);
  text += fmt::format(
      "Its pair of efficiencies (52 %, 76 %) is nearest at {:g} m: {} and {} %, {:+.1f} and {:+.1f} points off; both "
      "lie "
      "in the paper's own 95 % intervals ({:.0f} to {:.0f} and {:.0f} to {:.0f} %) {}. Agreement of such numbers would "
      "not say that the assumptions are right.\n",
      nearest.value_m, share_text(share_of(nearest.older, report.played.efficiency)),
      share_text(share_of(nearest.newer, report.played.efficiency)), 100.0 * answer.off_older, 100.0 * answer.off_newer,
      100.0 * older.lo, 100.0 * older.hi, 100.0 * newer.lo, 100.0 * newer.hi,
      within.empty() ? "nowhere in this sweep" : fmt::format("at {} m", fmt::join(within, ", ")));
  return text;
}

std::string sweep_text(const FactorialReport& report) {
  std::vector<std::vector<std::string>> rows{
      {"opponents [m]", "kick ratio", "old stopped [%]", "new moving [%]", "kicks/opp. old", "new"}};
  for (const SweepPoint& point : report.sweep) {
    const Effect ratio = kick_ratio(point.older, point.newer);
    rows.push_back({fmt::format("{:g}", point.value_m),
                    effect_text(ratio, [](double value) { return fmt::format("{:.2f}", value); }),
                    share_text(share_of(point.older, report.played.efficiency)),
                    share_text(share_of(point.newer, report.played.efficiency)),
                    fmt::format("{:.3f}", kicks_per_opportunity(total_of(point.older))),
                    fmt::format("{:.3f}", kicks_per_opportunity(total_of(point.newer)))});
  }
  return fmt::format(
             "Old table and stopped against new table and moving, {} law, by the opponents' median distance; "
             "efficiencies:\n",
             name(report.sweep_law)) +
         evaluator::text_table(rows) + "\n" + sweep_sentence(report);
}

std::string pair_text(const FactorialReport& report) {
  const auto older = evaluator::stats::wilson(kPaperOlder), newer = evaluator::stats::wilson(kPaperNewer);
  std::vector<std::vector<std::string>> rows{
      {"eye's common error [m]", "blocked", "old stopped [%]", "new moving [%]", "both within the paper's"}};
  for (const SweepPoint& point : report.biases) {
    for (const auto& [blocked, measure] : kBlocked) {
      rows.push_back({fmt::format("{:g}", point.value_m), blocked, share_text(share_of(point.older, measure)),
                      share_text(share_of(point.newer, measure)), both_within_papers(point, measure) ? "yes" : "no"});
    }
  }
  return fmt::format(
             "Old table and stopped against new table and moving, {} law, by two assumptions; the paper: 52.3 and 75.8 "
             "%\n(95 % {:.0f} to {:.0f} and {:.0f} to {:.0f} %):\n",
             name(report.sweep_law), 100.0 * older.lo, 100.0 * older.hi, 100.0 * newer.lo, 100.0 * newer.hi) +
         evaluator::text_table(rows) +
         "  Common error: balls so much too high seemed right to the person who made the old tables, at every "
         "distance.\n"
         "  Assumptions that meet two numbers are not shown to be right by it: several do.\n";
}

Json json_of_gain(const Gain& gain) {
  return {{"gain", json_of(gain.gain)}, {"calibration", json_of(gain.calibration)}, {"motion", json_of(gain.motion)}};
}

Json json_of_sweep(const FactorialReport& report) {
  const SweepAnswer answer = answer_of(report.sweep, report.played.efficiency);
  Json ratios = Json::array(), within = Json::array();
  for (const SweepPoint& point : report.sweep)
    ratios.push_back(
        {{"opponent_median_m", point.value_m}, {"kick_ratio", json_of(kick_ratio(point.older, point.newer))}});
  for (const std::size_t i : answer.pair_within) within.push_back(report.sweep[i].value_m);
  return {{"law", name(report.sweep_law)},
          {"points", ratios},
          {"ratio_at_m", evaluator::json_of(answer.ratio_at_m)},
          {"ratio_from_m", evaluator::json_of(answer.ratio_from_m)},
          {"ratio_to_m", evaluator::json_of(answer.ratio_to_m)},
          {"pair_within_m", within},
          {"nearest_m", answer.nearest ? Json(report.sweep[*answer.nearest].value_m) : Json()},
          {"off_older", answer.nearest ? Json(answer.off_older) : Json()},
          {"off_newer", answer.nearest ? Json(answer.off_newer) : Json()},
          {"answer", sweep_sentence(report)}};
}

Json json_of_pair(const FactorialReport& report) {
  Json json = Json::array();
  for (const SweepPoint& point : report.biases) {
    for (const auto& [blocked, measure] : kBlocked)
      json.push_back({{"eye_bias_m", point.value_m},
                      {"blocked", blocked},
                      {"old_stopped", json_of(share_of(point.older, measure))},
                      {"new_moving", json_of(share_of(point.newer, measure))},
                      {"both_within_papers", both_within_papers(point, measure)}});
  }
  return json;
}

}  // namespace

std::vector<StudyRow> rows_of(const FactorialReport& report) {
  std::vector<StudyRow> rows;
  for (const PlayedCell& played : report.cells)
    rows.push_back(row_of("cell", played.cell, played.matches, report.opponent_median_m, ""));
  const auto add = [&](const char* kind, const SweepPoint& point, double median_m, const std::string& bias_m) {
    rows.push_back(row_of(kind, {"old", PolicyName::kStopped, report.sweep_law}, point.older, median_m, bias_m));
    rows.push_back(row_of(kind, {"new", PolicyName::kMoving, report.sweep_law}, point.newer, median_m, bias_m));
  };
  for (const SweepPoint& point : report.sweep) add("sweep", point, point.value_m, "");
  for (const SweepPoint& point : report.biases)
    add("bias", point, report.opponent_median_m, fmt::format("{:g}", point.value_m));
  return rows;
}

std::string to_text(const FactorialReport& report) {
  std::string text = heading(report.played, "cell") +
                     fmt::format("{}\n{}\n{}", cells_text(report), effects_text(report), gain_sentence(report));
  if (!report.sweep.empty()) text += "\n" + sweep_text(report);
  if (!report.biases.empty()) text += "\n" + pair_text(report);
  return text;
}

Json to_json(const FactorialReport& report) {
  Json json = json_of("factorial", rows_of(report), report.played);
  json["robots"] = report.robots;
  json["effects"] = Json::array();
  json["gain"] = {{"efficiency", json_of_gain(gain_of(report.cells, report.played.efficiency))},
                  {"on_target_per_opportunity", json_of_gain(gain_of(report.cells, Measure::kPerOpportunity))}};
  json["answer"] = gain_sentence(report);
  for (const NamedEffect& effect : effects_of(report.cells, report.played.efficiency)) {
    json["effects"].push_back({{"effect", effect.key},
                               {"of", effect.what},
                               {"efficiency", json_of(effect.efficiency)},
                               {"on_target_per_opportunity", json_of(effect.per_opportunity)}});
  }
  if (!report.sweep.empty()) json["sweep"] = json_of_sweep(report);
  if (!report.biases.empty()) json["pair"] = json_of_pair(report);
  return json;
}

std::string to_svg(const FactorialReport& report) {
  evaluator::Chart chart{"Shots on target by height table, policy and law",
                         "height table",
                         "on target per opportunity [%]",
                         {},
                         {"old", "new"},
                         true};
  // Side by side within a table's band, so that the intervals do not hide each other.
  constexpr double kApart = 0.04;
  const std::size_t half = report.cells.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    const PlayedCell& older = report.cells[i];
    const int colour = older.cell.policy == PolicyName::kStopped ? 0 : older.cell.policy == PolicyName::kMoving ? 1 : 2;
    const int dash = older.cell.policy == PolicyName::kPredictive ? 0 : static_cast<int>(older.cell.law);
    const std::string label = older.cell.name().substr(older.cell.table.size() + 1);
    evaluator::ChartSeries line{label, {}, evaluator::ChartMark::kLine, colour, dash};
    for (const PlayedCell* played : {&older, &report.cells[i + half]}) {
      const Effect share = share_of(played->matches, Measure::kPerOpportunity);
      const double x = (played->cell.table == "new" ? 1.0 : 0.0) + kApart * (static_cast<double>(i) - 3.0);
      // Up and down the interval on the way, where there is one.
      for (const double y : {share.value, share.ci.lo, share.ci.hi, share.value}) {
        if (std::isfinite(y)) line.points.push_back({x, 100.0 * y});
      }
    }
    chart.series.push_back(std::move(line));
  }
  return evaluator::to_svg(chart);
}

}  // namespace trivela::experiment
