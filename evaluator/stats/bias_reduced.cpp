#include "evaluator/stats/bias_reduced.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::stats {
namespace {

constexpr double kAlike = 0.1;  // intraclass correlation of the working model, usual for kicks of a match

// P = sum over sides of (diag(D) + A M A'), where the columns of A are those of its parts.
struct Side {
  Eigen::VectorXd diagonal;
  Eigen::MatrixXd columns;
  Eigen::MatrixXd middle;
  Eigen::VectorXd u;

  double trace() const { return diagonal.sum() + (middle * columns.transpose() * columns).trace(); }
};

Side side_of(std::span<const RatioPart> parts, std::span<const RatioCell> cells, bool newer,
             const std::map<std::uint32_t, Eigen::Index>& places) {
  const auto matches = static_cast<Eigen::Index>(places.size());
  const auto columns = static_cast<Eigen::Index>(2 * parts.size());
  Side side{Eigen::VectorXd::Zero(matches), Eigen::MatrixXd::Zero(matches, columns),
            Eigen::MatrixXd::Zero(columns, columns), Eigen::VectorXd::Zero(matches)};
  for (const RatioCell& cell : cells) {
    const RatioPart& part = parts[cell.part];
    const double leverage = cell.n / part.n;
    // A match that is all of a part has no residual there.
    if (part.newer != newer || cell.n == 0.0 || leverage >= 1.0) continue;
    const Eigen::Index row = places.at(cell.match), column = static_cast<Eigen::Index>(2 * cell.part);
    const double scale = part.weight / part.n / std::sqrt(1.0 - leverage);
    side.u[row] += scale * (cell.x - cell.n * part.x / part.n);
    side.diagonal[row] += square(scale) * cell.spread;
    side.columns(row, column) += scale * leverage;
    side.columns(row, column + 1) += scale * cell.spread;
    side.middle(column, column) += cell.spread;
    side.middle(column, column + 1) = side.middle(column + 1, column) = -1.0;
  }
  return side;
}

double satterthwaite(const std::array<Side, 2>& sides, const std::array<double, 2>& scales) {
  const Eigen::VectorXd d = scales[0] * sides[0].diagonal + scales[1] * sides[1].diagonal;
  // The sides have columns of their own: those of the other's parts are zero.
  const Eigen::MatrixXd a = sides[0].columns + sides[1].columns;
  const Eigen::MatrixXd m = scales[0] * sides[0].middle + scales[1] * sides[1].middle;
  const Eigen::MatrixXd inner = m * (a.transpose() * a);
  const double trace = d.sum() + inner.trace();
  const double squares =
      d.squaredNorm() + 2.0 * ((a * m).cwiseProduct(a).rowwise().sum().cwiseProduct(d)).sum() + (inner * inner).trace();
  return squares > 0.0 ? square(trace) / squares : static_cast<double>(d.size()) - 1.0;
}

}  // namespace

double spread_of_trials(double n, double p) { return n * p * (1.0 - p) * (1.0 + (n - 1.0) * kAlike); }

double spread_of_events(double mean) { return mean * (1.0 + kAlike * mean); }

BiasReduced bias_reduced(std::span<const RatioPart> parts, std::span<const RatioCell> cells) {
  std::map<std::uint32_t, Eigen::Index> places;
  for (const RatioCell& cell : cells) places.try_emplace(cell.match, static_cast<Eigen::Index>(places.size()));
  const std::array<Side, 2> sides{side_of(parts, cells, false, places), side_of(parts, cells, true, places)};
  std::array<double, 2> shown{};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const double usual = sides[i].trace();
    shown[i] = usual > 0.0 ? sides[i].u.squaredNorm() / usual : 0.0;
  }
  return {(sides[0].u + sides[1].u).squaredNorm(),
          std::max(std::min(satterthwaite(sides, {1.0, 1.0}), satterthwaite(sides, shown)), 1.0)};
}

}  // namespace trivela::evaluator::stats
