#include "kicking/fit/tracked_fits.hpp"

#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>
#include <stdexcept>

#include "kicking/ballistics/crossing.hpp"

namespace trivela::kicking {
namespace {

constexpr double kNominal_mps = 0.25;

using TrackColumns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

double nominal(double v_mps) { return kNominal_mps * std::round(v_mps / kNominal_mps); }

struct TrackedFit {
  Eigen::Vector3d value;  ///< c, k forward, k backward over ground
  Eigen::Matrix3d covariance;
  Eigen::VectorXd residual_mps;
};

/// Instrumental variables with weights. A direction without kicks is left at 0.
TrackedFit fit_tracks(std::span<const TransferRow> rows, bool forward, bool backward) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  TrackColumns x(n, 3), z(n, 3);
  Eigen::VectorXd y(n), weight(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const TransferRow& row = rows[static_cast<std::size_t>(i)];
    const double v = row.vy_mps, near = nominal(v);
    // The belief of a robot at rest scatters to both sides of 0, and says the same of both constants: nothing.
    x.row(i) << row.track->up_mps, near > 0.0 ? v : 0.0, near < 0.0 ? v : 0.0;
    z.row(i) << row.track->up_mps, std::max(near, 0.0), std::min(near, 0.0);
    y(i) = row.track->along_mps;
    weight(i) = row.track->weight;
  }
  Eigen::Matrix3d normal = z.transpose() * weight.asDiagonal() * x;
  if (!forward) normal(1, 1) = 1.0;
  if (!backward) normal(2, 2) = 1.0;
  const Eigen::Matrix3d inverse = normal.inverse();
  TrackedFit result;
  result.value = inverse * (z.transpose() * (weight.asDiagonal() * y));
  result.residual_mps = y - x * result.value;
  Eigen::Matrix3d middle = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d score = weight(i) * z.row(i).transpose();
    const double leverage = x.row(i) * inverse * score;
    const double e = result.residual_mps(i) / std::max(0.1, 1.0 - leverage);
    middle += e * e * score * score.transpose();
  }
  result.covariance = inverse * middle * inverse.transpose();
  return result;
}

/// The paper's k where the exact law with k is right: slope of V0(d, z) - V0 over v cos(theta).
double paper_of_exact(std::span<const TransferRow> rows, const std::vector<std::size_t>& chosen, double k,
                      double delay_s, double gravity_mps2) {
  std::vector<double> along, slower;
  for (const std::size_t i : chosen) {
    const TransferRow& row = rows[i];
    const double cosine = std::cos(row.exit_angle_rad);
    const double height_m = height_at(row.distance_m - row.vy_mps * delay_s, row.v0_mps * cosine + k * row.vy_mps,
                                      row.v0_mps * std::sin(row.exit_angle_rad), gravity_mps2);
    const auto needed_mps = crossing_speed({row.distance_m, height_m}, row.exit_angle_rad, gravity_mps2);
    if (!needed_mps) continue;
    along.push_back(row.vy_mps * cosine);
    slower.push_back(*needed_mps - row.v0_mps);
  }
  return line_through_origin(along, slower, "transfer").slope.value;
}

}  // namespace

TransferFit fit_tracked_transfer(std::span<const TransferRow> rows, double delay_s, double gravity_mps2) {
  std::vector<std::size_t> resting, forward, backward;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double v = nominal(rows[i].vy_mps);
    (v == 0.0 ? resting : v > 0.0 ? forward : backward).push_back(i);
  }
  if (resting.size() < 2)
    throw std::invalid_argument(
        "transfer: need at least 2 kicks at rest, which those of a moving robot are held against");
  if (forward.size() < 2 && backward.size() < 2)
    throw std::invalid_argument("transfer: need at least 2 kicks forward or 2 kicks backward, faster than 0.125 m/s");
  const TrackedFit found = fit_tracks(rows, forward.size() > 0, backward.size() > 0);

  std::vector<double> believed_mps, up_mps;
  for (const std::size_t i : resting) {
    believed_mps.push_back(rows[i].v0_mps * std::cos(rows[i].exit_angle_rad));
    up_mps.push_back(rows[i].track->up_mps);
  }
  const Spread believed = spread_of(believed_mps), up = spread_of(up_mps);
  const double ratio = believed.mean / (found.value(0) * up.mean);
  const double ratio_se = up.sd / up.mean / std::sqrt(static_cast<double>(resting.size()));

  TransferFit result;
  result.standing_ratio = Estimate{ratio, ratio * ratio_se};
  const auto direction = [&](const std::vector<std::size_t>& chosen, int column) -> std::optional<TransferDirection> {
    if (chosen.size() < 2) return std::nullopt;
    TransferDirection one;
    one.kicks = static_cast<int>(chosen.size());
    one.rows = chosen;
    const double k = ratio * found.value(column);
    one.exact = {k, std::hypot(ratio * std::sqrt(found.covariance(column, column)), k * ratio_se)};
    double squares = 0.0;
    for (const std::size_t i : chosen) {
      one.residual.push_back(found.residual_mps(static_cast<Eigen::Index>(i)));
      squares += one.residual.back() * one.residual.back();
    }
    one.rms = std::sqrt(squares / static_cast<double>(chosen.size()));
    const double paper = paper_of_exact(rows, chosen, k, delay_s, gravity_mps2);
    one.paper = {paper, std::abs(paper_of_exact(rows, chosen, k + one.exact.se, delay_s, gravity_mps2) - paper)};
    return one;
  };
  result.forward = direction(forward, 1);
  result.backward = direction(backward, 2);
  return result;
}

TrackedTrials tracked_trials(std::span<const TrackedTrial> kicks) {
  std::vector<const TrackedTrial*> both;
  for (const TrackedTrial& kick : kicks) {
    if (kick.lob) both.push_back(&kick);
  }
  if (both.size() < 4) throw std::invalid_argument("table: fewer than four kicks that both laser and camera saw");
  const auto n = static_cast<Eigen::Index>(both.size());
  Eigen::MatrixXd speed(n, 3), angle(n, 2);
  Eigen::VectorXd ratios(n), angles_rad(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const TrackedTrial& kick = *both[static_cast<std::size_t>(i)];
    const double square = kick.sideways_rad * kick.sideways_rad;
    speed.row(i) << 1.0, kick.up_mps * kick.up_mps, square;
    angle.row(i) << 1.0, square;
    ratios(i) = kick.lob->exit_speed_mps / kick.up_mps;
    angles_rad(i) = kick.lob->exit_angle_rad;
  }
  const Eigen::VectorXd of_speed = speed.completeOrthogonalDecomposition().solve(ratios);
  const auto decomposed = angle.completeOrthogonalDecomposition();
  const Eigen::VectorXd of_angle = decomposed.solve(angles_rad);
  const double variance = (angles_rad - angle * of_angle).squaredNorm() / static_cast<double>(n - decomposed.rank());
  const Eigen::MatrixXd inverse = decomposed.pseudoInverse();

  TrackedTrials result;
  result.exit_angle_rad = {of_angle(0), std::sqrt(variance) * inverse.row(0).norm()};
  for (const TrackedTrial& kick : kicks) {
    const double square = kick.sideways_rad * kick.sideways_rad;
    result.trials.push_back({.power = kick.power,
                             .exit_angle_rad = kick.lob ? kick.lob->exit_angle_rad - of_angle(1) * square : kNotKnown,
                             .exit_speed_mps = kick.up_mps * (of_speed(0) + of_speed(1) * kick.up_mps * kick.up_mps)});
  }
  return result;
}

}  // namespace trivela::kicking
