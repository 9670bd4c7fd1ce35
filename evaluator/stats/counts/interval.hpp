#pragma once

#include <cstdint>
#include <optional>

namespace trivela::evaluator::stats {

/// `inside` of `n` kicks were on target, 0 <= inside <= n.
struct Counts {
  std::int64_t inside = 0;
  std::int64_t n = 0;
};

/// Closed interval.
struct Interval {
  double lo = 0.0;
  double hi = 0.0;
};

/// A ratio with its confidence interval.
struct Ratio {
  double value = 1.0;
  Interval ci;
};

/// inside / n; none: no kick.
std::optional<double> efficiency(Counts counts);

constexpr double square(double x) { return x * x; }

inline constexpr double kConfidence = 0.95;  ///< of every interval unless told otherwise

/// z = Phi^-1((1 + confidence) / 2) of the standard normal distribution.
double z_of(double confidence);

/// The same of Student's distribution with `df` > 0 degrees of freedom, which need not be whole.
double t_of(double confidence, double df);

/// 2 (1 - Phi(|z|)).
double two_sided_p(double z);

/// The same of Student's distribution.
double student_p(double t, double df);

/// P(X > statistic) of the chi-square distribution with `df` > 0 degrees of freedom.
double chi_square_p(double statistic, double df);

/// Wilson's score interval of a proportion (Wilson 1927), without continuity correction, with z = Phi^-1((1 + c) / 2):
/// (k + z^2/2 -+ z sqrt(k (n - k) / n + z^2 / 4)) / (n + z^2). No kick: [0, 1].
Interval wilson(Counts counts, double confidence = kConfidence);

/// The same of a proportion p of an effective number n > 0 of kicks.
Interval wilson_of(double p, double n, double confidence = kConfidence);

/// Newcombe's hybrid interval of the difference newer - older (Newcombe 1998, method 10), from both Wilson intervals:
/// d - sqrt((p2 - l2)^2 + (u1 - p1)^2) to d + sqrt((u2 - p2)^2 + (p1 - l1)^2). A group without kicks: [-1, 1].
Interval newcombe(Counts older, Counts newer, double confidence = kConfidence);

/// The same from other intervals of both groups, which have kicks.
Interval newcombe_of(Counts older, Interval of_older, Counts newer, Interval of_newer);

/// Agresti and Caffo's interval of the difference (2000): Wald's after one kick inside and one outside are added to
/// each group. For small groups. A group without kicks: [-1, 1].
Interval agresti_caffo(Counts older, Counts newer, double confidence = kConfidence);

/// p_new / p_old - 1; none: a group without kicks, or nothing inside in the older one.
std::optional<double> relative_gain(Counts older, Counts newer);

/// Risk ratio p_new / p_old with Katz's interval on the logarithm, variance 1/k2 - 1/n2 + 1/k1 - 1/n1 (Katz 1978).
/// None: nothing inside in one of the groups, or nothing outside in both, where the variance would be 0.
std::optional<Ratio> risk_ratio(Counts older, Counts newer, double confidence = kConfidence);

/// Sample odds ratio with Woolf's interval on the logarithm, variance the sum of 1 / cell (Woolf 1955).
/// None: one of the four cells is empty.
std::optional<Ratio> odds_ratio(Counts older, Counts newer, double confidence = kConfidence);

inline constexpr double kSmallestEffect = 0.05;  ///< smallest difference of interest, where nobody names another

/// What an interval of newer - older says against 0 and the smallest effect of interest.
enum class Verdict {
  kBetter,               ///< all of it above the smallest effect
  kBetterMaybeTooSmall,  ///< above 0, but perhaps below the smallest effect
  kEquivalent,           ///< within the smallest effect on either side, whether or not it holds 0
  kWorse,                ///< below 0, and perhaps by more than the smallest effect
  kNotEnoughData,        ///< it holds 0 and differences of interest
};

inline Verdict verdict(Interval interval, double smallest_effect = kSmallestEffect) {
  if (interval.lo > -smallest_effect && interval.hi < smallest_effect) return Verdict::kEquivalent;
  if (interval.lo > smallest_effect) return Verdict::kBetter;
  if (interval.lo > 0.0) return Verdict::kBetterMaybeTooSmall;
  if (interval.hi < 0.0) return Verdict::kWorse;
  return Verdict::kNotEnoughData;
}

/// Labels that are expected to be wrong, by the doubt of whoever gave them: sums of probabilities.
struct LabelDoubt {
  double inside = 0.0;   ///< over the kicks called inside: that they were not
  double outside = 0.0;  ///< over the kicks called outside: that they were inside

  double sum() const { return inside + outside; }
  LabelDoubt& operator+=(const LabelDoubt& other) {
    inside += other.inside;
    outside += other.outside;
    return *this;
  }
};

/// Kicks of one group with all that is not known of them.
struct DoubtfulCounts {
  Counts known;              ///< inside of the labelled ones
  std::int64_t unknown = 0;  ///< without a label
  LabelDoubt doubt{};        ///< of the labels
};

/// As many labels as may be wrong where `expected` are: the least k with P(Poisson(expected) <= k) >= 0.975. Errors
/// that come apart spread less than Poisson's (Hoeffding 1956), so that it holds for any such probabilities.
std::int64_t most_wrong(double expected);

/// Efficiency if every unknown kick was outside and as many inside labels as may be are wrong, and the reverse. No
/// kick: [0, 1].
Interval efficiency_bounds(const DoubtfulCounts& counts);

/// The same of the difference newer - older: the one at its least and the other at its most, and the reverse. A group
/// without kicks: [-1, 1].
Interval difference_bounds(const DoubtfulCounts& older, const DoubtfulCounts& newer);

}  // namespace trivela::evaluator::stats
