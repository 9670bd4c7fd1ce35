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

}  // namespace trivela::evaluator::stats
