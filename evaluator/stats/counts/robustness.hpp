#pragma once

#include <cstdint>
#include <optional>

#include "evaluator/stats/counts/counts.hpp"

namespace trivela::evaluator::stats {

/// Outcomes of one policy that would have to be labelled the other way before Fisher's two-sided p reaches alpha.
struct Fragility {
  std::int64_t newer = 0;  ///< of the newer policy, towards the older one's efficiency
  std::int64_t older = 0;  ///< of the older policy, towards the newer one's
};

/// None: p is alpha or above already.
std::optional<Fragility> fragility(Counts older, Counts newer, double alpha = 0.05);

/// E-value of a risk ratio (VanderWeele and Ding 2017): rr + sqrt(rr (rr - 1)), of 1 / rr below 1. As strong an
/// association, with the policy and with the outcome, would an unrecorded difference between the matches need to
/// explain the ratio away. 1 for a ratio of 1.
double e_value(double risk_ratio);

}  // namespace trivela::evaluator::stats
