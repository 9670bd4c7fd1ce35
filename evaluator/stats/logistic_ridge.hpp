#pragma once

#include <Eigen/Core>

namespace trivela::evaluator::stats {

/// P(y = 1 | x) = 1 / (1 + exp(-(b + sum_i w_i (x_i - mean_i) / scale_i))).
struct LogisticFit {
  double intercept = 0.0;
  Eigen::VectorXd weights;
  Eigen::VectorXd means;
  Eigen::VectorXd scales;  ///< standard deviations; 1 for a column that is constant

  double probability(const Eigen::VectorXd& x) const;
};

/// Logistic regression with a ridge penalty (ridge / 2) sum(w^2), the intercept free (le Cessie and van Houwelingen
/// 1992), by Newton's method on standardised columns. `x`: a row an observation; `y`: 0 or 1 each. Finite for every
/// input with ridge > 0, also where one result never comes: the intercept is held at the logit of (k + 1/2) / (n + 1)
/// or less far out. Without rows a probability of one half.
/// `offset`: a known part of each row's logit, which the fit corrects and `probability` leaves out; empty: none. The
/// penalty then pulls towards the offset itself.
LogisticFit logistic_ridge(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, double ridge,
                           const Eigen::VectorXd& offset = {});

}  // namespace trivela::evaluator::stats
