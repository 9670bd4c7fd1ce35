#pragma once

#include "evaluator/stats/counts.hpp"

namespace trivela::evaluator::stats {

/// P(p_new > p_old) with independent uniform priors: the posteriors are Beta(k + 1, n - k + 1), and
/// P = integral of f_new(p) F_old(p) over [0, 1]. Without kicks in either group 0.5.
double p_new_better(Counts older, Counts newer);

}  // namespace trivela::evaluator::stats
