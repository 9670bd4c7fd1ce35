#pragma once

#include <span>
#include <vector>

#include "evaluator/stats/clustered.hpp"
#include "evaluator/stats/counts/counts.hpp"
#include "log/shards/study_results.hpp"

namespace trivela::experiment {

using log::ArmTally;
using log::MatchTally;

/// Shares that arms are compared by.
enum class Measure {
  kEfficiency,      ///< on target of kicks
  kUnblocked,       ///< on target of the kicks that nobody blocked
  kPerOpportunity,  ///< on target of opportunities
  kGoals,           ///< goals of opportunities
  kBounced          ///< bounced of kicks on target
};

/// A number with its 95 % interval. NaN: there are too few kicks for it, or for the interval alone.
struct Effect {
  double value = 0.0;
  evaluator::stats::Interval ci;
};

bool has_interval(const Effect& effect);

MatchTally total_of(const ArmTally& matches);

/// What each match of the arms adds to an estimate's error, and to what calibration it belongs. `u`: one number a
/// match, in the order of `arm`.
std::vector<evaluator::stats::Influence> influences_of(const ArmTally& arm, const std::vector<double>& u);

/// Half the width of the 95 % interval of an estimate with these influences: Student's t times the standard error, by
/// match, and by calibration where there are enough of them (cluster_variance()). NaN: fewer than two matches.
double half_width_of(const ArmTally& arm, const std::vector<double>& u);

/// The measure's counts of one match.
evaluator::stats::Counts counts_of(const MatchTally& tally, Measure measure);

/// An arm and what it weighs in a sum.
struct Term {
  const ArmTally* arm = nullptr;
  double weight = 0.0;
};

/// sum_a w_a p_a with p_a the arm's share over all matches. Variance by linearisation over matches and calibrations,
/// which all arms have in common (cluster_variance()): u_m = sum_a w_a (x_am - p_a n_am) / N_a. An arm without a kick
/// has no efficiency; an arm with kicks in one match only has no interval, since one match does not say how far matches
/// differ. Nor have arms of which each has all or nothing on target.
Effect contrast(std::span<const Term> terms, Measure measure);

/// One arm's share. Its interval is contrast()'s, which is symmetric, cut off at 0 and 1. Where all or nothing was on
/// target, so that the linearised variance is 0: Wilson's, by match where there are enough of them.
Effect share_of(const ArmTally& matches, Measure measure);

/// Kicks of `newer` over kicks of `older`, the interval that of the logarithm, by the same linearisation. None where
/// `older` never kicks; no interval where one of them kicks in fewer than two matches.
Effect kick_ratio(const ArmTally& older, const ArmTally& newer);

}  // namespace trivela::experiment
