#include "kicking/lob/true_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "kicking/lob/drag_path.hpp"

namespace trivela::kicking::lob {
namespace {

using Parameters = FittedFlight::Parameters;
using Covariance = FittedFlight::Covariance;
using Jacobian = Eigen::Matrix<double, 2, 5>;

constexpr double kHuber = 2.0;  // standard deviations of a coordinate; 13 % of all distances are longer
constexpr double kNominalDrag = Air{}.drag_coefficient;
constexpr double kLargestDragError = 0.1;

/// The flight at the centres' instants, and how it changes with the parameters.
class Model {
 public:
  Model(std::span<const BallCentre> centres, double launch_z_m, const AnalyzerConfig& config, int free)
      : centres_(centres),
        launch_z_m_(launch_z_m),
        free_(free),
        k_per_cd_(drag_per_m(config.ball, {.density_kgpm3 = config.air_density_kgpm3, .drag_coefficient = 1.0})) {}

  double t_s(std::size_t i) const { return static_cast<double>(centres_[i].t_ns - centres_[0].t_ns) * 1e-9; }

  std::size_t size() const { return centres_.size(); }
  int free() const { return free_; }

  /// States (x, z, v_x, v_z) at the centres' instants.
  void fly(const Parameters& p, std::vector<Eigen::Vector4d>& states) {
    times_s_.clear();
    for (std::size_t i = 0; i < size(); ++i) times_s_.push_back(t_s(i) - p[1]);
    fly_at_times({p[0], launch_z_m_, p[2], p[3]}, k_per_cd_ * p[4], times_s_, states);
  }

  Eigen::Vector2d error(std::size_t i, const Eigen::Vector4d& state) const {
    return {centres_[i].x_m - state[0], centres_[i].z_m - state[1]};
  }

  void errors(const Parameters& p, std::vector<double>& distances_m) {
    fly(p, states_);
    distances_m.clear();
    for (std::size_t i = 0; i < size(); ++i) distances_m.push_back(error(i, states_[i]).norm());
  }

  /// d(x, z)/d(parameters) at each instant: 1 by x, minus the velocity by t, differences by the others.
  void differentiate(const Parameters& p, std::vector<Jacobian>& jacobians) {
    constexpr double kDifference = 1e-5;
    fly(p, states_);
    jacobians.assign(size(), Jacobian::Zero());
    for (std::size_t i = 0; i < size(); ++i) {
      jacobians[i].col(0) << 1.0, 0.0;
      jacobians[i].col(1) = -states_[i].tail<2>();
    }
    for (int column = 2; column < free_; ++column) {
      Parameters moved = p;
      moved[column] += kDifference;
      fly(moved, moved_states_);
      for (std::size_t i = 0; i < size(); ++i)
        jacobians[i].col(column) = (moved_states_[i] - states_[i]).head<2>() / kDifference;
    }
  }

  const std::vector<Eigen::Vector4d>& states() const { return states_; }

