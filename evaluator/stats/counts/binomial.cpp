#include "evaluator/stats/counts/exact.hpp"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>

namespace trivela::evaluator::stats {
namespace {

constexpr double kBinomialTie = 1.0 + 1e-7;  // probabilities so near are equal but for rounding, as in R

// The least x of [lo, hi] for which `holds`, which is false and then true; hi + 1: for none.
template <typename Predicate>
std::int64_t first_that(std::int64_t lo, std::int64_t hi, Predicate holds) {
  while (lo <= hi) {
    const std::int64_t mid = lo + (hi - lo) / 2;
    if (holds(mid)) {
      hi = mid - 1;
    } else {
      lo = mid + 1;
    }
  }
  return lo;
}

}  // namespace

double binomial_two_sided(Counts counts, double p) {
  if (counts.n == 0) return 1.0;
  const boost::math::binomial distribution(static_cast<double>(counts.n), p);
  const auto pmf = [&](std::int64_t k) { return boost::math::pdf(distribution, static_cast<double>(k)); };
  const auto at_most = [&](std::int64_t k) {
    return k < 0 ? 0.0 : boost::math::cdf(distribution, static_cast<double>(k));
  };
  const auto at_least = [&](std::int64_t k) {
    return k > counts.n ? 0.0
           : k <= 0     ? 1.0
                        : boost::math::cdf(boost::math::complement(distribution, static_cast<double>(k - 1)));
  };
  const double limit = pmf(counts.inside) * kBinomialTie;
  const auto mode = std::min(static_cast<std::int64_t>(static_cast<double>(counts.n + 1) * p), counts.n);
  if (pmf(mode) <= limit) return 1.0;
  // The probabilities rise up to the mode and fall beyond it, so that each tail has one boundary.
  if (counts.inside < mode) {
    return std::min(1.0, at_most(counts.inside) +
                             at_least(first_that(mode + 1, counts.n, [&](auto k) { return pmf(k) <= limit; })));
  }
  return std::min(
      1.0, at_least(counts.inside) + at_most(first_that(0, mode - 1, [&](auto k) { return pmf(k) > limit; }) - 1));
}

Interval clopper_pearson(Counts counts, double confidence) {
  if (counts.n == 0) return {0.0, 1.0};
  const double k = static_cast<double>(counts.inside);
  const double n = static_cast<double>(counts.n);
  const double tail = 0.5 * (1.0 - confidence);
  using Beta = boost::math::beta_distribution<>;
  return {counts.inside == 0 ? 0.0 : boost::math::quantile(Beta(k, n - k + 1.0), tail),
          counts.inside == counts.n ? 1.0 : boost::math::quantile(boost::math::complement(Beta(k + 1.0, n - k), tail))};
}

}  // namespace trivela::evaluator::stats
