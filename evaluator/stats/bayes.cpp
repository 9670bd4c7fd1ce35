#include "evaluator/stats/bayes.hpp"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/roots.hpp>

namespace trivela::evaluator::stats {
namespace {

constexpr double kTail = 1e-17;     // of a posterior, beyond the ends of its range
constexpr double kNothing = 1e-14;  // less than this is rounding
constexpr int kPanels = 16;         // a range is some 17 standard deviations wide

using Posterior = boost::math::beta_distribution<>;

Posterior posterior(Counts counts) {
  return {static_cast<double>(counts.inside) + 1.0, static_cast<double>(counts.n - counts.inside) + 1.0};
}

Interval range(const Posterior& p) {
  return {boost::math::quantile(p, kTail), boost::math::quantile(boost::math::complement(p, kTail))};
}

// P(newer - older > difference) of independent ones.
double p_above(const Posterior& older, const Posterior& newer, double difference) {
  const Interval old_range = range(older);
  const Interval new_range = range(newer);
  // Only where both have their range is there anything to integrate; above it the older one's F is 1.
  const double lo = std::max(old_range.lo + difference, new_range.lo);
  const double hi = std::min(old_range.hi + difference, new_range.hi);
  const double beyond = old_range.hi + difference;
  double p = beyond >= 1.0 ? 0.0 : boost::math::cdf(boost::math::complement(newer, std::max(beyond, 0.0)));
  const auto integrand = [&](double x) {
    return boost::math::pdf(newer, x) * boost::math::cdf(older, std::clamp(x - difference, 0.0, 1.0));
  };
  for (int panel = 0; panel < kPanels && lo < hi; ++panel) {
    const double width = (hi - lo) / kPanels;
    p += boost::math::quadrature::gauss<double, 20>::integrate(integrand, lo + panel * width, lo + (panel + 1) * width);
  }
  return std::clamp(p, 0.0, 1.0);
}

}  // namespace

double p_new_better(Counts older, Counts newer, double difference) {
  return p_above(posterior(older), posterior(newer), difference);
}

PosteriorDifference posterior_difference(Counts older, Counts newer, double confidence) {
  const Posterior p1 = posterior(older), p2 = posterior(newer);
  const Interval r1 = range(p1), r2 = range(p2);
  const auto quantile = [&](double q) {
    const auto excess = [&](double x) { return p_above(p1, p2, x) - (1.0 - q); };
    double lo = r2.lo - r1.hi, hi = r2.hi - r1.lo;
    std::uintmax_t steps = 200;
    const auto bracket =
        boost::math::tools::toms748_solve(excess, lo, hi, boost::math::tools::eps_tolerance<double>(40), steps);
    return 0.5 * (bracket.first + bracket.second);
  };
  const double tail = 0.5 * (1.0 - confidence);
  return {quantile(0.5), {quantile(tail), quantile(1.0 - tail)}};
}

double expected_loss_of_newer(Counts older, Counts newer) {
  const Posterior p1 = posterior(older), p2 = posterior(newer);
  const auto more_inside = [](const Posterior& p) { return Posterior(p.alpha() + 1.0, p.beta()); };
  // P(older > newer) twice, by the complement's own integral so that small ones keep their digits.
  const double with_older = boost::math::mean(p1) * p_above(p2, more_inside(p1), 0.0);
  const double with_newer = boost::math::mean(p2) * p_above(more_inside(p2), p1, 0.0);
  const double loss = with_older - with_newer;
  return loss < kNothing ? 0.0 : loss;
}

}  // namespace trivela::evaluator::stats
