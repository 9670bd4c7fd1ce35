#include "evaluator/stats/paired.hpp"

#include <algorithm>
#include <cmath>

#include "evaluator/stats/counts/exact.hpp"

namespace trivela::evaluator::stats {
namespace {

double correlation(const PairedCounts& pairs) {
  const double both = static_cast<double>(pairs.both);
  const double newer = static_cast<double>(pairs.newer_only);
  const double older = static_cast<double>(pairs.older_only);
  const double neither = static_cast<double>(pairs.neither);
  const double margins = (both + newer) * (older + neither) * (both + older) * (newer + neither);
  if (margins <= 0.0) return 0.0;
  double product = both * neither - newer * older;
  if (product > 0.0) product = std::max(product - 0.5 * static_cast<double>(pairs.n()), 0.0);
  return product / std::sqrt(margins);
}

double combined(double a, double b, double phi) { return std::sqrt(std::max(a * a - 2.0 * phi * a * b + b * b, 0.0)); }

}  // namespace

double mcnemar_two_sided(const PairedCounts& pairs) {
  return binomial_two_sided({pairs.older_only, pairs.older_only + pairs.newer_only}, 0.5);
}

Interval paired_newcombe(const PairedCounts& pairs, double confidence) {
  if (pairs.n() == 0) return {-1.0, 1.0};
  const double p1 = *efficiency(pairs.older());
  const double p2 = *efficiency(pairs.newer());
  const Interval w1 = wilson(pairs.older(), confidence);
  const Interval w2 = wilson(pairs.newer(), confidence);
  const double phi = correlation(pairs);
  return {p2 - p1 - combined(p2 - w2.lo, w1.hi - p1, phi), p2 - p1 + combined(w2.hi - p2, p1 - w1.lo, phi)};
}

}  // namespace trivela::evaluator::stats
