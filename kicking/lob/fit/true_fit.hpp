#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kicking/lob/analyzer_config.hpp"
#include "kicking/lob/fit/flight_model.hpp"
#include "kicking/lob/lob_record.hpp"

namespace trivela::kicking::lob {

/// A flight fitted in time.
struct FittedFlight {
  FlightModel::Parameters parameters = FlightModel::Parameters::Zero();
  FlightModel::Covariance covariance = FlightModel::Covariance::Zero();  ///< zero row and column: C_d was given
  std::int64_t t0_ns = 0;                                                ///< that t is counted from
  std::vector<double> residuals_m;  ///< distance of each centre from the flight at its time
  double residual_rms_m = 0.0;
  double drag_error = 0.0;         ///< standard error of C_d from the centres' scatter alone
  double misfit_chi_square = 0.0;  ///< see TrueFit
  double lift_coefficient = 0.0;

  double launch_x_m() const { return parameters[0]; }
  TrueFit values() const;
};

/// Least squares of the flight equation to centres p_i at their beam times t_i:
///   minimise  sum rho(|p(t_i) - p_i|),  d2p/dt2 = -k |v| v - g e_z,  k = rho_air C_d pi r^2 / (2 m),
/// rho being Huber's, bent at 2 robust standard deviations; Levenberg-Marquardt. Free are x and t of the launch, its
/// velocity, and C_d unless config.drag_coefficient gives it. The launch is where the rising ball passes `launch_z_m`,
/// and nothing else is known of it: a laser whose x was measured badly does no harm. Standard errors are those of
/// s^2 (J^T J)^-1, s^2 = [sum |psi|^2 / (2 n - parameters)] / (mean slope of psi)^2, psi = rho' the bent error.
///
/// A real ball spins and is lifted, which this equation does not have: the fit then reads lift as angle, by more than
/// the centres' scatter lets suspect. So one step further is taken with a lift C_L |v| (-v_z, v_x) (check_lift()), and
/// where it is there (chi-square above kMisfit) the covariance is widened by the square of what it would move the
/// parameters. The values stay those without lift. Side force, out of the scan plane, is not seen at all.
///
/// Where the flight tells little about drag (standard error above 0.1, or C_d outside -0.1 to 1), the nominal C_d =
/// 0.25 is taken, with se 0.
/// Returns none for fewer than 5 centres, for a path that never rises above launch_z_m, and if it does not converge.
std::optional<FittedFlight> fit_flight(std::span<const BallCentre> centres, double launch_z_m,
                                       const AnalyzerConfig& config);

}  // namespace trivela::kicking::lob
