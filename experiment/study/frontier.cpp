#include "experiment/study/frontier.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

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

}  // namespace trivela::experiment
