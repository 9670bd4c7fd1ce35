#include "evaluator/stats/counts/interval.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>

namespace trivela::evaluator::stats {
namespace {

Ratio log_interval(double value, double variance, double confidence) {
  const double half_width = z_of(confidence) * std::sqrt(variance);
  return {value, {value * std::exp(-half_width), value * std::exp(half_width)}};
}

}  // namespace

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

std::optional<double> efficiency(Counts counts) {
  if (counts.n == 0) return std::nullopt;
  return static_cast<double>(counts.inside) / static_cast<double>(counts.n);
}

Interval wilson(Counts counts, double confidence) {
  if (counts.n == 0) return {0.0, 1.0};
  return wilson_of(*efficiency(counts), static_cast<double>(counts.n), confidence);
}

Interval wilson_of(double p, double n, double confidence) {
  const double z = z_of(confidence);
  const double centre = n * p + 0.5 * z * z;
  const double half_width = z * std::sqrt(n * p * (1.0 - p) + 0.25 * z * z);
  // Exact ends where rounding would miss them: the interval holds its estimate.
  return {p == 0.0 ? 0.0 : std::min((centre - half_width) / (n + z * z), p),
          p == 1.0 ? 1.0 : std::max((centre + half_width) / (n + z * z), p)};
}

Interval newcombe(Counts older, Counts newer, double confidence) {
  if (older.n == 0 || newer.n == 0) return {-1.0, 1.0};
  return newcombe_of(older, wilson(older, confidence), newer, wilson(newer, confidence));
}

Interval newcombe_of(Counts older, Interval of_older, Counts newer, Interval of_newer) {
  const double p1 = *efficiency(older), p2 = *efficiency(newer);
  const double difference = p2 - p1;
  return {difference - std::sqrt(square(p2 - of_newer.lo) + square(of_older.hi - p1)),
          difference + std::sqrt(square(of_newer.hi - p2) + square(p1 - of_older.lo))};
}

Interval agresti_caffo(Counts older, Counts newer, double confidence) {
  if (older.n == 0 || newer.n == 0) return {-1.0, 1.0};
  const double n1 = static_cast<double>(older.n) + 2.0;
  const double n2 = static_cast<double>(newer.n) + 2.0;
  const double p1 = (static_cast<double>(older.inside) + 1.0) / n1;
  const double p2 = (static_cast<double>(newer.inside) + 1.0) / n2;
  const double half_width = z_of(confidence) * std::sqrt(p1 * (1.0 - p1) / n1 + p2 * (1.0 - p2) / n2);
  return {std::max(p2 - p1 - half_width, -1.0), std::min(p2 - p1 + half_width, 1.0)};
}

std::optional<double> relative_gain(Counts older, Counts newer) {
  if (older.inside == 0 || newer.n == 0) return std::nullopt;
  return *efficiency(newer) / *efficiency(older) - 1.0;
}

std::optional<Ratio> risk_ratio(Counts older, Counts newer, double confidence) {
  if (older.inside == 0 || newer.inside == 0) return std::nullopt;
  if (older.inside == older.n && newer.inside == newer.n) return std::nullopt;
  const auto variance = [](Counts counts) {
    return 1.0 / static_cast<double>(counts.inside) - 1.0 / static_cast<double>(counts.n);
  };
  return log_interval(*efficiency(newer) / *efficiency(older), variance(older) + variance(newer), confidence);
}

std::optional<Ratio> odds_ratio(Counts older, Counts newer, double confidence) {
  const double a = static_cast<double>(newer.inside);
  const double b = static_cast<double>(newer.n - newer.inside);
  const double c = static_cast<double>(older.inside);
  const double d = static_cast<double>(older.n - older.inside);
  if (a == 0.0 || b == 0.0 || c == 0.0 || d == 0.0) return std::nullopt;
  return log_interval((a / b) / (c / d), 1.0 / a + 1.0 / b + 1.0 / c + 1.0 / d, confidence);
}

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
