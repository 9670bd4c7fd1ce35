#pragma once

#include "kicking/lob/analyzer_config.hpp"
#include "kicking/lob/lob_record.hpp"
#include "kicking/lob/tracker.hpp"

namespace trivela::kicking::lob {

/// Fits both models to a flight and says whether it is a lob. Centres at the two ends that are far off the flight
/// (kicker's lever, bounce: more than 2 cm and four robust standard deviations) are left out first. Refused, in this
/// order, when there are
///   fewer than least_points centres,
///   fewer than two centres on a side of the parabola's apex,
///   a third of the flight whose mean chord ratio is below least_chord_ratio: a ball that is off the scan plane by e
///   covers sqrt(1 - e^2 / r^2) of its angle,
///   residuals above largest_residual_m, no fit, or a launch farther than launch_tolerance_m from x = 0.
/// The residuals are those of the true fit; with the paper's centres, which lie too far by centimetres that change
/// along the flight, those of the parabola. A refused record has the fits that could be made.
LobRecord assess(Flight flight, const AnalyzerConfig& config);

}  // namespace trivela::kicking::lob
