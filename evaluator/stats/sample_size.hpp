#pragma once

#include <optional>

namespace trivela::evaluator::stats {

inline constexpr double kPower = 0.8;

/// Kicks of each policy with which the two-sided test of level alpha finds p1 against p2 with this power (R's
/// power.prop.test): ((z_a sqrt((p1 + p2)(1 - (p1 + p2) / 2)) + z_b sqrt(p1 q1 + p2 q2)) / (p2 - p1))^2, not rounded.
/// p1 and p2 in [0, 1]. None: p1 == p2.
std::optional<double> kicks_per_policy(double p1, double p2, double power = kPower, double alpha = 0.05);

}  // namespace trivela::evaluator::stats
