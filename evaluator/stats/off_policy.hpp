#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::stats {

/// What is known of an opportunity before anybody decides.
inline constexpr std::size_t kContext = 4;
using Context = std::array<double, kContext>;

/// An opportunity for which the policy in charge was drawn at random.
struct Trial {
  bool by_target = false;    ///< the policy to be valued was drawn
  double probability = 0.0;  ///< with which the drawn one was drawn, in (0, 1)
  double reward = 0.0;       ///< 1: a shot on target, 0: none
  std::uint32_t match = 0;   ///< opportunities of a match are alike
  Context context{};
};

/// Mean reward per opportunity that the policy would have.
struct PolicyValue {
  double value = 0.0;
  Interval ci;  ///< within [0, 1] unless the value is not (inverse probability may leave it); from matches with
                ///< Student's distribution, from opportunities with the normal one where too few
};

/// Weights w = by_target / probability.
struct OffPolicy {
  PolicyValue ips;            ///< mean of w y (Horvitz and Thompson 1952)
  PolicyValue snips;          ///< sum(w y) / sum(w) (Hajek 1971): no more than the best reward, less scattered
  PolicyValue doubly_robust;  ///< mean of m(x) + w (y - m(x)) (Robins et al. 1994; Dudik et al. 2011)
  double logged = 0.0;        ///< mean reward of all trials, as they were played
  std::size_t trials = 0;
  std::size_t by_target = 0;
  std::size_t matches = 0;
  bool by_match = false;               ///< the intervals are from matches
  double effective_sample_size = 0.0;  ///< (sum w)^2 / sum(w^2) (Kish 1965)
  double largest_weight = 0.0;
  double mean_weight = 1.0;    ///< 1 on average where the probabilities are those that were drawn with
  double mean_weight_p = 1.0;  ///< two-sided that it is
};

inline constexpr double kFewestEffective = 20.0;  ///< effective trials below which no estimate is given

/// Effective sample size of the trials' weights; 0: the policy was never drawn.
double effective_sample_size(std::span<const Trial> trials);

/// Value of the policy. m(x) is a logistic ridge regression of the reward on the context, fitted to the trials of the
/// policy in the other folds of matches (of trials, where there are fewer than kFolds matches). At least one trial by
/// the policy.
OffPolicy off_policy_value(std::span<const Trial> trials, double confidence = kConfidence);

}  // namespace trivela::evaluator::stats
