#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "evaluator/stats/counts.hpp"

namespace trivela::cli {

/// What one arm did in one match.
struct MatchTally {
  std::int64_t opportunities = 0;
  std::int64_t kicks = 0;
  std::int64_t on_target = 0;  ///< observed
};

/// Shares that arms are compared by.
enum class Measure {
  kEfficiency,     ///< on target of kicks
  kPerOpportunity  ///< on target of opportunities
};

/// An arm's matches, in the order of their numbers.
using ArmTally = std::vector<MatchTally>;

/// A number with its 95 % interval.
struct Effect {
  double value = 0.0;
  evaluator::stats::Interval ci;
};

MatchTally total_of(const ArmTally& matches);

/// The measure's counts of one match.
evaluator::stats::Counts counts_of(const MatchTally& tally, Measure measure);

/// An arm and what it weighs in a sum.
struct Term {
  const ArmTally* arm = nullptr;
  double weight = 0.0;
};

/// sum_a w_a p_a with p_a the arm's share over all matches. Variance by linearisation over matches, which all arms
/// have in common: u_m = sum_a w_a (x_am - p_a n_am) / N_a, V = G / (G - 1) sum u_m^2, Student's distribution with G -
/// 1 degrees of freedom. An arm without a kick has no efficiency: NaN.
Effect contrast(std::span<const Term> terms, Measure measure);

/// Kicks of `newer` over kicks of `older`, the interval that of the logarithm, by the same linearisation.
Effect kick_ratio(const ArmTally& older, const ArmTally& newer);

}  // namespace trivela::cli
