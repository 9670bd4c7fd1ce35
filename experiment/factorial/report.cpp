#include "experiment/factorial/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "evaluator/report/json_values.hpp"
#include "evaluator/report/simulated.hpp"
#include "evaluator/report/svg_chart.hpp"
#include "evaluator/report/text_table.hpp"
#include "evaluator/stats/interval.hpp"
#include "experiment/effects/render.hpp"

namespace trivela::experiment {
namespace {

using evaluator::Json;
using evaluator::json_of;
using kicking::PolicyName;

double kicks_per_opportunity(const ArmTally& matches) {
  const MatchTally total = total_of(matches);
  return static_cast<double>(total.kicks) / static_cast<double>(total.opportunities);
}

std::string percent_of(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? fmt::format("{:.1f}", 100.0 * static_cast<double>(part) / static_cast<double>(whole)) : "-";
}

const char* law_text(const Cell& cell) { return cell.policy == PolicyName::kPredictive ? "-" : name(cell.law); }

std::string cells_text(const FactorialReport& report) {
  std::vector<std::vector<std::string>> rows{{"table", "policy", "law", "kicks", "kicks/opp.", "efficiency [%]",
                                              "on target/opp. [%]", "blocked [%]", "bounced in [%]"}};
  if (report.keeper) rows[0].push_back("goals/opp. [%]");
  for (const PlayedCell& played : report.cells) {
    const MatchTally total = total_of(played.matches);
    rows.push_back({played.cell.table, kicking::name(played.cell.policy), law_text(played.cell),
                    std::to_string(total.kicks), fmt::format("{:.3f}", kicks_per_opportunity(played.matches)),
                    share_text(share_of(played.matches, report.efficiency)),
                    share_text(share_of(played.matches, Measure::kPerOpportunity)),
                    percent_of(total.blocked, total.kicks), percent_of(total.bounced, total.on_target)});
    if (report.keeper) rows.back().push_back(share_text(share_of(played.matches, Measure::kGoals)));
  }
  return evaluator::text_table(rows) +
         "  The law is that of height and motion; predictive computes its own crossing and has none. Efficiency: on "
         "target\n  of " +
         (report.efficiency == Measure::kUnblocked ? "the kicks that nobody blocked" : "kicks, blocked ones included") +
         "; blocked: of kicks. Bounced in: of those on target, by the simulator's truth\n  they touched the floor "
         "before the line; Table 2 counts them.\n" +
         (report.keeper ? "  Goals: by the simulator's truth, on target and past its keeper.\n" : "");
}

std::string effects_text(const FactorialReport& report) {
  std::vector<std::vector<std::string>> rows{{"effect [points]", "efficiency", "on target/opp."}};
  std::string legend;
  for (const NamedEffect& effect : effects_of(report.cells, report.efficiency)) {
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
      sentence("efficiency", report.efficiency), sentence("shots on target per opportunity", Measure::kPerOpportunity),
      report.scenario, report.hand_eye_sd_m, 100.0 * report.hand_day_sd_ratio, report.opponent_median_m);
}

std::string sweep_sentence(const FactorialReport& report) {
  const SweepAnswer answer = answer_of(report.sweep, report.efficiency);
  const double first_m = report.sweep.front().opponent_median_m, last_m = report.sweep.back().opponent_median_m;
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
  for (const std::size_t i : answer.pair_within)
    within.push_back(fmt::format("{:g}", report.sweep[i].opponent_median_m));
  const auto older = evaluator::stats::wilson(kPaperOlder), newer = evaluator::stats::wilson(kPaperNewer);
  text += fmt::format(
      "Its pair of efficiencies (52 %, 76 %) is nearest at {:g} m: {} and {} %, {:+.1f} and {:+.1f} points off; both "
      "lie "
      "in the paper's own 95 % intervals ({:.0f} to {:.0f} and {:.0f} to {:.0f} %) {}. Agreement of such numbers would "
      "not say that the assumptions are right.\n",
      nearest.opponent_median_m, share_text(share_of(nearest.older, report.efficiency)),
      share_text(share_of(nearest.newer, report.efficiency)), 100.0 * answer.off_older, 100.0 * answer.off_newer,
      100.0 * older.lo, 100.0 * older.hi, 100.0 * newer.lo, 100.0 * newer.hi,
      within.empty() ? "nowhere in this sweep" : fmt::format("at {} m", fmt::join(within, ", ")));
  return text;
}

std::string sweep_text(const FactorialReport& report) {
  std::vector<std::vector<std::string>> rows{
      {"opponents [m]", "kick ratio", "old stopped [%]", "new moving [%]", "kicks/opp. old", "new"}};
  for (const SweepPoint& point : report.sweep) {
    const Effect ratio = kick_ratio(point.older, point.newer);
    rows.push_back({fmt::format("{:g}", point.opponent_median_m),
                    effect_text(ratio, [](double value) { return fmt::format("{:.2f}", value); }),
                    share_text(share_of(point.older, report.efficiency)),
                    share_text(share_of(point.newer, report.efficiency)),
                    fmt::format("{:.3f}", kicks_per_opportunity(point.older)),
                    fmt::format("{:.3f}", kicks_per_opportunity(point.newer))});
  }
  return fmt::format(
             "Old table and stopped against new table and moving, {} law, by the opponents' median distance; "
             "efficiencies:\n",
             name(report.sweep_law)) +
         evaluator::text_table(rows) + "\n" + sweep_sentence(report);
}

Json json_of_arm(const ArmTally& matches, Measure efficiency) {
  const MatchTally total = total_of(matches);
  return {{"opportunities", total.opportunities},
          {"kicks", total.kicks},
          {"on_target", total.on_target},
          {"blocked", total.blocked},
          {"bounced", total.bounced},
          {"goals", total.goals},
          {"efficiency", json_of(share_of(matches, efficiency))},
          {"on_target_per_opportunity", json_of(share_of(matches, Measure::kPerOpportunity))}};
}

Json json_of_gain(const Gain& gain) {
  return {{"gain", json_of(gain.gain)}, {"calibration", json_of(gain.calibration)}, {"motion", json_of(gain.motion)}};
}

Json json_of_sweep(const FactorialReport& report) {
  const SweepAnswer answer = answer_of(report.sweep, report.efficiency);
  Json sweep{{"law", name(report.sweep_law)}, {"points", Json::array()}};
  for (const SweepPoint& point : report.sweep) {
    sweep["points"].push_back({{"opponent_median_m", point.opponent_median_m},
                               {"kick_ratio", json_of(kick_ratio(point.older, point.newer))},
                               {"old_stopped", json_of_arm(point.older, report.efficiency)},
                               {"new_moving", json_of_arm(point.newer, report.efficiency)}});
  }
  sweep["ratio_at_m"] = evaluator::json_of(answer.ratio_at_m);
  sweep["ratio_from_m"] = evaluator::json_of(answer.ratio_from_m);
  sweep["ratio_to_m"] = evaluator::json_of(answer.ratio_to_m);
  sweep["pair_within_m"] = Json::array();
  for (const std::size_t i : answer.pair_within) sweep["pair_within_m"].push_back(report.sweep[i].opponent_median_m);
  sweep["nearest_m"] = answer.nearest ? Json(report.sweep[*answer.nearest].opponent_median_m) : Json();
  sweep["off_older"] = answer.nearest ? Json(answer.off_older) : Json();
  sweep["off_newer"] = answer.nearest ? Json(answer.off_newer) : Json();
  sweep["answer"] = sweep_sentence(report);
  return sweep;
}

std::string csv_of_arm(const ArmTally& matches, Measure efficiency, const std::string& bias = "") {
  const MatchTally total = total_of(matches);
  return fmt::format("{},{},{},{},{},{},{},{},{},1\n", total.opportunities, total.kicks, total.on_target,
                     csv_cells(share_of(matches, efficiency)), csv_cells(share_of(matches, Measure::kPerOpportunity)),
                     total.blocked, total.bounced, total.goals, bias);
}

}  // namespace

std::string to_text(const FactorialReport& report) {
  std::string text = evaluator::kSimulated;
  text += fmt::format(
      "{} matches of {} opportunities, the same for every cell; {}, seed {}, robots {}; 95 % intervals by "
      "match.\n\n{}\n"
      "{}\n{}",
      report.matches, report.possessions, report.scenario, report.seed, fmt::join(report.robots, ", "),
      cells_text(report), effects_text(report), gain_sentence(report));
  if (!report.sweep.empty()) text += "\n" + sweep_text(report);
  if (!report.biases.empty()) text += "\n" + pair_text(report.biases, report.sweep_law);
  return text;
}

nlohmann::ordered_json to_json(const FactorialReport& report) {
  Json json{{"simulated", true},
            {"scenario", report.scenario},
            {"robots", report.robots},
            {"seed", report.seed},
            {"matches", report.matches},
            {"possessions", report.possessions},
            {"blocked", report.efficiency == Measure::kUnblocked ? "apart" : "outside"},
            {"cells", Json::array()},
            {"effects", Json::array()},
            {"gain",
             {{"efficiency", json_of_gain(gain_of(report.cells, report.efficiency))},
              {"on_target_per_opportunity", json_of_gain(gain_of(report.cells, Measure::kPerOpportunity))}}},
            {"answer", gain_sentence(report)}};
  for (const PlayedCell& played : report.cells) {
    Json cell{{"table", played.cell.table},
              {"policy", kicking::name(played.cell.policy)},
              {"law", played.cell.policy == PolicyName::kPredictive ? Json() : Json(name(played.cell.law))}};
    cell.update(json_of_arm(played.matches, report.efficiency));
    json["cells"].push_back(std::move(cell));
  }
  for (const NamedEffect& effect : effects_of(report.cells, report.efficiency)) {
    json["effects"].push_back({{"effect", effect.key},
                               {"of", effect.what},
                               {"efficiency", json_of(effect.efficiency)},
                               {"on_target_per_opportunity", json_of(effect.per_opportunity)}});
  }
  if (!report.biases.empty()) json["pair"] = pair_json(report.biases);
  if (!report.sweep.empty()) json["sweep"] = json_of_sweep(report);
  return json;
}

std::string to_csv(const FactorialReport& report) {
  std::string csv =
      "kind,table,policy,law,opponent_median_m,opportunities,kicks,on_target,efficiency,efficiency_low,efficiency_high,"
      "per_opportunity,per_opportunity_low,per_opportunity_high,blocked,bounced,goals,eye_bias_m,simulated\n";
  const auto row = [&](const char* kind, const Cell& cell, double median_m, const ArmTally& matches,
                       const std::string& bias = "") {
    const char* law = cell.policy == PolicyName::kPredictive ? "" : name(cell.law);
    csv += fmt::format("{},{},{},{},{:g},{}", kind, cell.table, kicking::name(cell.policy), law, median_m,
                       csv_of_arm(matches, report.efficiency, bias));
  };
  for (const PlayedCell& played : report.cells) row("cell", played.cell, report.opponent_median_m, played.matches);
  for (const SweepPoint& point : report.sweep) {
    row("sweep", {"old", PolicyName::kStopped, report.sweep_law}, point.opponent_median_m, point.older);
    row("sweep", {"new", PolicyName::kMoving, report.sweep_law}, point.opponent_median_m, point.newer);
  }
  for (const BiasPoint& point : report.biases) {
    const std::string bias = fmt::format("{:g}", point.eye_bias_m);
    row("bias", {"old", PolicyName::kStopped, report.sweep_law}, report.opponent_median_m, point.older, bias);
    row("bias", {"new", PolicyName::kMoving, report.sweep_law}, report.opponent_median_m, point.newer, bias);
  }
  return csv;
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
