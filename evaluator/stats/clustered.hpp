#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "evaluator/stats/counts.hpp"
#include "evaluator/stats/quantile.hpp"

namespace trivela::evaluator::stats {

/// Matches that a side needs; with fewer no inference from matches is possible.
inline constexpr std::size_t kFewestMatches = 5;

/// What one match has of both policies, of one stratum of situations.
struct MatchCounts {
  std::uint32_t match = 0;    ///< number of the match; matches are independent, kicks within one are not
  std::uint32_t stratum = 0;  ///< number of the stratum; 0 where there is one
  Counts older;
  Counts newer;
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
};

/// Difference of proportions sum_k w_k (p2_k - p1_k) with a variance by linearisation over matches (Liang and Zeger
/// 1986; Rao and Scott 1992): u_m = sum_k w_k ((x2 - n2 p2) / N2_k - (x1 - n1 p1) / N1_k) of the match's cells, V = sum
/// u_m^2. w_k are the pooled shares of the strata that both policies have (direct standardisation); one stratum has w
/// = 1.
///
/// Where a match has both policies (halves, or the same opportunities), V has the factor G / (G - 1) over the G matches
/// and G - 1 degrees of freedom: what the policies of a match have in common cancels, so that with the same
/// opportunities for both it is the paired interval. Otherwise each side has its own factor, and the degrees of freedom
/// are Satterthwaite's. None: fewer than kFewestMatches on a side, or no stratum with both.
std::optional<Clustered> clustered_difference(std::span<const MatchCounts> cells, double confidence = kConfidence);

/// Wilson's interval with the effective number of kicks n / deff (t_{G-1} / z)^-2, deff = the variance over matches
/// over that of independent kicks, at least 1 (Korn and Graubard 1998, with Wilson's interval as in Franco et al.
/// 2019). `matches`: one entry a match. None: fewer than kFewestMatches with a kick.
std::optional<Interval> clustered_wilson(std::span<const Counts> matches, double confidence = kConfidence);

}  // namespace trivela::evaluator::stats
