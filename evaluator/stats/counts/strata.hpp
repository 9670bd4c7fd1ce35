#pragma once

#include <optional>
#include <span>

#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::stats {

/// Kicks of both policies under like conditions, such as from one bin of distances. Symbols below: a of n2 newer and
/// c of n1 older kicks inside, b and d outside, N = n1 + n2.
struct Stratum {
  Counts older;
  Counts newer;
};

/// Common odds ratio sum(a d / N) / sum(b c / N) (Mantel and Haenszel 1959) with the interval of Robins, Breslow and
/// Greenland (1986) on its logarithm. None: a sum is zero.
std::optional<Ratio> mantel_haenszel_odds_ratio(std::span<const Stratum> strata, double confidence = kConfidence);

struct ChiSquare {
  double statistic = 0.0;
  double df = 1.0;
  double p = 1.0;
};

/// Cochran-Mantel-Haenszel test that no stratum has a difference: (|sum(a - E a)| - y)^2 / sum(Var a) with fixed
/// margins, y = 1/2 with Yates' correction where |sum| is not below it, else 0 (as R's mantelhaen.test). None: no
/// variance.
std::optional<ChiSquare> cochran_mantel_haenszel(std::span<const Stratum> strata, bool corrected = false);

/// A difference newer - older with its interval.
struct Difference {
  double value = 0.0;
  Interval ci;
};

/// Mantel-Haenszel risk difference sum(w (p2 - p1)) / sum(w), w = n1 n2 / N, with Sato's variance (Sato 1989,
/// Biometrics 45:1323), consistent for few large and for many small strata; where that is 0, the interval is that of
/// standardised(). None: no stratum has both policies.
std::optional<Difference> mantel_haenszel_risk_difference(std::span<const Stratum> strata,
                                                          double confidence = kConfidence);

/// What both policies would have scored on the same mix of situations.
struct Standardised {
  double older = 0.0;
  double newer = 0.0;
  Difference difference;
};

/// Direct standardisation to the pooled mix: sum(w p) with w = N / sum(N) over the strata that have both policies. The
/// interval is MOVER's (Zou and Donner 2008) from Wilson's of each cell: d - sqrt(sum(w^2 ((p2 - l2)^2 + (u1 - p1)^2)))
/// to d + ...; with one stratum it is Newcombe's. None: no stratum has both policies.
std::optional<Standardised> standardised(std::span<const Stratum> strata, double confidence = kConfidence);

/// Breslow and Day's test (1980, without Tarone's correction) that every stratum has the common odds ratio. None: fewer
/// than two strata can tell.
std::optional<ChiSquare> breslow_day(std::span<const Stratum> strata);

}  // namespace trivela::evaluator::stats
