#pragma once

#include <array>
#include <cmath>

#include "kicking/constants.hpp"
#include "kicking/geometry/goal.hpp"

namespace trivela::kicking {

/// A kick towards the goal line: speed, elevation, forward speed u that the robot adds, horizontal distance, launch
/// height.
struct KickAtLine {
  double v_kick_mps = 0.0;
  double exit_angle_rad = 0.0;
  double u_mps = 0.0;
  double distance_m = 0.0;
  double launch_height_m = Ball{}.radius_m;
};

/// Standard deviations of a kick: speed relative to V, elevation, the robot's speed, where it crosses sideways.
struct KickSpread {
  double speed_relative = 0.0;
  double exit_angle_rad = 0.0;
  double u_mps = 0.0;
  double lateral_m = 0.0;
};

/// Height at the line and its partial derivatives, with v_x = V c + u, v_z = V s:
/// dz/dV = d s / v_x - d v_z c / v_x^2 + g d^2 c / v_x^3; dz/du = -d v_z / v_x^2 + g d^2 / v_x^3;
/// dz/dtheta = d V c / v_x + d v_z^2 / v_x^2 - g d^2 v_z / v_x^3.
struct HeightSensitivity {
  double z_m = 0.0;
  double dz_dv_s = 0.0;
  double dz_dtheta_m_per_rad = 0.0;
  double dz_du_s = 0.0;
};
HeightSensitivity height_sensitivity(const KickAtLine& kick, double gravity_mps2 = kGravity_mps2);

/// Probability that the ball's centre crosses the goal line cleanly inside, height and side apart and together.
struct InsideProbability {
  double z_m = 0.0;
  double sd_z_m = 0.0;
  double p_below_bar = 0.0;
  double p_between_posts = 0.0;
  double p_inside = 0.0;
};

/// Phi(margin / sd), the probability that a normal error of that standard deviation stays below the margin; a step at
/// zero if nothing spreads.
double normal_below(double margin_m, double sd_m);

/// The probability that has the logit x: 1 / (1 + e^-x).
inline double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

/// First-order propagation of the spread: P = Phi((z_clean - z) / sd_z) (Phi((x_clean - x) / sd_x) - Phi((-x_clean - x)
/// / sd_x)). There is no lower limit, since a ball that bounces in counts. x_mean_m is where the kick is expected to
/// cross, in F.
InsideProbability p_inside(const KickAtLine& kick, const KickSpread& spread, double x_mean_m, const Goal& goal,
                           const Ball& ball = {}, double gravity_mps2 = kGravity_mps2);

/// What became of a kick. On target: "between the posts and below the bar" (paper, Table 2). Left and right as the
/// kicker sees them.
enum class Outcome { kOnTarget, kWideLeft, kWideRight, kOver, kShort, kPost, kBar, kBlocked, kUnknown };

/// Their names in logs and reports, in their order.
inline constexpr std::array kOutcomeNames{"on_target", "wide_left", "wide_right", "over",   "short",
                                          "post",      "bar",       "blocked",    "unknown"};
constexpr const char* name(Outcome outcome) { return kOutcomeNames.at(static_cast<std::size_t>(outcome)); }

/// Outcome of a ball whose centre crosses the goal line at x [m, F] and height z [m]. A ball that bounced or rolls (low
/// z) counts as inside. The frame is hit where the ball overlaps post or bar; beyond a post it is wide, however high.
/// NaN: kUnknown.
Outcome classify(double x_cross_m, double z_cross_m, const Goal& goal, const Ball& ball = {});

/// Probability of each outcome but kUnknown, by its number.
using OutcomeProbabilities = std::array<double, static_cast<std::size_t>(Outcome::kUnknown)>;

/// What classify() says of a crossing that is known to a normal error, x and z apart: products of Phi over its
/// rectangles, with N = Phi of the wide half-width less Phi of its mirror and C the same of the clean one,
///
///     over = N P(z > z_over), post = (N - C) P(z < z_over), bar = C P(z_clean < z < z_over), on target = C P(z <
///     z_clean).
///
/// kShort and kBlocked are 0. They sum to 1.
OutcomeProbabilities crossing_probabilities(double x_cross_m, double sd_x_m, double z_cross_m, double sd_z_m,
                                            const Goal& goal, const Ball& ball = {});

}  // namespace trivela::kicking
