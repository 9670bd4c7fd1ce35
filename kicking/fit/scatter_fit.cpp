#include "kicking/fit/scatter_fit.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace trivela::kicking {
namespace {

constexpr double kScaleOfMad = 1.4826;  // of a normal distribution
constexpr double kOutlierScales = 3.5;

}  // namespace

DelayFit fit_delay(std::span<const double> delays_s, double least_scale_s) {
  if (delays_s.size() < 2) {
    throw std::invalid_argument("delay: " + std::to_string(delays_s.size()) +
                                (delays_s.size() == 1 ? " reading, need at least 2" : " readings, need at least 2"));
  }
  for (std::size_t i = 0; i < delays_s.size(); ++i) {
    if (!std::isfinite(delays_s[i])) {
      throw std::invalid_argument("delay: reading " + std::to_string(i + 1) + " is not finite");
    }
  }
  DelayFit fit;
  std::vector<double> sample(delays_s.begin(), delays_s.end());
  fit.median_s = median(sample);
  std::vector<double> deviations;
  for (const double delay : delays_s) deviations.push_back(std::abs(delay - fit.median_s));
  sample = deviations;
  fit.mad_s = median(sample);
  const double limit_s = kOutlierScales * std::max(kScaleOfMad * fit.mad_s, least_scale_s);
  std::vector<double> kept;
  for (std::size_t i = 0; i < delays_s.size(); ++i) {
    if (deviations[i] > limit_s) {
      fit.rejected.push_back(i);
    } else {
      kept.push_back(delays_s[i]);
    }
  }
  if (kept.size() < 2) throw std::invalid_argument("delay: no two readings agree");
  const Spread spread = spread_of(kept);
  fit.sd_s = spread.sd;
  fit.mean_s = {spread.mean, spread.sd / std::sqrt(static_cast<double>(kept.size()))};
  for (const double delay : delays_s) fit.residual_s.push_back(delay - spread.mean);
  return fit;
}

DirectionFit fit_direction(std::span<const LaunchDirection> kicks) {
  if (kicks.size() < 2) {
    throw std::invalid_argument("direction: " + std::to_string(kicks.size()) +
                                (kicks.size() == 1 ? " kick, need at least 2" : " kicks, need at least 2"));
  }
  const auto n = static_cast<double>(kicks.size());
  std::vector<double> directions;
  double observer_square = 0.0;
  for (std::size_t i = 0; i < kicks.size(); ++i) {
    if (!std::isfinite(kicks[i].value + kicks[i].se)) {
      throw std::invalid_argument("direction: kick " + std::to_string(i + 1) + " is not finite");
    }
    directions.push_back(kicks[i].value);
    observer_square += kicks[i].se * kicks[i].se / n;
  }
  const Spread seen = spread_of(directions);
  DirectionFit fit{.mean_rad = seen.mean, .seen_sd_rad = seen.sd, .observer_sd_rad = std::sqrt(observer_square)};
  const double square = seen.sd * seen.sd - observer_square;
  if (!(square > 0.0)) return fit;
  fit.sd_rad = {std::sqrt(square), seen.sd * seen.sd / std::sqrt(2.0 * (n - 1.0) * square)};
  return fit;
}

}  // namespace trivela::kicking
