#include "evaluator/stats/counts/exact.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

namespace trivela::evaluator::stats {
namespace {

// Values that differ by rounding only count as equal.
constexpr double kTie = 1.0 + 1e-10;

// Weights below this share of the mode's are nothing; subnormal ones would never vanish.
constexpr double kVanishing = 1e-290;

/// Distribution of the newer group's inside kicks x, with the margins fixed: C(n1, total - x) C(n2, x), up to a factor.
class Hypergeometric {
 public:
  Hypergeometric(std::int64_t n1, std::int64_t n2, std::int64_t total) {
    const double n1_d = static_cast<double>(n1);
    const double n2_d = static_cast<double>(n2);
    const double total_d = static_cast<double>(total);
    const std::int64_t lo = std::max<std::int64_t>(0, total - n1);
    const std::int64_t hi = std::min(total, n2);
    const double centre = (total_d + 1.0) * (n2_d + 1.0) / (n1_d + n2_d + 2.0);
    const std::int64_t mode = std::clamp(static_cast<std::int64_t>(centre), lo, hi);
    const auto ratio = [&](double x) { return (total_d - x) * (n2_d - x) / ((x + 1.0) * (n1_d - total_d + x + 1.0)); };
    // Outwards from the mode, whose weight is 1, until the weights vanish: nothing overflows, small tails stay exact.
    double weight = 1.0;
    for (std::int64_t x = mode; x > lo && weight > kVanishing; --x) {
      weight /= ratio(static_cast<double>(x - 1));
      weights_.push_back(weight);
    }
    first_ = mode - static_cast<std::int64_t>(weights_.size());
    std::reverse(weights_.begin(), weights_.end());
    weight = 1.0;
    for (std::int64_t x = mode; weight > kVanishing; ++x) {
      weights_.push_back(weight);
      if (x == hi) break;
      weight *= ratio(static_cast<double>(x));
    }
    for (const double w : weights_) sum_ += w;
  }

  double weight(std::int64_t x) const {
    const std::int64_t i = x - first_;
    return i < 0 || i >= std::ssize(weights_) ? 0.0 : weights_[static_cast<std::size_t>(i)];
  }

  /// P(X >= x).
  double upper_tail(std::int64_t x) const {
    double tail = 0.0;
    for (std::int64_t i = std::ssize(weights_) - 1; i >= std::max<std::int64_t>(0, x - first_); --i) {
      tail += weights_[static_cast<std::size_t>(i)];
    }
    return std::min(1.0, tail / sum_);
  }

  /// Least x with P(X >= x) <= p; one more than the largest x where there is none.
  std::int64_t least_with_tail(double p) const {
    double tail = 0.0;
    std::int64_t i = std::ssize(weights_);
    while (i > 0 && (tail + weights_[static_cast<std::size_t>(i - 1)]) / sum_ <= p) {
      tail += weights_[static_cast<std::size_t>(--i)];
    }
    return first_ + i;
  }

  /// Sum of the probabilities not above that of x.
  double as_unlikely_as(std::int64_t x) const {
    const double limit = weight(x) * kTie;
    double sum = 0.0;
    for (const double w : weights_) sum += w <= limit ? w : 0.0;
    return std::min(1.0, sum / sum_);
  }

 private:
  std::vector<double> weights_;  // of first_, first_ + 1, ...
  std::int64_t first_ = 0;
  double sum_ = 0.0;
};

/// Probabilities of 0..n successes out of n, for many proportions; those whose logarithm is below `least_log` are 0.
class Binomial {
 public:
  Binomial(std::int64_t n, double least_log)
      : log_coefficients_(static_cast<std::size_t>(n) + 1), least_log_(least_log) {
    for (std::size_t k = 1; k < log_coefficients_.size(); ++k) {
      log_coefficients_[k] = log_coefficients_[k - 1] + std::log(static_cast<double>(log_coefficients_.size() - k)) -
                             std::log(static_cast<double>(k));
    }
  }

