#include "evaluator/stats/test_plan.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "evaluator/stats/counts/interval.hpp"

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

std::optional<double> sample_ratio_p(std::span<const std::int64_t> counts, std::span<const double> planned) {
  assert(counts.size() == planned.size());
  const double total = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::int64_t{0}));
  if (counts.size() < 2 || total == 0.0) return std::nullopt;
  const double shares = std::accumulate(planned.begin(), planned.end(), 0.0);
  double statistic = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = total * planned[i] / shares;
    statistic += (static_cast<double>(counts[i]) - expected) * (static_cast<double>(counts[i]) - expected) / expected;
  }
  return chi_square_p(statistic, static_cast<double>(counts.size()) - 1.0);
}

std::vector<double> holm(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p_values[i]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    largest = std::max(largest, p_values[order[rank]] * static_cast<double>(order.size() - rank));
    adjusted[order[rank]] = std::min(largest, 1.0);
  }
  return adjusted;
}

}  // namespace trivela::evaluator::stats
