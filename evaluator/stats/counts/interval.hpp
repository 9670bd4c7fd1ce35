#pragma once

#include <optional>

#include "evaluator/stats/counts/counts.hpp"

namespace trivela::evaluator::stats {

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

}  // namespace trivela::evaluator::stats
