#include "experiment/frontier/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "evaluator/report/simulated.hpp"
#include "evaluator/report/svg_chart.hpp"
#include "evaluator/report/text_table.hpp"
#include "experiment/effects/render.hpp"

namespace trivela::experiment {
namespace {

using evaluator::Json;

/// Every point in the order of the tables, its threshold as text.
struct Row {
  std::string policy;
  std::string threshold;
  const ArmTally* matches;
};

std::vector<Row> rows_of(const FrontierReport& report) {
  std::vector<Row> rows;
  for (const FrontierPoint& point : report.points)
    rows.push_back({report.policy, fmt::format("{:g}", point.threshold), &point.matches});
  for (const FixedPoint& fixed : report.fixed) rows.push_back({fixed.name, "", &fixed.matches});
  if (report.oracle) rows.push_back({report.oracle->name, "", &report.oracle->matches});
  return rows;
}

std::string sentence(const FrontierReport& report, const FixedPoint& fixed) {
  const auto standing = standing_of(report, fixed);
  if (total_of(fixed.matches).kicks == 0) return fmt::format("{} never kicked.\n", fixed.name);
  if (!standing) return fmt::format("{} has no frontier beside it: {} never kicked.\n", fixed.name, report.policy);
  if (!has_interval(standing->above)) {
    return fmt::format("{} has, or {} has, too few kicks to tell it from the frontier.\n", fixed.name, report.policy);
  }
  const char* where = standing->above.ci.lo > 0.0   ? "lies below the frontier"
                      : standing->above.ci.hi < 0.0 ? "lies above the frontier"
                                                    : "cannot be told from the frontier";
  const std::string at = standing->within ? fmt::format("as many kicks (thresholds {:g} and {:g} mixed)",
                                                        standing->from_threshold, standing->to_threshold)
                                          : fmt::format("the nearest number of kicks that it has (threshold {:g})",
                                                        standing->to_threshold);
  return fmt::format("{} {}: with {} {} has {:+.1f} points more of its kicks on target (95 %: {:+.1f} to {:+.1f}).\n",
                     fixed.name, where, at, report.policy, 100.0 * standing->above.value, 100.0 * standing->above.ci.lo,
                     100.0 * standing->above.ci.hi);
}

std::string oracle_sentence(const FrontierReport& report) {
  const Effect share = share_of_oracle(report);
  if (!has_interval(share)) return "There are too few shots on target to say how much of the oracle's.\n";
  return fmt::format("At its best threshold, {:g}, {} has {} % of the oracle's shots on target.\n",
                     best_of(report).threshold, report.policy, share_text(share));
}

/// Instead of a chart that would have nothing to scale its axes by.
std::string no_kicks_svg() {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 400 80\">\n"
         "<rect width=\"400\" height=\"80\" fill=\"#fff\"/>\n"
         "<text fill=\"#222\" x=\"20\" y=\"45\">No policy kicked: there is nothing to draw.</text>\n</svg>\n";
}

}  // namespace

std::string to_text(const FrontierReport& report) {
  std::vector<std::vector<std::string>> table{
      {"policy", "threshold", "kicks/opp.", "efficiency [%]", "on target/opp. [%]", "kicks"}};
  for (const Row& row : rows_of(report)) {
    const MatchTally total = total_of(*row.matches);
    table.push_back({row.policy, row.threshold, fmt::format("{:.3f}", kicks_per_opportunity(total)),
                     share_text(share_of(*row.matches, Measure::kEfficiency)),
                     share_text(share_of(*row.matches, Measure::kPerOpportunity)), fmt::format("{}", total.kicks)});
  }
  std::string text = evaluator::kSimulated;
  text +=
      fmt::format("{} matches of {} opportunities, the same for every policy and threshold; {}, seed {}; {}.\n\n{}\n",
                  report.matches, report.possessions, report.scenario, report.seed, interval_words(report.evenings),
                  evaluator::text_table(table));
  for (const FixedPoint& fixed : report.fixed) text += sentence(report, fixed);
  if (report.oracle) text += oracle_sentence(report);
  return text;
}

nlohmann::ordered_json to_json(const FrontierReport& report) {
  Json json{{"simulated", true},           {"policy", report.policy},   {"scenario", report.scenario},
            {"seed", report.seed},         {"matches", report.matches}, {"possessions", report.possessions},
            {"evenings", report.evenings}, {"points", Json::array()},   {"standings", Json::array()}};
  for (const Row& row : rows_of(report)) {
    const MatchTally total = total_of(*row.matches);
    json["points"].push_back(
        {{"policy", row.policy},
         {"threshold", row.threshold.empty() ? Json() : Json(std::stod(row.threshold))},
         {"opportunities", total.opportunities},
         {"kicks", total.kicks},
         {"on_target", total.on_target},
         {"kicks_per_opportunity", kicks_per_opportunity(total)},
         {"efficiency", json_of(share_of(*row.matches, Measure::kEfficiency))},
         {"on_target_per_opportunity", json_of(share_of(*row.matches, Measure::kPerOpportunity))}});
  }
  for (const FixedPoint& fixed : report.fixed) {
    Json entry{{"policy", fixed.name}, {"answer", sentence(report, fixed)}};
    if (const auto standing = standing_of(report, fixed)) {
      entry["within"] = standing->within;
      entry["frontier_above"] = json_of(standing->above);
    }
    json["standings"].push_back(std::move(entry));
  }
  if (report.oracle)
    json["of_oracle"] = {{"threshold", best_of(report).threshold}, {"share", json_of(share_of_oracle(report))}};
  return json;
}

std::string to_csv(const FrontierReport& report) {
  std::string csv =
      "policy,threshold,opportunities,kicks,on_target,kicks_per_opportunity,efficiency,efficiency_low,efficiency_high,"
      "per_opportunity,per_opportunity_low,per_opportunity_high,simulated\n";
  for (const Row& row : rows_of(report)) {
    const MatchTally total = total_of(*row.matches);
    csv += fmt::format("{},{},{},{},{},{:.6f},{},{},1\n", row.policy, row.threshold, total.opportunities, total.kicks,
                       total.on_target, kicks_per_opportunity(total),
                       csv_cells(share_of(*row.matches, Measure::kEfficiency)),
                       csv_cells(share_of(*row.matches, Measure::kPerOpportunity)));
  }
  return csv;
}

std::string to_svg(const FrontierReport& report) {
  evaluator::Chart chart{
      "Efficiency and volume by firing threshold", "kicks per opportunity", "on target of kicks [%]", {}, {}, true};
  evaluator::ChartSeries line{report.policy, {}, evaluator::ChartMark::kLine, 0, 0};
  for (const FrontierPoint& point : report.points) {
    const MatchTally total = total_of(point.matches);
    if (total.kicks > 0) line.points.push_back({kicks_per_opportunity(total), 100.0 * efficiency_of(total)});
  }
  evaluator::ChartSeries dots = line;
  dots.name = "its thresholds";
  dots.mark = evaluator::ChartMark::kDots;
  chart.series = {std::move(line), std::move(dots)};
  std::vector<FixedPoint> others = report.fixed;
  if (report.oracle) others.push_back(*report.oracle);
  for (std::size_t i = 0; i < others.size(); ++i) {
    const MatchTally total = total_of(others[i].matches);
    if (total.kicks == 0) continue;
    const auto colour = static_cast<int>(i) + 1;
    chart.series.push_back({others[i].name,
                            {{kicks_per_opportunity(total), 100.0 * efficiency_of(total)}},
                            evaluator::ChartMark::kDots,
                            colour,
                            0});
    const Effect efficiency = share_of(others[i].matches, Measure::kEfficiency);
    if (!has_interval(efficiency)) continue;
    chart.series.push_back({others[i].name + ", 95 %",
                            {{kicks_per_opportunity(total), 100.0 * efficiency.ci.lo},
                             {kicks_per_opportunity(total), 100.0 * efficiency.ci.hi}},
                            evaluator::ChartMark::kLine,
                            colour,
                            0});
  }
  if (std::ranges::all_of(chart.series, [](const auto& series) { return series.points.empty(); }))
    return no_kicks_svg();
  return evaluator::to_svg(chart);
}

}  // namespace trivela::experiment
