#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "evaluator/stats/counts/interval.hpp"

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

/// Calibrations from which on an interval allows for what they differ by; fewer cannot say how far they do.
inline constexpr std::size_t kFewestCalibrations = 5;

/// What a match under one calibration adds to an estimate's error, by linearisation. Those of the same match and
/// calibration are summed.
struct Influence {
  std::uint32_t match = 0;
  std::uint32_t calibration = 0;  ///< the calibration that the robots were calibrated on; the same one for many matches
  double u = 0.0;                 ///< in the estimate's unit
};

/// Variance of an estimate whose parts are alike within a match and within a calibration.
struct ClusterVariance {
  double variance = 0.0;
  double df = 0.0;  ///< degrees of freedom of Student's distribution
  std::size_t matches = 0;
  std::size_t calibrations = 0;
  bool by_calibration = false;  ///< it holds what calibrations differ by; otherwise it is of these calibrations alone

  /// Half the width of the estimate's interval. NaN where an influence was not finite.
  double reach(double confidence = kConfidence) const;
};

/// With fewer than kFewestCalibrations calibrations V = M / (M - 1) S_M with M - 1 degrees of freedom, S_M = sum of the
/// squared sums of u over each of M matches. Otherwise matches and calibrations are crossed (Cameron, Gelbach and
/// Miller 2011, J. Business & Economic Statistics 29:238): V = M / (M - 1) K / (K - 1) (S_M + S_K - S_MK), S_K over K
/// calibrations, S_MK over what is of one match and calibration; these factors make it unbiased where each match is
/// played with each calibration. It is not let below the larger of V_M = M / (M - 1) S_M and V_K (MacKinnon, Nielsen
/// and Webb 2021), and has Satterthwaite's degrees of freedom V^2 / (V_M^2 / (M - 1) + V_K^2 / (K - 1) + V_MK^2 / ((M -
/// 1)(K - 1))), V_MK = V_M + V_K - V. None: fewer than two matches.
std::optional<ClusterVariance> cluster_variance(std::span<const Influence> influences);

/// What each of `n` matches adds to an estimate's error by the jackknife (Efron and Stein 1981): (n - 1) / n (mean -
/// value without it). `without`: the estimate without match i.
std::vector<double> jackknife(std::size_t n, const std::function<double(std::size_t)>& without);

}  // namespace trivela::evaluator::stats
