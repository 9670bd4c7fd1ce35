#pragma once

namespace trivela::evaluator::stats {

inline constexpr double kConfidence = 0.95;  ///< of every interval unless told otherwise

/// z = Phi^-1((1 + confidence) / 2) of the standard normal distribution.
double z_of(double confidence);

/// The same of Student's distribution with `df` > 0 degrees of freedom, which need not be whole.
double t_of(double confidence, double df);

/// 2 (1 - Phi(|z|)).
double two_sided_p(double z);

/// The same of Student's distribution.
double student_p(double t, double df);

/// P(X > statistic) of the chi-square distribution with `df` > 0 degrees of freedom.
double chi_square_p(double statistic, double df);

}  // namespace trivela::evaluator::stats
