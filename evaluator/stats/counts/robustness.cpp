#include "evaluator/stats/counts/robustness.hpp"

#include <cmath>

#include "evaluator/stats/counts/exact.hpp"
#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::stats {
namespace {

// The least number of flips, from 1 to `most`, with which the table is not significant; p grows up to where both are
// alike.
template <typename Flipped>
std::int64_t flips(std::int64_t most, double alpha, Flipped p_after) {
  std::int64_t lo = 1, hi = most;
  while (lo < hi) {
    const std::int64_t mid = lo + (hi - lo) / 2;
    if (p_after(mid) >= alpha) {
      hi = mid;
    } else {
      lo = mid + 1;
    }
  }
  return lo;
}

// Flips that make a group as good as the other, rounded up.
std::int64_t to_alike(Counts from, Counts to) {
  const double wanted = *efficiency(to) * static_cast<double>(from.n);
  return static_cast<std::int64_t>(std::ceil(std::abs(wanted - static_cast<double>(from.inside))));
}

}  // namespace

std::optional<Fragility> fragility(Counts older, Counts newer, double alpha) {
  if (fisher_two_sided(older, newer) >= alpha) return std::nullopt;
  const std::int64_t sign = *efficiency(newer) > *efficiency(older) ? 1 : -1;
  return Fragility{flips(to_alike(newer, older), alpha,
                         [&](std::int64_t k) {
                           return fisher_two_sided(older, {newer.inside - sign * k, newer.n});
                         }),
                   flips(to_alike(older, newer), alpha, [&](std::int64_t k) {
                     return fisher_two_sided({older.inside + sign * k, older.n}, newer);
                   })};
}

double e_value(double risk_ratio) {
  const double rr = risk_ratio < 1.0 ? 1.0 / risk_ratio : risk_ratio;
  return rr + std::sqrt(rr * (rr - 1.0));
}

}  // namespace trivela::evaluator::stats
