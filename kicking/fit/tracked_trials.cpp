#include "kicking/fit/tracked_trials.hpp"

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trivela::kicking {

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
