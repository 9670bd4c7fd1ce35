#include "kicking/policy/predictive/opponent_watch.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/geometry/time.hpp"
#include "kicking/outcome/outcome.hpp"

namespace trivela::kicking {
namespace {

constexpr double kLeastHeld = 1e-3;

}  // namespace

void OpponentWatch::update(const PredictiveConfig& config, std::int64_t now_ns, bool playing, OptionalDouble observed_m,
                           OptionalDouble known_closing_mps) {
  const double dt_s = std::clamp(seconds(now_ns - t_ns), 0.0, 0.2);
  t_ns = now_ns;
  if (observed_m && *observed_m < 0.0) observed_m = std::nullopt;
  if (known_closing_mps) {
    *this = {observed_m.has_value(), now_ns, observed_m.value_or(0.0), playing ? *known_closing_mps : 0.0, 0, 0, 0};
    return;
  }
  const double var_seen_m2 = config.opponent_sd_m * config.opponent_sd_m;
  const double var_prior_m2ps2 = config.closing_sd_mps * config.closing_sd_mps;
  if (!seen) {
    if (observed_m) *this = {true, now_ns, *observed_m, config.closing_mps, var_seen_m2, var_prior_m2ps2, 0.0};
    return;
  }
  double lag_s = config.opponent_lag_s;
  if (playing) {
    distance_m -= closing_mps * dt_s;
    var_distance_m2 += dt_s * (dt_s * var_closing_m2ps2 - 2.0 * covariance_m2ps);
    covariance_m2ps -= dt_s * var_closing_m2ps2;
    var_closing_m2ps2 += config.closing_walk_mps2 * config.closing_walk_mps2 * dt_s;
  } else {  // it stands, and comes when play starts
    closing_mps = config.closing_mps;
    var_closing_m2ps2 = var_prior_m2ps2;
    covariance_m2ps = 0.0;
    lag_s = 0.0;
  }
  if (!observed_m) return;
  // Seen is h = (1, lag): gain K = P h / (h' P h + R).
  const double cov_distance = var_distance_m2 + lag_s * covariance_m2ps;
  const double cov_closing = covariance_m2ps + lag_s * var_closing_m2ps2;
  const double var_innovation = cov_distance + lag_s * cov_closing + var_seen_m2;
  if (!(var_innovation > 0.0)) return;
  const double innovation_m = *observed_m - (distance_m + (playing ? lag_s * closing_mps : 0.0));
  const double gain_distance = cov_distance / var_innovation, gain_closing = cov_closing / var_innovation;
  distance_m += gain_distance * innovation_m;
  closing_mps += gain_closing * innovation_m;
  var_distance_m2 -= gain_distance * cov_distance;
  var_closing_m2ps2 -= gain_closing * cov_closing;
  covariance_m2ps -= gain_distance * cov_closing;
}

Survival::Survival(const PredictiveConfig& config, const OpponentWatch& watch) : config_(config), watch_(watch) {
  held_now_ = std::max(kLeastHeld, held(0.0));
}

double Survival::held(double t_s) const {
  if (!watch_.seen) return 1.0;
  const double variance =
      watch_.var_distance_m2 + t_s * (t_s * watch_.var_closing_m2ps2 - 2.0 * watch_.covariance_m2ps);
  return normal_below(watch_.distance_after_m(t_s) - config_.dispute_distance_m, std::sqrt(std::max(0.0, variance)));
}

double Survival::operator()(double t_s) const {
  if (!(t_s > 0.0)) return 1.0;
  return std::min(1.0, held(t_s) / held_now_) * std::exp(-config_.hazard_per_s * t_s);
}

}  // namespace trivela::kicking
