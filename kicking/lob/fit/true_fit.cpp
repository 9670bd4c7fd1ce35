#include "kicking/lob/fit/true_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "kicking/geometry/time.hpp"

namespace trivela::kicking::lob {
namespace {

/// What a flight with lift, too, would be, by one Gauss-Newton step from the fit without.
struct LiftCheck {
  double coefficient = 0.0;  ///< C_L, positive upwards of the path
  double chi_square = 0.0;   ///< (C_L / its standard error)^2, one degree of freedom
  FlightModel::Parameters shift = FlightModel::Parameters::Zero();  ///< of the other parameters
};

using Parameters = FlightModel::Parameters;
using Covariance = FlightModel::Covariance;

double cost_of(const std::vector<Eigen::Vector2d>& errors_m, double bend_m) {
  double cost = 0.0;
  for (const Eigen::Vector2d& error : errors_m) {
    const double d = error.norm();
    cost += d <= bend_m ? 0.5 * d * d : bend_m * (d - 0.5 * bend_m);
  }
  return cost;
}

struct Normal {
  Covariance curvature = Covariance::Identity();  ///< J^T W J; parameters that are not free keep a 1
  Parameters gradient = Parameters::Zero();       ///< J^T W e
};

Normal normal_at(FlightModel& model, const Parameters& p, double bend_m) {
  std::vector<Eigen::Vector2d> errors_m;
  std::vector<FlightModel::Jacobian> jacobians;
  model.errors(p, errors_m);
  model.jacobians(p, jacobians);
  Normal normal;
  const int n = model.free();
  normal.curvature.topLeftCorner(n, n).setZero();
  for (std::size_t i = 0; i < model.size(); ++i) {
    const double weight = std::min(1.0, bend_m / std::max(errors_m[i].norm(), 1e-12));
    const auto jacobian = jacobians[i].leftCols(n);
    normal.curvature.topLeftCorner(n, n) += weight * jacobian.transpose() * jacobian;
    normal.gradient.head(n) += weight * jacobian.transpose() * errors_m[i];
  }
  return normal;
}

/// Minimises sum rho(|e_i|) over the free parameters, e_i the model's errors, by Levenberg-Marquardt with the weights
/// W = min(1, bend / |e_i|). rho is Huber's: e^2 / 2 up to the bend, bend (e - bend / 2) beyond. False: it does not
/// converge.
bool descend(FlightModel& model, Parameters& p, double bend_m) {
  constexpr double kLongestStep_s = 1.0;  // in the launch's time: farther away no path is worth integrating
  constexpr double kSettled = 1e-10;
  std::vector<Eigen::Vector2d> errors_m;
  model.errors(p, errors_m);
  double cost = cost_of(errors_m, bend_m), damping = 1e-6;
  for (int i = 0; i < 40; ++i) {
    const Normal normal = normal_at(model, p, bend_m);
    for (;; damping *= 10.0) {
      if (damping > 1e9) return true;  // no way leads down any more
      Covariance damped = normal.curvature;
      damped.diagonal() *= 1.0 + damping;
      const Parameters step = damped.ldlt().solve(normal.gradient);
      if (!step.allFinite()) return false;
      if (std::abs(step[1]) > kLongestStep_s) continue;
      model.errors(p + step, errors_m);
      const double next_cost = cost_of(errors_m, bend_m);
      if (!(next_cost <= cost)) continue;
      const bool settled = step.norm() < 1e-9 || cost - next_cost < kSettled * cost;
      p += step;
      cost = next_cost;
      damping *= 0.1;
      if (settled) return true;
      break;
    }
  }
  return false;
}

/// Covariance of the parameters at the minimum, s^2 (J^T J)^-1 with Huber's variance of a centre's coordinate,
///   s^2 = [sum |psi_i|^2 / (2 n - parameters)] / (mean slope of psi)^2,  |psi_i| = min(|e_i|, bend),
/// the slope in the plane being 1 within the bend and bend / (2 |e_i|) beyond. Zero for a parameter that is not free.
Covariance covariance_of(FlightModel& model, const Parameters& p, double bend_m) {
  std::vector<Eigen::Vector2d> errors_m;
  model.errors(p, errors_m);
  double squares = 0.0, slope = 0.0;
  for (const Eigen::Vector2d& error : errors_m) {
    const double d = error.norm();
    squares += std::pow(std::min(d, bend_m), 2);
    slope += d <= bend_m ? 1.0 : bend_m / (2.0 * d);
  }
  const auto count = static_cast<double>(model.size());
  const int n = model.free();
  const double variance_m2 = squares / (2.0 * count - n) / std::pow(slope / count, 2);
  const Covariance curvature = normal_at(model, p, std::numeric_limits<double>::infinity()).curvature;
  Covariance covariance = Covariance::Zero();
  covariance.topLeftCorner(n, n) =
      variance_m2 * curvature.topLeftCorner(n, n).ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  return covariance;
}

/// With the centres weighted as in descend() and the variance that is left of them. Zero where lift cannot be told
/// from the free parameters.
LiftCheck check_lift(FlightModel& model, const Parameters& p, double bend_m) {
  std::vector<Eigen::Vector2d> errors_m;
  std::vector<FlightModel::Jacobian> jacobians;
  const std::vector<Eigen::Vector2d> by_lift = model.by_lift(p);
  model.errors(p, errors_m);
  model.jacobians(p, jacobians);
  const int n = model.free();
  const auto weight = [&](std::size_t i) { return std::min(1.0, bend_m / std::max(errors_m[i].norm(), 1e-12)); };
  Parameters cross = Parameters::Zero();
  for (std::size_t i = 0; i < model.size(); ++i)
    cross.head(n) += weight(i) * jacobians[i].leftCols(n).transpose() * by_lift[i];
  const Covariance curvature = normal_at(model, p, bend_m).curvature;
  const Parameters mixed = curvature.ldlt().solve(cross);  // of a unit of lift, what the free parameters take over
  double along = 0.0, own = 0.0, all = 0.0;
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Eigen::Vector2d rest = by_lift[i] - jacobians[i].leftCols(n) * mixed.head(n);
    along += weight(i) * rest.dot(errors_m[i]);
    own += weight(i) * rest.squaredNorm();
    all += weight(i) * by_lift[i].squaredNorm();
  }
  LiftCheck check;
  if (!(own > 1e-10 * all)) return check;
  check.coefficient = along / own;
  check.shift = -check.coefficient * mixed;
  double squares = 0.0;
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Eigen::Vector2d rest = by_lift[i] - jacobians[i].leftCols(n) * mixed.head(n);
    squares += weight(i) * (errors_m[i] - check.coefficient * rest).squaredNorm();
  }
  const double degrees = 2.0 * static_cast<double>(model.size()) - n - 1.0;
  if (degrees > 0.0 && squares > 0.0) check.chi_square = check.coefficient * along * degrees / squares;
  return check;
}

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