  std::vector<double> probabilities(double p) const {
    const double log_p = std::log(p);
    const double log_q = std::log1p(-p);
    std::vector<double> result(log_coefficients_.size());
    for (std::size_t k = 0; k < result.size(); ++k) {
      const double misses = static_cast<double>(result.size() - 1 - k);
      const double log_of = log_coefficients_[k] + static_cast<double>(k) * log_p + misses * log_q;
      result[k] = log_of < least_log_ ? 0.0 : std::exp(log_of);
    }
    return result;
  }

 private:
  std::vector<double> log_coefficients_;
  double least_log_;
};

/// For each count inside of the newer group the largest count of the older one whose statistic is at most p; -1: none.
std::vector<std::int64_t> rejection_region(std::int64_t n1, std::int64_t n2, double p) {
  std::vector<std::int64_t> largest_old(static_cast<std::size_t>(n2) + 1, -1);
  for (std::int64_t total = 0; total <= n1 + n2; ++total) {
    const std::int64_t least = Hypergeometric(n1, n2, total).least_with_tail(p);
    for (std::int64_t x = std::max<std::int64_t>(0, least); x <= std::min(total, n2); ++x) {
      auto& largest = largest_old[static_cast<std::size_t>(x)];
      largest = std::max(largest, total - x);
    }
  }
  return largest_old;
}

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

double fisher_one_sided(Counts older, Counts newer) {
  return Hypergeometric(older.n, newer.n, older.inside + newer.inside).upper_tail(newer.inside);
}

double fisher_two_sided(Counts older, Counts newer) {
  return Hypergeometric(older.n, newer.n, older.inside + newer.inside).as_unlikely_as(newer.inside);
}

std::optional<double> boschloo_one_sided(Counts older, Counts newer) {
  if (older.n + newer.n > kBoschlooKicks) return std::nullopt;
  const double statistic = fisher_one_sided(older, newer) * kTie;
  if (statistic >= 1.0) return 1.0;
  const auto largest_old = rejection_region(older.n, newer.n, statistic);
  // The result is of the statistic's size: what is e^-50 of it is nothing, also a kBoschlooKicks times.
  const double least_log = std::log(statistic) - 50.0;
  const Binomial old_kicks(older.n, least_log);
  const Binomial new_kicks(newer.n, least_log);
  // Over the angle t with the common proportion sin^2 t the probability is about as smooth at the ends as inside.
  const auto negative_probability = [&](double angle) {
    const double p = std::sin(angle) * std::sin(angle);
    std::vector<double> old_cumulative = old_kicks.probabilities(p);
    for (std::size_t k = 1; k < old_cumulative.size(); ++k) old_cumulative[k] += old_cumulative[k - 1];
    const std::vector<double> new_probability = new_kicks.probabilities(p);
    double sum = 0.0;
    for (std::size_t x = 0; x < new_probability.size(); ++x) {
      if (largest_old[x] >= 0) sum += new_probability[x] * old_cumulative[static_cast<std::size_t>(largest_old[x])];
    }
    return -sum;
  };
  const auto steps = static_cast<int>(std::clamp<std::int64_t>(2 * (older.n + newer.n), 256, 2048));
  const double step = 0.5 * std::numbers::pi / steps;
  std::vector<double> values(static_cast<std::size_t>(steps) + 1, 0.0);  // 0 at both ends, where all kicks are alike
  for (int i = 1; i < steps; ++i) values[static_cast<std::size_t>(i)] = negative_probability(i * step);
  double best = *std::min_element(values.begin(), values.end());
  for (std::size_t i = 1; i + 1 < values.size(); ++i) {
    const bool peak = values[i] <= values[i - 1] && values[i] <= values[i + 1];
    if (!peak || values[i] > 0.9 * best) continue;
    const double angle = static_cast<double>(i) * step;
    const double lo = std::max(angle - step, 1e-9);
    best = std::min(best, boost::math::tools::brent_find_minima(negative_probability, lo, angle + step, 26).second);
  }
  return std::min(1.0, -best);
}

std::optional<double> boschloo_two_sided_doubled(Counts older, Counts newer) {
  const auto better = boschloo_one_sided(older, newer);
  const auto worse = boschloo_one_sided(newer, older);
  if (!better || !worse) return std::nullopt;
  return std::min(1.0, 2.0 * std::min(*better, *worse));
}

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
