#pragma once

#include <optional>

#include "cli/kick/csv_rows.hpp"
#include "cli/options/number_checks.hpp"
#include "kicking/constants.hpp"
#include "kicking/model/robot_model.hpp"

namespace trivela::cli {

/// What a kick's flight depends on beside its row.
struct FlightConstants {
  double gravity_mps2 = kicking::kGravity_mps2;
  kicking::Ball ball{};
  kicking::Air air{};  ///< its drag coefficient is the row's
};

/// Adds --gravity-mps2 and --ball-radius-m.
inline void add_flight_flags(CLI::App& verb, FlightConstants& constants) {
  add_default(verb, "--gravity-mps2", constants.gravity_mps2, "Gravity", above_zero());
  add_default(verb, "--ball-radius-m", constants.ball.radius_m, "Radius of the ball", above_zero());
}

/// theta_deg, d_m, h_rel_m[, v_front_mps, k_transfer, Cd] -> v0_mps, vk_exact_mps, vk_paper_mps, feasible, descending
/// [, v0_drag_mps][, power, power_range]. k_transfer is 1 where it is not given.
RowVerb solve_verb(const FlightConstants& constants, const std::optional<kicking::EffectiveTable>& table);

/// px, py, orientation_deg, alpha_deg, tx, ty, beta_deg, omega_rad_s[, rule] -> distance_m, offset_right_m, left_m,
/// right_m, aligned.
RowVerb align_verb();

/// px, py, orientation_rad, vx, vy, omega, tau_s, r_m, vk, theta_deg, k, goal_y -> x_cross_m, z_cross_m, t_flight_s.
RowVerb predict_verb(const FlightConstants& constants);

}  // namespace trivela::cli
