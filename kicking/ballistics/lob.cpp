#include "kicking/ballistics/lob.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace trivela::kicking {
namespace {

void check_lob(double apex_m, double range_m) {
  if (apex_m > 0.0 && range_m > 0.0) return;
  throw std::invalid_argument("lob: apex_m = " + std::to_string(apex_m) + " and range_m = " + std::to_string(range_m) +
                              " must be positive");
}

}  // namespace

LobExit exit_from_lob(double apex_m, double range_m, double gravity_mps2) {
  check_lob(apex_m, range_m);
  const double angle = std::atan(4.0 * apex_m / range_m);
  const double speed = std::sqrt(range_m * gravity_mps2 / std::sin(2.0 * angle));
  return {angle, speed, 2.0 * speed * std::sin(angle) / gravity_mps2};
}

LobExit exit_from_components(double apex_m, double range_m, double gravity_mps2) {
  check_lob(apex_m, range_m);
  const double v_z = std::sqrt(2.0 * gravity_mps2 * apex_m);
  const double t_flight = 2.0 * v_z / gravity_mps2;
  const double v_x = range_m / t_flight;
  return {std::atan2(v_z, v_x), std::hypot(v_x, v_z), t_flight};
}

}  // namespace trivela::kicking
