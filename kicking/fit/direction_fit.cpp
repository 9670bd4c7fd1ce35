#include "kicking/fit/direction_fit.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace trivela::kicking {

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
