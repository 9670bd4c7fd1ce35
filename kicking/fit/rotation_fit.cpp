#include "kicking/fit/rotation_fit.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace trivela::kicking {
namespace {

constexpr const char* kRotation = "rotation";

void check(std::span<const RotationRow> rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].distance_m > 0.0 && rows[i].v_h_mps.value_or(1.0) > 0.0) continue;
    throw std::invalid_argument("rotation: row " + std::to_string(i + 1) + ": distance and ball speed must be above 0");
  }
}

}  // namespace

RotationFit fit_rotation(std::span<const RotationRow> rows, std::optional<RotationLever> lever) {
  check(rows);
  RotationFit fit;
  std::vector<double> omega;
  for (const RotationRow& row : rows) {
    omega.push_back(row.omega_radps);
    fit.beta_rad.push_back(std::copysign(1.0, row.omega_radps) * std::atan(row.allowed_error_m / row.distance_m));
  }
  fit.line = line_through_origin(omega, fit.beta_rad, kRotation);
  const bool with_speed = std::ranges::all_of(rows, [](const RotationRow& row) { return row.v_h_mps.has_value(); });
  if (!lever || !with_speed) return fit;
  std::vector<double> turned;  // beta without the lever
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double of_lever = std::atan(omega[i] * lever->ball_offset_m / *rows[i].v_h_mps);
    turned.push_back(fit.beta_rad[i] - of_lever - 0.5 * lever->cycle_s * omega[i]);
  }
  fit.delay = line_through_origin(omega, turned, kRotation);
  return fit;
}

}  // namespace trivela::kicking
