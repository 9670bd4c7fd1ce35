#pragma once

#include <limits>
#include <span>
#include <vector>

#include "kicking/estimate.hpp"

namespace trivela::kicking {

/// A figure that these data do not show.
inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// Mean and standard deviation of a sample; sd kNotKnown for a single value.
struct Spread {
  double mean = 0.0;
  double sd = kNotKnown;  ///< with n - 1
};

/// Throws std::invalid_argument for an empty sample or a value that is not finite.
Spread spread_of(std::span<const double> values);

/// A fitted one-parameter model: y = slope x + residual.
struct OriginLine {
  Estimate slope;
  std::vector<double> residuals;  ///< y - slope x, in the order of the points
  double rms = 0.0;               ///< sqrt(mean(residual^2))
};

/// Least squares through the origin: slope = sum(x y) / sum(x^2), se^2 = sum(residual^2) / ((n - 1) sum(x^2)).
/// `what` names the points in errors.
/// Throws std::invalid_argument for columns of different length, fewer than two points, a value that is not finite, or
/// x all zero.
OriginLine line_through_origin(std::span<const double> x, std::span<const double> y, const char* what);

}  // namespace trivela::kicking
