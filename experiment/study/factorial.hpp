#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/study/study.hpp"

namespace trivela::experiment {

// What the paper observed: Table 2 (34 of 65 and 100 of 132 kicks on target).
inline constexpr evaluator::stats::Counts kPaperOlder{34, 65};
inline constexpr evaluator::stats::Counts kPaperNewer{100, 132};
inline constexpr double kPaperKickRatio = 132.0 / 65.0;

/// Laws of height and motion together, from the paper's words to the exact ones: "paper" as printed, "released" with
/// the extended range of the released code, "exact". Directions go by the paper's lines in all.
std::vector<std::string> factorial_laws();

/// {old, new table} x ({stopped, moving} x law, predictive), 14 cells of kind "cell"; predictive has no law. Then the
/// old table and `stopped` against the new one and `moving`, as the paper's two tournaments, both with `law`:
/// - kind "sweep": by the opponents' median distance [m]
/// - kind "bias": by the error of the person who made the old table [m]; balls so much too high seemed right then
/// `like`: settings and robots of all. An old table is drawn for each match.
Study factorial_study(const sim::Scenario& scenario, const Arm& like, const std::string& law,
                      const std::vector<double>& opponent_medians_m, const std::vector<double>& eye_biases_m);

/// A main effect or an interaction in both measures.
struct NamedEffect {
  std::string key;   ///< "calibration"
  std::string what;  ///< what is subtracted from what, averaged over what
  Effect efficiency;
  Effect per_opportunity;
};

/// The effects of the cells, each averaged over all levels of the other two factors, and last "gain", from the old
/// table and `stopped` to the new one and `moving`: calibration and motion, each as the mean of both orders of
/// introducing them, add up to it. `efficiency`: kEfficiency or, with blocked kicks apart, kUnblocked.
std::vector<NamedEffect> effects_of(const std::vector<StudyRow>& rows, Measure efficiency);

/// Where the kick ratio of the rows of kind "sweep" is the paper's 2.03, linear between points, and where its 95 %
/// interval begins and ends to have it. None: nowhere in the sweep.
struct RatioMet {
  std::optional<double> at_m;
  std::optional<double> from_m;
  std::optional<double> to_m;
};
RatioMet ratio_met(const std::vector<StudyRow>& rows);

}  // namespace trivela::experiment
