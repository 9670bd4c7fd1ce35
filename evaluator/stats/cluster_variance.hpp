#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "evaluator/stats/counts/quantile.hpp"

namespace trivela::evaluator::stats {

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
