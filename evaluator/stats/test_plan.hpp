#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trivela::evaluator::stats {

inline constexpr double kPower = 0.8;

/// Kicks of each policy with which the two-sided test of level alpha finds p1 against p2 with this power (R's
/// power.prop.test): ((z_a sqrt((p1 + p2)(1 - (p1 + p2) / 2)) + z_b sqrt(p1 q1 + p2 q2)) / (p2 - p1))^2, not rounded.
/// p1 and p2 in [0, 1]. None: p1 == p2.
std::optional<double> kicks_per_policy(double p1, double p2, double power = kPower, double alpha = 0.05);

inline constexpr double kSampleRatioAlarm = 0.001;  ///< a smaller p: the assignment did not go as planned

/// Chi-square test that counts came in the planned shares: sum((observed - expected)^2 / expected), df = groups - 1.
/// `planned`: expected counts or shares, each > 0, in any scale, as many as counts. None: fewer than two groups or
/// nothing counted.
std::optional<double> sample_ratio_p(std::span<const std::int64_t> counts, std::span<const double> planned);

/// p values adjusted by Holm's step-down method (Holm 1979), in the order given: the i-th smallest of m times m - i
/// (from 0), never below a smaller one's, at most 1.
std::vector<double> holm(std::span<const double> p_values);

}  // namespace trivela::evaluator::stats
