#include "evaluator/stats/clustered.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "evaluator/stats/bias_reduced.hpp"
#include "evaluator/stats/counts/exact.hpp"

namespace trivela::evaluator::stats {
namespace {

double real(std::int64_t n) { return static_cast<double>(n); }

void add(Counts& sum, Counts counts) { sum = {sum.inside + counts.inside, sum.n + counts.n}; }

/// p (1 - p) / n after one kick inside and one outside are added, so that it is never 0 (Agresti and Caffo 2000).
double smoothed_variance(Counts counts) {
  const double n = real(counts.n) + 2.0, p = (real(counts.inside) + 1.0) / n;
  return p * (1.0 - p) / n;
}

Interval no_narrower_than_exact(Interval wilson, Counts counts, double confidence) {
  const Interval exact = clopper_pearson(counts, confidence);
  return {std::min(wilson.lo, exact.lo), std::max(wilson.hi, exact.hi)};
}

struct StratumTotal {
  Counts older;
  Counts newer;
  double weight = 0.0;
};

std::map<std::uint32_t, StratumTotal> totals_of(std::span<const MatchCounts> cells) {
  std::map<std::uint32_t, StratumTotal> totals;
  for (const MatchCounts& cell : cells) {
    add(totals[cell.stratum].older, cell.older);
    add(totals[cell.stratum].newer, cell.newer);
  }
  double kicks = 0.0;
  std::erase_if(totals, [](const auto& entry) { return entry.second.older.n == 0 || entry.second.newer.n == 0; });
  for (const auto& [number, total] : totals) kicks += real(total.older.n + total.newer.n);
  for (auto& [number, total] : totals) total.weight = real(total.older.n + total.newer.n) / kicks;
  return totals;
}

// Cells of the same match and part, of several calibrations, together.
std::vector<RatioCell> merged(const std::vector<RatioCell>& cells) {
  std::map<std::pair<std::uint32_t, std::size_t>, RatioCell> sums;
  for (const RatioCell& cell : cells) {
    RatioCell& sum = sums.try_emplace({cell.match, cell.part}, RatioCell{cell.match, cell.part}).first->second;
    sum.x += cell.x;
    sum.n += cell.n;
    sum.spread += cell.spread;
  }
  std::vector<RatioCell> result;
  result.reserve(sums.size());
  for (const auto& [key, sum] : sums) result.push_back(sum);
  return result;
}

// Few matches, and what many calibrations differ by.
BiasReduced with_calibrations(const BiasReduced& by_match, const ClusterVariance& by_both) {
  if (!by_both.by_calibration) return by_match;
  return {std::max(by_match.variance, by_both.variance), std::min(by_match.df, by_both.df)};
}

// The weighted difference as a sum of shares, and what each match adds to them.
struct DifferenceParts {
  std::vector<RatioPart> parts;  // of each stratum the older one's, then the newer one's
  std::vector<RatioCell> cells;
  std::vector<Influence> influences;
  std::set<std::uint32_t> with_older, with_newer;  // matches
};

DifferenceParts parts_of(std::span<const MatchCounts> cells, const std::map<std::uint32_t, StratumTotal>& totals) {
  DifferenceParts sum;
  std::map<std::uint32_t, std::size_t> places;  // of the older one's part, by stratum
  for (const auto& [number, total] : totals) {
    places[number] = sum.parts.size();
    sum.parts.push_back({real(total.older.inside), real(total.older.n), -total.weight, false});
    sum.parts.push_back({real(total.newer.inside), real(total.newer.n), total.weight, true});
  }
  for (const MatchCounts& cell : cells) {
    const auto found = places.find(cell.stratum);
    if (found == places.end()) continue;
    for (const auto& [place, counts] : {std::pair{found->second, cell.older}, {found->second + 1, cell.newer}}) {
      if (counts.n == 0) continue;
      const RatioPart& part = sum.parts[place];
      const double x = real(counts.inside), n = real(counts.n), p = part.x / part.n;
      (part.newer ? sum.with_newer : sum.with_older).insert(cell.match);
      sum.cells.push_back({cell.match, place, x, n, spread_of_trials(n, p)});
      sum.influences.push_back({cell.match, cell.calibration, part.weight * (x - n * p) / part.n});
    }
  }
  return sum;
}

template <typename Key>
double squares(const std::map<Key, double>& sums) {
  double total = 0.0;
  for (const auto& [key, sum] : sums) total += square(sum);
  return total;
}

}  // namespace

std::optional<Clustered> clustered_difference(std::span<const MatchCounts> cells, double confidence) {
  const auto totals = totals_of(cells);
  if (totals.empty()) return std::nullopt;
  Clustered result;
  double independent = 0.0, smoothed = 0.0;
  for (const auto& [number, total] : totals) {
    const double p1 = *efficiency(total.older), p2 = *efficiency(total.newer);
    result.value += total.weight * (p2 - p1);
    independent +=
        square(total.weight) * (p1 * (1.0 - p1) / real(total.older.n) + p2 * (1.0 - p2) / real(total.newer.n));
    smoothed += square(total.weight) * (smoothed_variance(total.older) + smoothed_variance(total.newer));
  }
  const DifferenceParts sum = parts_of(cells, totals);
  result.older_matches = sum.with_older.size();
  result.newer_matches = sum.with_newer.size();
  if (std::min(result.older_matches, result.newer_matches) < kFewestMatches) return std::nullopt;
  const ClusterVariance by_both = *cluster_variance(sum.influences);
  const BiasReduced spread = with_calibrations(bias_reduced(sum.parts, merged(sum.cells)), by_both);
  result.df = spread.df;
  // Few matches that happen to be alike show less than independent kicks would: their interval is no narrower.
  const bool few = std::min(result.older_matches, result.newer_matches) < kManyMatches || spread.variance == 0.0;
  const double floor = few ? smoothed * square(z_of(confidence) / t_of(confidence, result.df)) : 0.0;
  const double variance = std::max(spread.variance, floor);
  result.calibrations = by_both.calibrations;
  result.by_calibration = by_both.by_calibration;
  result.standard_error = std::sqrt(variance);
  result.design_effect = independent > 0.0 ? variance / independent : 1.0;
  const double half_width = t_of(confidence, result.df) * result.standard_error;
  result.ci = {std::max(result.value - half_width, -1.0), std::min(result.value + half_width, 1.0)};
  return result;
}

std::optional<Interval> clustered_wilson(std::span<const ClusterCounts> cells, double confidence) {
  Counts total;
  std::set<std::uint32_t> matches;
  for (const ClusterCounts& cell : cells) {
    add(total, cell.counts);
    if (cell.counts.n > 0) matches.insert(cell.match);
  }
  if (matches.size() < kFewestMatches) return std::nullopt;
  const double p = *efficiency(total), n = real(total.n);
  const RatioPart part{real(total.inside), n, 1.0, false};
  std::vector<RatioCell> of_match;
  std::vector<Influence> influences;
  for (const ClusterCounts& cell : cells) {
    const double x = real(cell.counts.inside), of = real(cell.counts.n);
    if (of == 0.0) continue;
    of_match.push_back({cell.match, 0, x, of, spread_of_trials(of, p)});
    influences.push_back({cell.match, cell.calibration, (x - of * p) / n});
  }
  const BiasReduced variance =
      with_calibrations(bias_reduced({&part, 1}, merged(of_match)), *cluster_variance(influences));
  const double independent = p * (1.0 - p) / n;
  const double design_effect = independent > 0.0 ? std::max(variance.variance / independent, 1.0) : 1.0;
  const double n_effective = n / design_effect * square(z_of(confidence) / t_of(confidence, variance.df));
  const Interval wilson = wilson_of(p, n_effective, confidence);
  return std::ssize(matches) < kEnoughForWilson ? no_narrower_than_exact(wilson, total, confidence) : wilson;
}

std::optional<Interval> clustered_wilson(std::span<const Counts> matches, double confidence) {
  std::vector<ClusterCounts> cells;
  for (const Counts& match : matches) cells.push_back({static_cast<std::uint32_t>(cells.size()), 0, match});
  return clustered_wilson(cells, confidence);
}

Interval wilson_or_exact(Counts counts, double confidence) {
  const Interval alone = wilson(counts, confidence);
  const bool few = counts.n > 0 && counts.n < kEnoughForWilson;
  return few ? no_narrower_than_exact(alone, counts, confidence) : alone;
}

Interval newcombe_or_exact(Counts older, Counts newer, double confidence) {
  if (older.n == 0 || newer.n == 0) return {-1.0, 1.0};
  return newcombe_of(older, wilson_or_exact(older, confidence), newer, wilson_or_exact(newer, confidence));
}

double ClusterVariance::reach(double confidence) const {
  return std::isfinite(variance) ? t_of(confidence, df) * std::sqrt(variance) : std::nan("");
}

std::optional<ClusterVariance> cluster_variance(std::span<const Influence> influences) {
  std::map<std::uint32_t, double> by_match, by_calibration;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> by_both;
  for (const Influence& influence : influences) {
    by_match[influence.match] += influence.u;
    by_calibration[influence.calibration] += influence.u;
    by_both[{influence.match, influence.calibration}] += influence.u;
  }
  if (by_match.size() < 2) return std::nullopt;
  ClusterVariance result{.matches = by_match.size(), .calibrations = by_calibration.size()};
  const double m = static_cast<double>(result.matches), k = static_cast<double>(result.calibrations);
  const double of_matches = m / (m - 1.0) * squares(by_match);
  result.variance = of_matches;
  result.df = m - 1.0;
  result.by_calibration = result.calibrations >= kFewestCalibrations;
  if (!result.by_calibration) return result;
  const double of_calibrations = k / (k - 1.0) * squares(by_calibration);
  const double crossed =
      m / (m - 1.0) * k / (k - 1.0) * (squares(by_match) + squares(by_calibration) - squares(by_both));
  result.variance = std::max({crossed, of_matches, of_calibrations});
  if (result.variance == 0.0) return result;
  const double of_both = of_matches + of_calibrations - result.variance;
  result.df = square(result.variance) / (square(of_matches) / (m - 1.0) + square(of_calibrations) / (k - 1.0) +
                                         square(of_both) / ((m - 1.0) * (k - 1.0)));
  return result;
}

std::vector<double> jackknife(std::size_t n, const std::function<double(std::size_t)>& without) {
  const auto count = static_cast<double>(n);
  std::vector<double> left_out;
  double mean = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    left_out.push_back(without(i));
    mean += left_out.back() / count;
  }
  for (double& each : left_out) each = (count - 1.0) / count * (mean - each);
  return left_out;
}

}  // namespace trivela::evaluator::stats
