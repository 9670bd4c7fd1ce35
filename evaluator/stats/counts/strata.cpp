#include "evaluator/stats/counts/strata.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::evaluator::stats {
namespace {

struct Cells {
  double a, b, c, d;

  explicit Cells(const Stratum& s)
      : a(static_cast<double>(s.newer.inside)),
        b(static_cast<double>(s.newer.n - s.newer.inside)),
        c(static_cast<double>(s.older.inside)),
        d(static_cast<double>(s.older.n - s.older.inside)) {}

  double newer() const { return a + b; }
  double older() const { return c + d; }
  double total() const { return a + b + c + d; }
};

bool has_both(const Stratum& s) { return s.older.n > 0 && s.newer.n > 0; }

}  // namespace

std::optional<Ratio> mantel_haenszel_odds_ratio(std::span<const Stratum> strata, double confidence) {
  double r = 0.0, s = 0.0, pr = 0.0, ps_qr = 0.0, qs = 0.0;
  for (const Stratum& stratum : strata) {
    const Cells k(stratum);
    const double n = k.total();
    if (n == 0.0) continue;
    r += k.a * k.d / n;
    s += k.b * k.c / n;
    pr += (k.a + k.d) / n * k.a * k.d / n;
    ps_qr += (k.a + k.d) / n * k.b * k.c / n + (k.b + k.c) / n * k.a * k.d / n;
    qs += (k.b + k.c) / n * k.b * k.c / n;
  }
  if (r == 0.0 || s == 0.0) return std::nullopt;
  const double variance = pr / (2.0 * r * r) + ps_qr / (2.0 * r * s) + qs / (2.0 * s * s);
  const double half_width = z_of(confidence) * std::sqrt(variance);
  return Ratio{r / s, {r / s * std::exp(-half_width), r / s * std::exp(half_width)}};
}

std::optional<ChiSquare> cochran_mantel_haenszel(std::span<const Stratum> strata, bool corrected) {
  double excess = 0.0, variance = 0.0;
  for (const Stratum& stratum : strata) {
    const Cells k(stratum);
    const double n = k.total();
    if (n < 2.0) continue;
    excess += k.a - k.newer() * (k.a + k.c) / n;
    variance += k.newer() * k.older() * (k.a + k.c) * (k.b + k.d) / (n * n * (n - 1.0));
  }
  if (variance <= 0.0) return std::nullopt;
  const double correction = corrected && std::abs(excess) >= 0.5 ? 0.5 : 0.0;
  const double statistic = square(std::abs(excess) - correction) / variance;
  return ChiSquare{statistic, 1.0, chi_square_p(statistic, 1.0)};
}

std::optional<Difference> mantel_haenszel_risk_difference(std::span<const Stratum> strata, double confidence) {
  double weighted = 0.0, weights = 0.0, p_sum = 0.0, q_sum = 0.0;
  for (const Stratum& stratum : strata) {
    if (!has_both(stratum)) continue;
    const Cells k(stratum);
    const double n2 = k.newer(), n1 = k.older(), n = k.total();
    weighted += (k.a * n1 - k.c * n2) / n;
    weights += n1 * n2 / n;
    p_sum += (n2 * n2 * k.c - n1 * n1 * k.a + n2 * n1 * (n1 - n2) / 2.0) / (n * n);
    q_sum += (k.a * k.d + k.c * k.b) / (2.0 * n);
  }
  if (weights == 0.0) return std::nullopt;
  const double value = weighted / weights;
  const double half_width = z_of(confidence) * std::sqrt(std::max(value * p_sum + q_sum, 0.0)) / weights;
  if (half_width == 0.0) return Difference{value, standardised(strata, confidence)->difference.ci};
  return Difference{value, {value - half_width, value + half_width}};
}

std::optional<Standardised> standardised(std::span<const Stratum> strata, double confidence) {
  double total = 0.0;
  for (const Stratum& s : strata) total += has_both(s) ? Cells(s).total() : 0.0;
  if (total == 0.0) return std::nullopt;
  Standardised result;
  double below = 0.0, above = 0.0;
  for (const Stratum& s : strata) {
    if (!has_both(s)) continue;
    const double weight = Cells(s).total() / total;
    const double p1 = *efficiency(s.older), p2 = *efficiency(s.newer);
    const Interval w1 = wilson(s.older, confidence), w2 = wilson(s.newer, confidence);
    result.older += weight * p1;
    result.newer += weight * p2;
    below += square(weight) * (square(p2 - w2.lo) + square(w1.hi - p1));
    above += square(weight) * (square(w2.hi - p2) + square(p1 - w1.lo));
  }
  const double difference = result.newer - result.older;
  result.difference = {difference, {difference - std::sqrt(below), difference + std::sqrt(above)}};
  return result;
}

std::optional<ChiSquare> breslow_day(std::span<const Stratum> strata) {
  const auto common = mantel_haenszel_odds_ratio(strata);
  if (!common) return std::nullopt;
  const double odds_ratio = common->value;
  double statistic = 0.0;
  int tables = 0;
  for (const Stratum& stratum : strata) {
    const Cells k(stratum);
    const double inside = k.a + k.c;
    if (!has_both(stratum) || inside == 0.0 || k.b + k.d == 0.0) continue;
    // x inside of the newer one, where x (n1 - inside + x) / ((n2 - x)(inside - x)) is the common odds ratio.
    const double quadratic = 1.0 - odds_ratio;
    const double linear = k.older() - inside + odds_ratio * (k.newer() + inside);
    const double constant = -odds_ratio * k.newer() * inside;
    const double root = std::sqrt(std::max(linear * linear - 4.0 * quadratic * constant, 0.0));
    const double x = -2.0 * constant / (linear + root);  // the root within the table, also where quadratic is 0
    const double variance =
        1.0 / (1.0 / x + 1.0 / (k.newer() - x) + 1.0 / (inside - x) + 1.0 / (k.older() - inside + x));
    statistic += square(k.a - x) / variance;
    ++tables;
  }
  if (tables < 2) return std::nullopt;
  return ChiSquare{statistic, tables - 1.0, chi_square_p(statistic, tables - 1.0)};
}

}  // namespace trivela::evaluator::stats
