#include "evaluator/stats/logistic_ridge.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "kicking/outcome/outcome.hpp"

namespace trivela::evaluator::stats {
namespace {

constexpr int kSteps = 50;
constexpr double kConverged = 1e-10;  // largest change of a coefficient

double logit_of_share(const Eigen::VectorXd& y) {
  const double k = y.sum() + 0.5, n = static_cast<double>(y.size()) + 1.0;
  return std::log(k / (n - k));
}

/// -ln likelihood + ridge / 2 |weights|^2 of coefficients whose first is the intercept, and its minimum.
struct PenalisedLoss {
  Eigen::MatrixXd design;
  const Eigen::VectorXd& y;
  const Eigen::VectorXd& known;  ///< added to the linear predictor
  Eigen::VectorXd penalty;

  double operator()(const Eigen::VectorXd& b) const {
    const Eigen::ArrayXd eta = design * b + known;
    // ln(1 + e^eta) without overflow.
    const double likelihood = (eta.max(0.0) + (-eta.abs()).exp().log1p() - y.array() * eta).sum();
    return likelihood + 0.5 * (penalty.array() * b.array().square()).sum();
  }

  Eigen::VectorXd newton_step(const Eigen::VectorXd& beta) const {
    const Eigen::ArrayXd p = (design * beta + known).unaryExpr(&kicking::logistic).array();
    const Eigen::VectorXd gradient =
        design.transpose() * (y.array() - p).matrix() - (penalty.array() * beta.array()).matrix();
    Eigen::MatrixXd hessian = design.transpose() * (p * (1.0 - p)).matrix().asDiagonal() * design;
    hessian.diagonal() += penalty;
    return hessian.ldlt().solve(gradient);
  }

  Eigen::VectorXd minimum_from(Eigen::VectorXd beta) const {
    double current = (*this)(beta);
    for (int step = 0; step < kSteps; ++step) {
      Eigen::VectorXd change = newton_step(beta);
      // Halved until the loss falls: a full step may overshoot where the results are nearly separated.
      double next = (*this)(beta + change);
      for (int half = 0; half < 30 && !(next <= current); ++half) {
        change *= 0.5;
        next = (*this)(beta + change);
      }
      beta += change;
      current = next;
      if (change.cwiseAbs().maxCoeff() < kConverged) break;
    }
    return beta;
  }
};

}  // namespace

double LogisticFit::probability(const Eigen::VectorXd& x) const {
  return kicking::logistic(intercept + weights.dot(((x - means).array() / scales.array()).matrix()));
}

LogisticFit logistic_ridge(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, double ridge,
                           const Eigen::VectorXd& offset) {
  const Eigen::Index n = x.rows(), m = x.cols();
  const Eigen::VectorXd known = offset.size() == n ? offset : Eigen::VectorXd::Zero(n).eval();
  LogisticFit fit{.intercept = logit_of_share(y),
                  .weights = Eigen::VectorXd::Zero(m),
                  .means = Eigen::VectorXd::Zero(m),
                  .scales = Eigen::VectorXd::Ones(m)};
  if (n == 0) return fit;
  fit.means = x.colwise().mean();
  const Eigen::MatrixXd centred = x.rowwise() - fit.means.transpose();
  for (Eigen::Index i = 0; i < m; ++i) {
    const double sd = std::sqrt(centred.col(i).squaredNorm() / static_cast<double>(n));
    if (sd > 1e-9) fit.scales[i] = sd;
  }
  if (y.minCoeff() == y.maxCoeff()) return fit;  // one result alone: no slope, and no end to the intercept
  PenalisedLoss loss{Eigen::MatrixXd(n, m + 1), y, known, Eigen::VectorXd::Constant(m + 1, ridge)};
  loss.design.col(0).setOnes();
  loss.design.rightCols(m) = centred.array().rowwise() / fit.scales.transpose().array();
  loss.penalty[0] = 1e-9;
  Eigen::VectorXd start = Eigen::VectorXd::Zero(m + 1);
  start[0] = offset.size() == n ? 0.0 : fit.intercept;
  const Eigen::VectorXd beta = loss.minimum_from(start);
  fit.intercept = beta[0];
  fit.weights = beta.tail(m);
  return fit;
}

}  // namespace trivela::evaluator::stats
