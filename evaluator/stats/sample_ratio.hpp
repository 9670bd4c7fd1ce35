#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace trivela::evaluator::stats {

inline constexpr double kSampleRatioAlarm = 0.001;  ///< a smaller p: the assignment did not go as planned

/// Chi-square test that counts came in the planned shares: sum((observed - expected)^2 / expected), df = groups - 1.
/// `planned`: expected counts or shares, each > 0, in any scale, as many as counts. None: fewer than two groups or
/// nothing counted.
std::optional<double> sample_ratio_p(std::span<const std::int64_t> counts, std::span<const double> planned);

}  // namespace trivela::evaluator::stats
