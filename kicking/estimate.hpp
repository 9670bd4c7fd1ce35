#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace trivela::kicking {

/// A number with its standard error.
struct Estimate {
  double value = 0.0;
  double se = 0.0;
};

/// The value in the middle of a sample, of an even number the upper one of two. Reorders the values, of which there
/// must be one.
template <typename Value>
Value upper_median(std::span<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The median, of an even number the mean of the two in the middle. Reorders the values, of which there must be one.
inline double median(std::span<double> values) {
  const double upper = upper_median(values);
  if (values.size() % 2 == 1) return upper;
  return 0.5 * (*std::ranges::max_element(values.first(values.size() / 2)) + upper);
}

}  // namespace trivela::kicking
