#include <fmt/format.h>

#include <map>

#include "evaluator/page/figures/figure.hpp"
#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"
#include "evaluator/render/text_table.hpp"

namespace trivela::evaluator::page {
namespace {

IntervalRow row_of(const std::string& label, stats::Counts counts, const stats::Interval& ci, std::size_t colour) {
  const auto share = stats::efficiency(counts);
  IntervalRow row{.label = label, .known = share.has_value(), .colour = colour};
  row.value = share.value_or(0.0);
  row.lo = ci.lo;
  row.hi = ci.hi;
  row.numbers = share ? fmt::format("{}/{}, {}", counts.inside, counts.n, percent(*share)) : "no kicks";
  return row;
}

IntervalRow heading(const std::string& label) { return {.label = label, .heading = true}; }

/// Kicks of known outcome by band of distance and policy.
std::map<std::pair<std::uint32_t, std::string>, stats::Counts> by_distance(const PageView& view) {
  std::map<std::pair<std::uint32_t, std::string>, stats::Counts> bands;
  const bool apart = !view.report.policies.empty() && view.report.policies.front().blocked_apart;
  for (const PageKick& kick : view.data.kicks) {
    if (!kick.timeline.observed || !(kick.timeline.distance_m > 0.0)) continue;
    const std::string& outcome = kick.timeline.observed->outcome;
    if (outcome == "unknown" || outcome.empty() || (apart && outcome == "blocked")) continue;
    stats::Counts& counts = bands[{distance_bin(kick.timeline.distance_m), kick.timeline.policy}];
    ++counts.n;
    counts.inside += outcome == "on_target" ? 1 : 0;
  }
  return bands;
}

}  // namespace

std::string forest_section(const PageView& view) {
  IntervalPlot plot{.head = {.id = "forest-figure",
                             .says = "Efficiency of policies, robots and distances",
                             .simulated = view.simulated},
                    .axis_label = "efficiency [%]",
                    .from = 0.0,
                    .to = 1.0,
                    .unit = 0.01,
                    .note =
                        "A dot is the share of kicks on target, its line the 95 % interval: the fewer kicks, the "
                        "longer. Lines that overlap widely cannot be told apart."};
  plot.rows.push_back(heading("policies"));
  for (const PolicyRow& row : view.report.policies)
    plot.rows.push_back(row_of(name_of(row), row.counts(), row.efficiency_ci(), colour_of(view, row.policy)));
  if (plot.rows.size() == 1) return paragraphs({"There are no kicks."});
  if (!view.report.robots.empty()) plot.rows.push_back(heading("robots"));
  for (const RobotRow& row : view.report.robots) {
    plot.rows.push_back(row_of(fmt::format("robot {}, {}", row.robot_id, name_of(row)), row.counts(),
                               stats::wilson(row.counts()), colour_of(view, row.policy)));
  }
  const auto bands = by_distance(view);
  if (!bands.empty()) plot.rows.push_back(heading("distance"));
  for (const auto& [band, counts] : bands) {
    plot.rows.push_back(row_of(fmt::format("{}, {}", distance_bins()[band.first], band.second), counts,
                               stats::wilson(counts), colour_of(view, band.second)));
  }
  return interval_plot(plot) + (bands.empty() ? paragraphs({"No kick says its distance."}) : "");
}

}  // namespace trivela::evaluator::page
