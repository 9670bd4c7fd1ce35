#include "kicking/calibration/tracked_trials.hpp"

#include <limits>
#include <stdexcept>

namespace trivela::kicking {

std::vector<Trial> tracked_trials(std::span<const TrackedTrial> kicks) {
  // V / up = a + b (up^2 - mean), centred.
  double n = 0.0, square = 0.0, ratio = 0.0;
  for (const TrackedTrial& kick : kicks) {
    if (!kick.lob) continue;
    n += 1.0;
    square += kick.up_mps * kick.up_mps;
    ratio += kick.lob->exit_speed_mps / kick.up_mps;
  }
  if (n < 3.0) throw std::invalid_argument("table: fewer than three kicks that both laser and camera saw");
  square /= n;
  ratio /= n;
  double spread = 0.0, moment = 0.0;
  for (const TrackedTrial& kick : kicks) {
    if (!kick.lob) continue;
    const double away = kick.up_mps * kick.up_mps - square;
    spread += away * away;
    moment += away * (kick.lob->exit_speed_mps / kick.up_mps - ratio);
  }
  const double slope = spread > 0.0 ? moment / spread : 0.0;
  std::vector<Trial> trials;
  for (const TrackedTrial& kick : kicks) {
    const double speed_mps = kick.up_mps * (ratio + slope * (kick.up_mps * kick.up_mps - square));
    const double angle_rad = kick.lob ? kick.lob->exit_angle_rad : std::numeric_limits<double>::quiet_NaN();
    trials.push_back({.power = kick.power, .exit_angle_rad = angle_rad, .exit_speed_mps = speed_mps});
  }
  return trials;
}

}  // namespace trivela::kicking
