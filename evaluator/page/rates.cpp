#include <fmt/format.h>

#include <algorithm>

#include "evaluator/page/figures/figure.hpp"
#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"
#include "evaluator/stats/poisson.hpp"

namespace trivela::evaluator::page {

std::string rates_section(const PageView& view) {
  const auto& policies = view.report.policies;
  const auto known = [](const PolicyRow& row) { return row.played_min && *row.played_min > 0.0; };
  if (std::ranges::none_of(policies, known))
    return section("rates", "How often a minute", paragraphs({"How long was played is not in the log."}));
  IntervalPlot plot{.head = {.id = "rates-figure",
                             .says = "Chances, kicks and shots on target a minute of play",
                             .simulated = view.simulated},
                    .axis_label = "a minute of play",
                    .note =
                        "A minute of play is one in which the policy's robots had the ball and the game ran. A "
                        "chance is a possession. Lines: 95 % intervals, as if events came independently."};
  const auto rows_of = [&](const std::string& name, const auto& events_of) {
    plot.rows.push_back({.label = name, .heading = true});
    for (const PolicyRow& row : policies) {
      const std::optional<std::int64_t> events = events_of(row);
      if (!known(row) || !events) continue;
      const auto ci = stats::rate_interval({*events, *row.played_min});
      const double rate = static_cast<double>(*events) / *row.played_min;
      plot.to = std::max(plot.to, ci.hi);
      plot.rows.push_back({.label = name_of(row),
                           .value = rate,
                           .lo = ci.lo,
                           .hi = ci.hi,
                           .numbers = fmt::format("{} in {:.1f} min", *events, *row.played_min),
                           .colour = colour_of(view, row.policy)});
    }
  };
  const auto& chances = view.data.opportunities;
  if (!chances.empty()) {
    rows_of("chances", [&](const PolicyRow& row) -> std::optional<std::int64_t> {
      const auto found = chances.find(row.policy);
      const bool shared =
          std::ranges::count(policies, row.policy, &PolicyRow::policy) > 1;  // whose they were is not said
      return shared || found == chances.end() ? std::nullopt : std::optional(found->second);
    });
  }
  rows_of("kicks", [](const PolicyRow& row) { return std::optional(row.kicks()); });
  rows_of("on target", [](const PolicyRow& row) { return std::optional(row.inside()); });
  std::string body = interval_plot(plot);
  if (chances.empty()) body += paragraphs({"Nobody counted chances in these logs."});
  return section("rates", "How often a minute", body);
}

}  // namespace trivela::evaluator::page
