#pragma once

#include <functional>
#include <string>
#include <vector>

#include "evaluator/render/json_values.hpp"
#include "evaluator/stats/clustered.hpp"
#include "evaluator/stats/counts/interval.hpp"
#include "log/shards/study_results.hpp"

namespace trivela::experiment {

using evaluator::Json;
using log::ArmTally;
using log::MatchTally;

/// Shares that arms are compared by.
enum class Measure {
  kEfficiency,      ///< on target of kicks
  kUnblocked,       ///< on target of the kicks that nobody blocked
  kPerOpportunity,  ///< on target of opportunities
  kGoals,           ///< goals of opportunities
  kBounced,         ///< bounced of kicks on target
  kBlocked,         ///< blocked of kicks
  kKicks            ///< kicks of opportunities
};

/// A number with its 95 % interval. NaN: there are too few kicks for it, or for the interval alone.
struct Effect {
  double value = 0.0;
  evaluator::stats::Interval ci;
};

bool has_interval(const Effect& effect);

MatchTally total_of(const ArmTally& matches);

/// For a chart: "kicks of 100 opportunities".
const char* name_of(Measure measure);

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
Effect contrast(const std::vector<Term>& terms, Measure measure);

/// The share of `newer` less that of `older`: contrast().
Effect difference(const ArmTally& newer, const ArmTally& older, Measure measure);

/// One arm's share with the interval that `trivela compare` gives it: clustered_wilson() by match and calibration, of
/// too few matches wilson_or_exact(). No interval where fewer than two matches have anything to count.
Effect share_of(const ArmTally& matches, Measure measure);

/// Kicks of `newer` over kicks of `older`, the interval that of the logarithm, by the same linearisation. None where
/// `older` never kicks; no interval where one of them kicks in fewer than two matches.
Effect kick_ratio(const ArmTally& older, const ArmTally& newer);

/// A function of the arms' totals over all matches with its 95 % interval: the jackknife over matches, by match and
/// calibration (cluster_variance()). No interval where it has no finite value without one of the matches.
Effect jackknife(const std::vector<const ArmTally*>& arms,
                 const std::function<double(const std::vector<MatchTally>&)>& of);

/// A share in per cent: "87.8 (87.1 to 88.5)"; "87.8 (-)" without an interval, "-" without a value.
std::string share_text(const Effect& effect);

/// A difference of shares in percentage points, always with its sign.
std::string points_text(const Effect& effect);

/// {"value": ..., "ci": [lo, hi]}; null without a value, "ci" null without an interval.
Json json_of(const Effect& effect);

/// A sentence where the simulator's truth lies outside of what the labels say: a robot's file that is far from the
/// robot makes wrong labels. Empty: nowhere.
std::string label_warning(const std::string& arm, const ArmTally& observed);

}  // namespace trivela::experiment
