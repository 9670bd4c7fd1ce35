#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "evaluator/stats/counts/counts.hpp"
#include "evaluator/stats/counts/quantile.hpp"

namespace trivela::evaluator::stats {

/// Matches that a side needs; with fewer no inference from matches is possible.
inline constexpr std::size_t kFewestMatches = 5;

/// With fewer on a side a spread below that of independent kicks is not believed.
inline constexpr std::size_t kManyMatches = 12;

/// Kicks, or matches, with fewer of which Wilson's interval is too narrow: it has the truth in 87.5 % of cases of 4
/// kicks at 50 %, in 88 % of 12 kicks at 99 %.
inline constexpr std::int64_t kEnoughForWilson = 24;

/// What one match has of both policies, of one stratum of situations.
struct MatchCounts {
  std::uint32_t match = 0;    ///< number of the match; matches are independent, kicks within one are not
  std::uint32_t stratum = 0;  ///< number of the stratum; 0 where there is one
  Counts older;
  Counts newer;
  std::uint32_t calibration = 0;  ///< number of the calibration that the robots were calibrated on
};

/// Interval of a difference that allows for kicks of one match being alike.
struct Clustered {
  double value = 0.0;  ///< newer - older
  Interval ci;         ///< within [-1, 1]
  double standard_error = 0.0;
  double df = 0.0;             ///< degrees of freedom of Student's distribution
  double design_effect = 1.0;  ///< variance over that of independent kicks
  std::size_t older_matches = 0;
  std::size_t newer_matches = 0;
  std::size_t calibrations = 1;
  bool by_calibration = false;  ///< it allows for what calibrations differ by; otherwise it is of these alone
};

/// Difference of proportions sum_k w_k (p2_k - p1_k) with a variance by linearisation over matches (Liang and Zeger
/// 1986; Rao and Scott 1992) that holds for few and unequal ones, whether they have both policies, one, or some both
/// (bias_reduced()). w_k are the pooled shares of the strata that both policies have (direct standardisation); one
/// stratum has w = 1. What the policies of a match have in common cancels, so that with the same opportunities for both
/// it is the paired interval. From kFewestCalibrations calibrations on the variance is no less, and the degrees of
/// freedom no more, than those by match and calibration (cluster_variance()).
/// With fewer than kManyMatches on a side, or where the matches show no spread at all, the interval is no narrower than
/// Agresti and Caffo's of the same kicks taken as independent: so few matches can be alike by chance.
/// None: fewer than kFewestMatches on a side, or no stratum with both.
std::optional<Clustered> clustered_difference(std::span<const MatchCounts> cells, double confidence = kConfidence);

/// What one match, under one calibration, has of one policy.
struct ClusterCounts {
  std::uint32_t match = 0;
  std::uint32_t calibration = 0;
  Counts counts;
};

/// Wilson's interval with the effective number of kicks n / deff (t_df / z)^-2, deff = the variance over matches
/// (bias_reduced()), and from kFewestCalibrations on over calibrations, too, over that of independent kicks, at least 1
/// (Korn and Graubard 1998, with Wilson's interval as in Franco et al. 2019). With
/// fewer than kEnoughForWilson matches it is no narrower than Clopper and Pearson's of the same kicks taken as
/// independent. None: fewer than kFewestMatches with a kick.
std::optional<Interval> clustered_wilson(std::span<const ClusterCounts> cells, double confidence = kConfidence);

/// The same with one entry a match and one calibration.
std::optional<Interval> clustered_wilson(std::span<const Counts> matches, double confidence = kConfidence);

/// Where there are too few matches for clustered_wilson(): Wilson's interval of independent kicks, and of fewer than
/// kEnoughForWilson no narrower than Clopper and Pearson's.
Interval wilson_or_exact(Counts counts, double confidence = kConfidence);

/// Where there are too few matches for clustered_difference(): Newcombe's interval (newcombe()) with both ends of
/// wilson_or_exact(). A group without kicks: [-1, 1].
Interval newcombe_or_exact(Counts older, Counts newer, double confidence = kConfidence);

}  // namespace trivela::evaluator::stats
