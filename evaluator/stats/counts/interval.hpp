#pragma once

#include <optional>

#include "evaluator/stats/counts/counts.hpp"
#include "evaluator/stats/counts/quantile.hpp"

namespace trivela::evaluator::stats {

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

}  // namespace trivela::evaluator::stats
