#include "kicking/lob/fit/true_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "kicking/geometry/time.hpp"
#include "kicking/lob/fit/robust_descent.hpp"

namespace trivela::kicking::lob {
namespace {

using Parameters = FlightModel::Parameters;

constexpr double kHuber = 2.0;  // standard deviations of a coordinate; 13 % of all distances are longer
constexpr double kNominalDrag = Air{}.drag_coefficient;
constexpr double kLargestDragError = 0.1;  // of the centres' scatter alone

/// Without drag the flight is linear in its unknowns: x = x_1 + v_x t, z + g t^2 / 2 = z_1 + v_z t.
std::optional<Parameters> first_guess(const FlightModel& model, std::span<const BallCentre> centres,
                                      double launch_z_m) {
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero(), sums = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const double t = model.t_s(i);
    const Eigen::Vector2d row(1.0, t);
    moments += row * row.transpose();
    sums += row * Eigen::RowVector2d(centres[i].x_m, centres[i].z_m + 0.5 * kGravity_mps2 * t * t);
  }
  const Eigen::Matrix2d solution = moments.ldlt().solve(sums);
  const double v_x = solution(1, 0), v_z = solution(1, 1);
  const double launch_v_z2 = v_z * v_z + 2.0 * kGravity_mps2 * (solution(0, 1) - launch_z_m);
  if (!(launch_v_z2 > 0.0)) return std::nullopt;
  const double launch_v_z = std::sqrt(launch_v_z2), t = (v_z - launch_v_z) / kGravity_mps2;
  return Parameters(solution(0, 0) + v_x * t, t, v_x, launch_v_z, kNominalDrag);
}

/// 1.4826 median |error| of the coordinates, held between half a millimetre and three centimetres.
double robust_sd_m(const std::vector<Eigen::Vector2d>& errors_m) {
  std::vector<double> sizes_m;
  for (const Eigen::Vector2d& error : errors_m) {
    for (const double coordinate : error) sizes_m.push_back(std::abs(coordinate));
  }
  return std::clamp(1.4826 * upper_median(std::span(sizes_m)), 0.0005, 0.03);
}

std::optional<FittedFlight> fit(std::span<const BallCentre> centres, double launch_z_m, const AnalyzerConfig& config,
                                const std::optional<double>& drag_coefficient) {
  constexpr double kExpectedSd_m = 0.01;
  FlightModel model(centres, launch_z_m, config, drag_coefficient ? 4 : 5);
  auto p = first_guess(model, centres, launch_z_m);
  if (!p) return std::nullopt;
  if (drag_coefficient) (*p)[4] = *drag_coefficient;
  if (!descend(model, *p, kHuber * kExpectedSd_m)) return std::nullopt;
  std::vector<Eigen::Vector2d> errors_m;
  model.errors(*p, errors_m);
  const double bend_m = kHuber * robust_sd_m(errors_m);
  if (!descend(model, *p, bend_m) || (*p)[3] <= 0.0) return std::nullopt;

  FittedFlight flight;
  flight.parameters = *p;
  flight.covariance = covariance_of(model, *p, bend_m);
  flight.drag_error = std::sqrt(flight.covariance(4, 4));
  const LiftCheck lift = check_lift(model, *p, bend_m);
  flight.lift_coefficient = lift.coefficient;
  flight.misfit_chi_square = lift.chi_square;
  if (lift.chi_square > kMisfit) flight.covariance += lift.shift * lift.shift.transpose();
  flight.t0_ns = centres[0].t_ns;
  model.errors(*p, errors_m);
  double squares = 0.0;
  for (const Eigen::Vector2d& error : errors_m) {
    squares += error.squaredNorm();
    flight.residuals_m.push_back(error.norm());
  }
  flight.residual_rms_m = std::sqrt(squares / static_cast<double>(model.size()));
  return flight;
}

}  // namespace

TrueFit FittedFlight::values() const {
  const double v_x = parameters[2], v_z = parameters[3], speed = std::hypot(v_x, v_z);
  const Eigen::Vector2d by_angle(-v_z / (speed * speed), v_x / (speed * speed)), by_speed(v_x / speed, v_z / speed);
  const Eigen::Matrix2d of_velocity = covariance.block<2, 2>(2, 2);
  const auto se = [&](const Eigen::Vector2d& by) { return std::sqrt(std::max(0.0, by.dot(of_velocity * by))); };
  return {.exit_angle_rad = {std::atan2(v_z, std::abs(v_x)), se(by_angle)},
          .exit_speed_mps = {speed, se(by_speed)},
          .drag_coefficient = {parameters[4], std::sqrt(std::max(0.0, covariance(4, 4)))},
          .launch_t_ns = t0_ns + nanoseconds(parameters[1]),
          .residual_rms_m = residual_rms_m,
          .misfit_chi_square = misfit_chi_square,
          .lift_coefficient = lift_coefficient};
}

std::optional<FittedFlight> fit_flight(std::span<const BallCentre> centres, double launch_z_m,
                                       const AnalyzerConfig& config) {
  if (centres.size() < 5) return std::nullopt;
  if (config.drag_coefficient) return fit(centres, launch_z_m, config, config.drag_coefficient);
  auto free = fit(centres, launch_z_m, config, std::nullopt);
  const bool drag_seen =
      free && free->drag_error <= kLargestDragError && free->parameters[4] >= -0.1 && free->parameters[4] <= 1.0;
  if (drag_seen) return free;
  return fit(centres, launch_z_m, config, kNominalDrag);
}

}  // namespace trivela::kicking::lob
