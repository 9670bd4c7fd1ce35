#include "kicking/ballistics/lob.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace trivela::kicking {

LobExit exit_from_lob(double apex_m, double range_m, double gravity_mps2) {
  if (!(apex_m > 0.0 && range_m > 0.0)) {
    throw std::invalid_argument("lob: apex_m = " + std::to_string(apex_m) +
                                " and range_m = " + std::to_string(range_m) + " must be positive");
  }
  const double angle = std::atan(4.0 * apex_m / range_m);
  const double speed = std::sqrt(range_m * gravity_mps2 / std::sin(2.0 * angle));
  return {angle, speed, 2.0 * speed * std::sin(angle) / gravity_mps2};
}

}  // namespace trivela::kicking
