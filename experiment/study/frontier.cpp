#include "experiment/study/frontier.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "evaluator/render/svg_chart.hpp"

namespace trivela::experiment {
namespace {

double ratio(std::int64_t of, std::int64_t all) { return static_cast<double>(of) / static_cast<double>(all); }

MatchTally without(MatchTally total, const MatchTally& match) {
  total.opportunities -= match.opportunities;
  total.kicks -= match.kicks;
  total.on_target -= match.on_target;
  return total;
}

/// Those that kick, the most kicks first.
std::vector<const FrontierPoint*> by_kicks(const FrontierReport& report) {
  std::vector<const FrontierPoint*> points;
  for (const FrontierPoint& point : report.points) {
    if (total_of(point.matches).kicks > 0) points.push_back(&point);
  }
  std::ranges::stable_sort(points, std::ranges::greater{},
                           [](const FrontierPoint* point) { return total_of(point->matches).kicks; });
  return points;
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

Effect jackknife(const std::vector<const ArmTally*>& arms,
                 const std::function<double(const std::vector<MatchTally>&)>& of) {
  std::vector<MatchTally> totals;
  totals.reserve(arms.size());
  for (const ArmTally* arm : arms) totals.push_back(total_of(*arm));
  const double value = of(totals);
  const ArmTally& matches = *arms.front();
  const auto without_match = [&](std::size_t m) {
    std::vector<MatchTally> rest = totals;
    for (std::size_t a = 0; a < arms.size(); ++a) rest[a] = without(rest[a], (*arms[a])[m]);
    return of(rest);
  };
  const double reach = half_width_of(matches, evaluator::stats::jackknife(matches.size(), without_match));
  return {value, {value - reach, value + reach}};
}

std::optional<Standing> standing_of(const FrontierReport& report, const FixedPoint& fixed) {
  const MatchTally own = total_of(fixed.matches);
  if (own.kicks == 0) return std::nullopt;
  const auto points = by_kicks(report);
  if (points.empty()) return std::nullopt;
  const auto fewer = std::ranges::find_if(
      points, [&](const FrontierPoint* point) { return total_of(point->matches).kicks < own.kicks; });
  const bool within = fewer != points.begin() && fewer != points.end();
  const FrontierPoint& to = within ? **fewer : fewer == points.begin() ? *points.front() : *points.back();
  const FrontierPoint& from = within ? **std::prev(fewer) : to;
  const auto above = [within](const std::vector<MatchTally>& totals) {
    const MatchTally &more = totals[0], &less = totals[1], &of_policy = totals[2];
    if (!within) return efficiency_of(less) - efficiency_of(of_policy);
    const double kicks = kicks_per_opportunity(of_policy);
    const double most = kicks_per_opportunity(more), least = kicks_per_opportunity(less);
    const double part = most > least ? (most - kicks) / (most - least) : 0.0;
    const double on_target = std::lerp(on_target_per_opportunity(more), on_target_per_opportunity(less), part);
    return on_target / kicks - efficiency_of(of_policy);
  };
  Effect difference = jackknife({&from.matches, &to.matches, &fixed.matches}, above);
  if (has_interval(difference)) difference.ci = {std::max(difference.ci.lo, -1.0), std::min(difference.ci.hi, 1.0)};
  return Standing{fixed.name, from.threshold, to.threshold, within, difference};
}

const FrontierPoint& best_of(const FrontierReport& report) {
  const auto best = std::ranges::max_element(
      report.points, {}, [](const FrontierPoint& point) { return total_of(point.matches).on_target; });
  if (best == report.points.end()) throw std::invalid_argument{"no threshold was played"};
  return *best;
}

Effect share_of_oracle(const FrontierReport& report) {
  if (!report.oracle) throw std::invalid_argument{"no oracle was played"};
  Effect share =
      jackknife({&best_of(report).matches, &report.oracle->matches},
                [](const std::vector<MatchTally>& totals) { return ratio(totals[0].on_target, totals[1].on_target); });
  if (has_interval(share)) share.ci.lo = std::max(share.ci.lo, 0.0);
  return share;
}

std::vector<StudyRow> rows_of(const FrontierReport& report) {
  std::vector<StudyRow> rows;
  const auto add = [&](const std::string& policy, const std::string& threshold, const ArmTally& matches) {
    rows.push_back({{{"policy", policy}, {"threshold", threshold}}, matches});
  };
  for (const FrontierPoint& point : report.points)
    add(report.policy, fmt::format("{:g}", point.threshold), point.matches);
  for (const FixedPoint& fixed : report.fixed) add(fixed.name, "", fixed.matches);
  if (report.oracle) add(report.oracle->name, "", report.oracle->matches);
  return rows;
}

std::string to_text(const FrontierReport& report) {
  std::vector<StudyColumn> columns{label_column("policy", "policy"), label_column("threshold", "threshold"),
                                   kicks_per_opportunity_column()};
  for (StudyColumn& column : share_columns(report.played)) columns.push_back(std::move(column));
  columns.push_back(kicks_column());
  std::string text = heading(report.played, "policy and threshold") + table_of(rows_of(report), columns) + '\n';
  for (const FixedPoint& fixed : report.fixed) text += sentence(report, fixed);
  if (report.oracle) text += oracle_sentence(report);
  return text;
}

Json to_json(const FrontierReport& report) {
  Json json = json_of("frontier", rows_of(report), report.played);
  json["policy"] = report.policy;
  json["standings"] = Json::array();
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
