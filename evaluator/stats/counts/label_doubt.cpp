#include "evaluator/stats/counts/label_doubt.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::evaluator::stats {
namespace {

constexpr double kEnough = 0.975;
constexpr double kManyEvents = 500.0;  // from here on Poisson's is as good as normal

}  // namespace

std::int64_t most_wrong(double expected) {
  if (!(expected > 0.0)) return 0;
  if (expected > kManyEvents) return std::llround(expected + 1.959963984540054 * std::sqrt(expected) + 1.0);
  double term = std::exp(-expected), sum = term;
  std::int64_t k = 0;
  while (sum < kEnough) {
    term *= expected / static_cast<double>(++k);
    sum += term;
  }
  return k;
}

Interval efficiency_bounds(const DoubtfulCounts& counts) {
  const std::int64_t kicks = counts.known.n + counts.unknown;
  if (kicks == 0) return {0.0, 1.0};
  const std::int64_t outside = counts.known.n - counts.known.inside;
  const std::int64_t least = counts.known.inside - std::min(counts.known.inside, most_wrong(counts.doubt.inside));
  const std::int64_t most = counts.known.inside + counts.unknown + std::min(outside, most_wrong(counts.doubt.outside));
  return {static_cast<double>(least) / static_cast<double>(kicks),
          static_cast<double>(most) / static_cast<double>(kicks)};
}

Interval difference_bounds(const DoubtfulCounts& older, const DoubtfulCounts& newer) {
  if (older.known.n + older.unknown == 0 || newer.known.n + newer.unknown == 0) return {-1.0, 1.0};
  const Interval a = efficiency_bounds(older), b = efficiency_bounds(newer);
  return {b.lo - a.hi, b.hi - a.lo};
}

}  // namespace trivela::evaluator::stats
