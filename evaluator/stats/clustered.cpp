#include "evaluator/stats/clustered.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "evaluator/stats/interval.hpp"
#include "evaluator/stats/square.hpp"

namespace trivela::evaluator::stats {
namespace {

double real(std::int64_t n) { return static_cast<double>(n); }

void add(Counts& sum, Counts counts) { sum = {sum.inside + counts.inside, sum.n + counts.n}; }

// What a match adds to the estimate's error, from either side.
struct Sides {
  double older = 0.0;
  double newer = 0.0;
  bool has_older = false;
  bool has_newer = false;
};

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

}  // namespace

std::optional<Clustered> clustered_difference(std::span<const MatchCounts> cells, double confidence) {
  const auto totals = totals_of(cells);
  if (totals.empty()) return std::nullopt;
  Clustered result;
  double independent = 0.0;
  for (const auto& [number, total] : totals) {
    const double p1 = *efficiency(total.older), p2 = *efficiency(total.newer);
    result.value += total.weight * (p2 - p1);
    independent +=
        square(total.weight) * (p1 * (1.0 - p1) / real(total.older.n) + p2 * (1.0 - p2) / real(total.newer.n));
  }
  std::map<std::uint32_t, Sides> matches;
  for (const MatchCounts& cell : cells) {
    const auto found = totals.find(cell.stratum);
    if (found == totals.end()) continue;
    const StratumTotal& total = found->second;
    Sides& match = matches[cell.match];
    match.older +=
        total.weight * (real(cell.older.inside) - real(cell.older.n) * *efficiency(total.older)) / real(total.older.n);
    match.newer +=
        total.weight * (real(cell.newer.inside) - real(cell.newer.n) * *efficiency(total.newer)) / real(total.newer.n);
    match.has_older = match.has_older || cell.older.n > 0;
    match.has_newer = match.has_newer || cell.newer.n > 0;
  }
  bool shared = false;
  double g = 0.0, together = 0.0, older = 0.0, newer = 0.0;
  for (const auto& [number, match] : matches) {
    result.older_matches += match.has_older ? 1 : 0;
    result.newer_matches += match.has_newer ? 1 : 0;
    shared = shared || (match.has_older && match.has_newer);
    g += match.has_older || match.has_newer ? 1.0 : 0.0;
    together += square(match.newer - match.older);
    older += square(match.older);
    newer += square(match.newer);
  }
  if (std::min(result.older_matches, result.newer_matches) < kFewestMatches) return std::nullopt;
  double variance = 0.0;
  if (shared) {
    variance = together * g / (g - 1.0);
    result.df = g - 1.0;
  } else {
    const double g1 = real(static_cast<std::int64_t>(result.older_matches));
    const double g2 = real(static_cast<std::int64_t>(result.newer_matches));
    older *= g1 / (g1 - 1.0);
    newer *= g2 / (g2 - 1.0);
    variance = older + newer;
    result.df = variance > 0.0 ? square(variance) / (square(older) / (g1 - 1.0) + square(newer) / (g2 - 1.0))
                               : std::min(g1, g2) - 1.0;
  }
  result.standard_error = std::sqrt(variance);
  result.design_effect = independent > 0.0 ? variance / independent : 1.0;
  const double half_width = t_of(confidence, result.df) * result.standard_error;
  result.ci = {std::max(result.value - half_width, -1.0), std::min(result.value + half_width, 1.0)};
  return result;
}

std::optional<Interval> clustered_wilson(std::span<const Counts> matches, double confidence) {
  Counts total;
  std::size_t g = 0;
  for (const Counts& match : matches) {
    add(total, match);
    g += match.n > 0 ? 1 : 0;
  }
  if (g < kFewestMatches) return std::nullopt;
  const double p = *efficiency(total), n = real(total.n);
  double variance = 0.0;
  for (const Counts& match : matches) variance += square((real(match.inside) - real(match.n) * p) / n);
  variance *= static_cast<double>(g) / (static_cast<double>(g) - 1.0);
  const double independent = p * (1.0 - p) / n;
  const double design_effect = independent > 0.0 ? std::max(variance / independent, 1.0) : 1.0;
  const double z = z_of(confidence);
  const double n_effective = n / design_effect * square(z / t_of(confidence, static_cast<double>(g) - 1.0));
  return wilson_of(p, n_effective, confidence);
}

}  // namespace trivela::evaluator::stats
