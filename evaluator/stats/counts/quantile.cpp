#include "evaluator/stats/counts/quantile.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace trivela::evaluator::stats {

double z_of(double confidence) { return boost::math::quantile(boost::math::normal(), 0.5 * (1.0 + confidence)); }

double t_of(double confidence, double df) {
  return boost::math::quantile(boost::math::students_t(df), 0.5 * (1.0 + confidence));
}

double two_sided_p(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

double student_p(double t, double df) {
  return 2.0 * boost::math::cdf(boost::math::complement(boost::math::students_t(df), std::abs(t)));
}

double chi_square_p(double statistic, double df) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(df), std::max(statistic, 0.0)));
}

}  // namespace trivela::evaluator::stats
