#include "kicking/fit/deflection_fit.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "kicking/alignment/alignment.hpp"

namespace trivela::kicking {
namespace {

constexpr const char* kDeflection = "deflection";

double reach_m(const DeflectionRow& row) { return row.distance_m + row.lever_m; }

void check(std::span<const DeflectionRow> rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const DeflectionRow& row = rows[i];
    if (row.distance_m > 0.0 && row.lever_m >= 0.0 && row.v_h_mps.value_or(1.0) > 0.0) continue;
    throw std::invalid_argument("deflection: row " + std::to_string(i + 1) +
                                ": distance and ball speed must be above 0");
  }
}

}  // namespace

DeflectionFit fit_deflection(std::span<const DeflectionRow> rows, std::optional<double> delay_s) {
  check(rows);
  DeflectionFit fit;
  std::vector<double> vx, b, carried, by_carry;
  for (const DeflectionRow& row : rows) {
    fit.alpha_rad.push_back(std::atan(row.b_m / reach_m(row)));
    vx.push_back(row.vx_mps);
    b.push_back(row.b_m);
  }
  fit.line = line_through_origin(vx, fit.alpha_rad, kDeflection);
  fit.travel = line_through_origin(vx, b, kDeflection);
  double squares = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double residual = fit.alpha_rad[i] - alpha_atan_rad(rows[i].vx_mps, reach_m(rows[i]), fit.travel.slope.value);
    fit.travel_residual_rad.push_back(residual);
    squares += residual * residual;
  }
  fit.travel_rms_rad = std::sqrt(squares / static_cast<double>(rows.size()));

  const bool with_speed = std::ranges::all_of(rows, [](const DeflectionRow& row) { return row.v_h_mps.has_value(); });
  if (!delay_s || !with_speed) return fit;
  for (const DeflectionRow& row : rows) {
    carried.push_back(row.vx_mps * row.distance_m / *row.v_h_mps);
    by_carry.push_back(row.b_m - row.vx_mps * *delay_s);
  }
  fit.lateral = line_through_origin(carried, by_carry, kDeflection);
  return fit;
}

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
