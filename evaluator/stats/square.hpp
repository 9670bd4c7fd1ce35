#pragma once

namespace trivela::evaluator::stats {

constexpr double square(double x) { return x * x; }

}  // namespace trivela::evaluator::stats
