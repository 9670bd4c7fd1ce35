#include "evaluator/stats/cluster_variance.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "evaluator/stats/counts/counts.hpp"

namespace trivela::evaluator::stats {
namespace {

template <typename Key>
double squares(const std::map<Key, double>& sums) {
  double total = 0.0;
  for (const auto& [key, sum] : sums) total += square(sum);
  return total;
}

}  // namespace

double ClusterVariance::reach(double confidence) const {
  return std::isfinite(variance) ? t_of(confidence, df) * std::sqrt(variance) : std::nan("");
}

std::optional<ClusterVariance> cluster_variance(std::span<const Influence> influences) {
  std::map<std::uint32_t, double> by_match, by_calibration;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> by_both;
  for (const Influence& influence : influences) {
    by_match[influence.match] += influence.u;
    by_calibration[influence.calibration] += influence.u;
    by_both[{influence.match, influence.calibration}] += influence.u;
  }
  if (by_match.size() < 2) return std::nullopt;
  ClusterVariance result{.matches = by_match.size(), .calibrations = by_calibration.size()};
  const double m = static_cast<double>(result.matches), k = static_cast<double>(result.calibrations);
  const double of_matches = m / (m - 1.0) * squares(by_match);
  result.variance = of_matches;
  result.df = m - 1.0;
  result.by_calibration = result.calibrations >= kFewestCalibrations;
  if (!result.by_calibration) return result;
  const double of_calibrations = k / (k - 1.0) * squares(by_calibration);
  const double crossed =
      m / (m - 1.0) * k / (k - 1.0) * (squares(by_match) + squares(by_calibration) - squares(by_both));
  result.variance = std::max({crossed, of_matches, of_calibrations});
  if (result.variance == 0.0) return result;
  const double of_both = of_matches + of_calibrations - result.variance;
  result.df = square(result.variance) / (square(of_matches) / (m - 1.0) + square(of_calibrations) / (k - 1.0) +
                                         square(of_both) / ((m - 1.0) * (k - 1.0)));
  return result;
}

std::vector<double> jackknife(std::size_t n, const std::function<double(std::size_t)>& without) {
  const auto count = static_cast<double>(n);
  std::vector<double> left_out;
  double mean = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    left_out.push_back(without(i));
    mean += left_out.back() / count;
  }
  for (double& each : left_out) each = (count - 1.0) / count * (mean - each);
  return left_out;
}

}  // namespace trivela::evaluator::stats
