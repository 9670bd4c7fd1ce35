#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace trivela::evaluator::stats {

/// A ratio sum(x) / sum(n) over matches, such as kicks on target of kicks, and what it weighs in an estimate.
struct RatioPart {
  double x = 0.0;
  double n = 0.0;  ///< > 0 over all matches
  double weight = 0.0;
  bool newer = false;  ///< of the newer side
};

/// What a match has of one part.
struct RatioCell {
  std::uint32_t match = 0;
  std::size_t part = 0;
  double x = 0.0;
  double n = 0.0;
  double spread = 0.0;  ///< variance that x would have if matches differed as usual; its unit does not matter
};

/// sum_g w_g x_g / n_g with its variance by bias-reduced linearisation.
struct BiasReduced {
  double variance = 0.0;
  double df = 0.0;  ///< degrees of freedom of Student's distribution
};

/// Variance with few, unequal and partly shared matches (Bell and McCaffrey 2002, Survey Methodology 28:169; Imbens and
/// Kolesar 2016): V = sum_m u_m^2, u_m = sum_g w_g / n_g (x_gm - n_gm x_g / n_g) / sqrt(1 - h_gm), h_gm = n_gm / n_g
/// the match's leverage; matches of the same size have the factor G / (G - 1). Satterthwaite's degrees of freedom (tr
/// P)^2 / tr P^2, P the covariance of the u_m under the cells' spreads: the smaller of those with the spreads as they
/// are and with each side's brought to the variance that it showed, which for separate matches of the same size is
/// Welch's.
BiasReduced bias_reduced(std::span<const RatioPart> parts, std::span<const RatioCell> cells);

/// Spread of x of n trials with a chance p: n p (1 - p) (1 + (n - 1) rho), trials of a match alike with an intraclass
/// correlation rho of 0.1.
double spread_of_trials(double n, double p);

/// The same of events of which `mean` are expected: mean (1 + 0.1 mean).
double spread_of_events(double mean);

}  // namespace trivela::evaluator::stats
