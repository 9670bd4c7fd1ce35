#pragma once

#include <span>
#include <vector>

namespace trivela::evaluator::stats {

/// p values adjusted by Holm's step-down method (Holm 1979), in the order given: the i-th smallest of m times m - i
/// (from 0), never below a smaller one's, at most 1.
std::vector<double> holm(std::span<const double> p_values);

}  // namespace trivela::evaluator::stats
