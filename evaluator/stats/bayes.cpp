#include "evaluator/stats/bayes.hpp"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/quadrature/gauss.hpp>

namespace trivela::evaluator::stats {
namespace {

constexpr double kTail = 1e-17;  // of a posterior, beyond the ends of its range
constexpr int kPanels = 16;      // a range is some 17 standard deviations wide

using Posterior = boost::math::beta_distribution<>;

Posterior posterior(Counts counts) {
  return {static_cast<double>(counts.inside) + 1.0, static_cast<double>(counts.n - counts.inside) + 1.0};
}

Interval range(const Posterior& p) {
  return {boost::math::quantile(p, kTail), boost::math::quantile(boost::math::complement(p, kTail))};
}

}  // namespace

double p_new_better(Counts older, Counts newer) {
  const Posterior old_posterior = posterior(older);
  const Posterior new_posterior = posterior(newer);
  const Interval old_range = range(old_posterior);
  const Interval new_range = range(new_posterior);
  // Only where both have their range is there anything to integrate; above it the older one's F is 1.
  const double lo = std::max(old_range.lo, new_range.lo);
  const double hi = std::min(old_range.hi, new_range.hi);
  double p = boost::math::cdf(boost::math::complement(new_posterior, old_range.hi));
  const auto integrand = [&](double x) {
    return boost::math::pdf(new_posterior, x) * boost::math::cdf(old_posterior, x);
  };
  for (int panel = 0; panel < kPanels && lo < hi; ++panel) {
    const double width = (hi - lo) / kPanels;
    p += boost::math::quadrature::gauss<double, 20>::integrate(integrand, lo + panel * width, lo + (panel + 1) * width);
  }
  return std::clamp(p, 0.0, 1.0);
}

}  // namespace trivela::evaluator::stats
