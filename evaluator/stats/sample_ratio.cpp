#include "evaluator/stats/sample_ratio.hpp"

#include <cassert>
#include <numeric>

#include "evaluator/stats/quantile.hpp"

namespace trivela::evaluator::stats {

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

}  // namespace trivela::evaluator::stats
