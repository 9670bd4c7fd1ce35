#include "kicking/fit/delay_fit.hpp"

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

}  // namespace trivela::kicking
