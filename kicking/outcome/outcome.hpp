#pragma once

#include "kicking/constants.hpp"
#include "kicking/geometry/goal.hpp"

namespace trivela::kicking {

/// What became of a kick. On target: "between the posts and below the bar" (paper, Table 2). Left and right as the
/// kicker sees them.
enum class Outcome { kOnTarget, kWideLeft, kWideRight, kOver, kShort, kPost, kBar, kBlocked, kUnknown };

/// "on_target", "wide_left", ...: the word in logs and reports.
const char* name(Outcome outcome);

/// Outcome of a ball whose centre crosses the goal line at x [m, F] and height z [m]. A ball that bounced or rolls (low
/// z) counts as inside. The frame is hit where the ball overlaps post or bar; beyond a post it is wide, however high.
/// NaN: kUnknown.
Outcome classify(double x_cross_m, double z_cross_m, const Goal& goal, const Ball& ball = {});

}  // namespace trivela::kicking
