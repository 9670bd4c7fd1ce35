#include "kicking/lob/fit/robust_descent.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace trivela::kicking::lob {
namespace {

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

}  // namespace

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

}  // namespace trivela::kicking::lob
