#include "evaluator/stats/poisson.hpp"

#include <limits>

#include "evaluator/stats/binomial.hpp"

namespace trivela::evaluator::stats {

std::optional<RateRatio> rate_ratio(Rate older, Rate newer, double confidence) {
  const Counts share{newer.events, newer.events + older.events};
  if (share.n == 0) return std::nullopt;
  const double time_ratio = older.minutes / newer.minutes;
  const auto ratio_of = [&](double p) {
    return p < 1.0 ? p / (1.0 - p) * time_ratio : std::numeric_limits<double>::infinity();
  };
  const Interval ci = clopper_pearson(share, confidence);
  return RateRatio{ratio_of(*efficiency(share)),
                   {ratio_of(ci.lo), ratio_of(ci.hi)},
                   binomial_two_sided(share, newer.minutes / (newer.minutes + older.minutes))};
}

}  // namespace trivela::evaluator::stats
