#pragma once

#include <cstdint>

#include "kicking/optional_double.hpp"
#include "kicking/policy/predictive/predictive_config.hpp"

namespace trivela::kicking {

/// Distance r of the nearest opponent from the ball and the rate c at which it comes nearer, filtered:
///
///     r(t) = r - c t,   c walks;   seen: r + c lag + noise
///
/// a Kalman filter of two states. While the game stands the opponent does, and c is what the configuration says.
struct OpponentWatch {
  bool seen = false;
  std::int64_t t_ns = 0;
  double distance_m = 0.0;
  double closing_mps = 0.0;
  double var_distance_m2 = 0.0;
  double var_closing_m2ps2 = 0.0;
  double covariance_m2ps = 0.0;

  /// One cycle. `distance_m`: as observed, none: not seen. `closing_mps`: where both are known exactly.
  void update(const PredictiveConfig& config, std::int64_t now_ns, bool playing, OptionalDouble observed_m,
              OptionalDouble known_closing_mps);

  /// Distance expected after t [s].
  double distance_after_m(double t_s) const { return distance_m - closing_mps * t_s; }
};

/// Probability that a ball held now is still held after t: nobody at dispute distance, nothing else.
///
///     S(t) = Phi((r - c t - r_dispute) / sd(t)) exp(-hazard t),   sd^2 = P_rr - 2 t P_rc + t^2 P_cc
///
/// relative to t = 0. 1 for t <= 0; only the hazard where no opponent is seen.
class Survival {
 public:
  Survival(const PredictiveConfig& config, const OpponentWatch& watch);
  double operator()(double t_s) const;

 private:
  double held(double t_s) const;

  const PredictiveConfig& config_;
  const OpponentWatch& watch_;
  double held_now_ = 1.0;
};

}  // namespace trivela::kicking
