#pragma once

#include <array>

#include "kicking/constants.hpp"
#include "kicking/geometry/goal.hpp"

namespace trivela::kicking {

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
