#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator {

/// Repeatable numbers: the engine's are fixed by the standard, and no library's distribution is asked.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  bool happens(double p) { return uniform() < p; }
  double normal() { return std::sqrt(-2.0 * std::log(1.0 - uniform())) * std::cos(6.283185307179586 * uniform()); }

  stats::Counts kicks(std::int64_t n, double p) {
    std::int64_t inside = 0;
    for (std::int64_t i = 0; i < n; ++i) inside += happens(p) ? 1 : 0;
    return {inside, n};
  }

  /// Knuth's product of uniforms; for small means.
  std::int64_t poisson(double mean) {
    std::int64_t events = -1;
    for (double product = 1.0; product > std::exp(-mean); product *= 1.0 - uniform()) ++events;
    return events;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace trivela::evaluator