 private:
  std::span<const BallCentre> centres_;
  double launch_z_m_;
  int free_;  ///< 5, or 4 if C_d is given
  double k_per_cd_;
  std::vector<double> times_s_;
  std::vector<Eigen::Vector4d> states_, moved_states_;
};

double huber_cost(const std::vector<double>& distances_m, double bend_m) {
  double cost = 0.0;
  for (const double d : distances_m) cost += d <= bend_m ? 0.5 * d * d : bend_m * (d - 0.5 * bend_m);
  return cost;
}

struct Normal {
  Covariance curvature = Covariance::Identity();  ///< J^T W J; parameters that are not free keep a 1
  Parameters gradient = Parameters::Zero();
};

Normal normal_at(Model& model, const Parameters& p, double bend_m) {
  std::vector<Jacobian> jacobians;
  model.differentiate(p, jacobians);
  Normal normal;
  const int n = model.free();
  normal.curvature.topLeftCorner(n, n).setZero();
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Eigen::Vector2d error = model.error(i, model.states()[i]);
    const double weight = std::min(1.0, bend_m / std::max(error.norm(), 1e-12));
    const auto jacobian = jacobians[i].leftCols(n);
    normal.curvature.topLeftCorner(n, n) += weight * jacobian.transpose() * jacobian;
    normal.gradient.head(n) += weight * jacobian.transpose() * error;
  }
  return normal;
}

/// Levenberg-Marquardt from p. False: it does not converge.
bool descend(Model& model, Parameters& p, double bend_m) {
  std::vector<double> distances_m;
  model.errors(p, distances_m);
  double cost = huber_cost(distances_m, bend_m), damping = 1e-6;
  for (int i = 0; i < 40; ++i) {
    const Normal normal = normal_at(model, p, bend_m);
    for (;; damping *= 10.0) {
      if (damping > 1e9) return true;  // no way leads down any more
      Covariance damped = normal.curvature;
      damped.diagonal() *= 1.0 + damping;
      const Parameters step = damped.ldlt().solve(normal.gradient);
      const Parameters next = p + step;
      if (!next.allFinite()) return false;
      model.errors(next, distances_m);
      const double next_cost = huber_cost(distances_m, bend_m);
      if (!(next_cost <= cost)) continue;
      const bool settled = step.norm() < 1e-9 || cost - next_cost < 1e-10 * cost;
      p = next;
      cost = next_cost;
      damping *= 0.1;
      if (settled) return true;
      break;
    }
  }
  return false;
}

/// Without drag the flight is linear in its unknowns: x = x_1 + v_x t, z + g t^2 / 2 = z_1 + v_z t.
std::optional<Parameters> first_guess(const Model& model, std::span<const BallCentre> centres, double launch_z_m) {
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

/// 1.4826 median |error| of the components, held between half a millimetre and three centimetres.
double robust_sd_m(Model& model, const Parameters& p) {
  std::vector<Eigen::Vector4d> states;
  model.fly(p, states);
  std::vector<double> sizes_m;
  for (std::size_t i = 0; i < model.size(); ++i) {
    for (const double component : model.error(i, states[i])) sizes_m.push_back(std::abs(component));
  }
  const auto middle = sizes_m.begin() + static_cast<std::ptrdiff_t>(sizes_m.size() / 2);
  std::nth_element(sizes_m.begin(), middle, sizes_m.end());
  return std::clamp(1.4826 * *middle, 0.0005, 0.03);
}

/// Huber's: of a centre's coordinate, from the bent errors psi (|psi| = min(d, bend)) and the mean slope of psi, which
/// in the plane is 1 within the bend and bend / (2 d) beyond.
double variance_m2(const std::vector<double>& distances_m, double bend_m, int parameters) {
  double squares = 0.0, slope = 0.0;
  for (const double d : distances_m) {
    squares += std::pow(std::min(d, bend_m), 2);
    slope += d <= bend_m ? 1.0 : bend_m / (2.0 * d);
  }
  const auto n = static_cast<double>(distances_m.size());
  return squares / (2.0 * n - parameters) / std::pow(slope / n, 2);
}

std::optional<FittedFlight> fit(std::span<const BallCentre> centres, double launch_z_m, const AnalyzerConfig& config,
                                const std::optional<double>& drag_coefficient) {
  constexpr double kExpectedSd_m = 0.01;
  Model model(centres, launch_z_m, config, drag_coefficient ? 4 : 5);
  auto p = first_guess(model, centres, launch_z_m);
  if (!p) return std::nullopt;
  if (drag_coefficient) (*p)[4] = *drag_coefficient;
  if (!descend(model, *p, kHuber * kExpectedSd_m)) return std::nullopt;
  const double bend_m = kHuber * robust_sd_m(model, *p);
  if (!descend(model, *p, bend_m) || (*p)[3] <= 0.0) return std::nullopt;

  FittedFlight flight;
  flight.parameters = *p;
  flight.t0_ns = centres[0].t_ns;
  model.errors(*p, flight.residuals_m);
  const int n = model.free();
  const Normal unweighted = normal_at(model, *p, std::numeric_limits<double>::infinity());
  flight.covariance.topLeftCorner(n, n) =
      variance_m2(flight.residuals_m, bend_m, n) *
      unweighted.curvature.topLeftCorner(n, n).ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  double squares = 0.0;
  for (const double d : flight.residuals_m) squares += d * d;
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
          .launch_t_ns = t0_ns + std::llround(parameters[1] * 1e9),
          .residual_rms_m = residual_rms_m};
}

std::optional<FittedFlight> fit_flight(std::span<const BallCentre> centres, double launch_z_m,
                                       const AnalyzerConfig& config) {
  if (centres.size() < 5) return std::nullopt;
  if (config.drag_coefficient) return fit(centres, launch_z_m, config, config.drag_coefficient);
  auto free = fit(centres, launch_z_m, config, std::nullopt);
  const bool drag_seen = free && std::sqrt(free->covariance(4, 4)) <= kLargestDragError &&
                         free->parameters[4] >= -0.1 && free->parameters[4] <= 1.0;
  if (drag_seen) return free;
  return fit(centres, launch_z_m, config, kNominalDrag);
}

}  // namespace trivela::kicking::lob
