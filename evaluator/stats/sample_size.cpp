#include "evaluator/stats/sample_size.hpp"

#include <cmath>

#include "evaluator/stats/quantile.hpp"
#include "evaluator/stats/square.hpp"

namespace trivela::evaluator::stats {
namespace {

// Phi^-1(power) for a power of one half at least.
double z_of_power(double power) { return z_of(2.0 * power - 1.0); }

}  // namespace

std::optional<double> kicks_per_policy(double p1, double p2, double power, double alpha) {
  if (p1 == p2) return std::nullopt;
  const double alike = std::sqrt((p1 + p2) * (1.0 - 0.5 * (p1 + p2)));
  const double apart = std::sqrt(p1 * (1.0 - p1) + p2 * (1.0 - p2));
  return square((z_of(1.0 - alpha) * alike + z_of_power(power) * apart) / (p2 - p1));
}

}  // namespace trivela::evaluator::stats
