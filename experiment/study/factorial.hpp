#pragma once

#include <string>
#include <vector>

#include "experiment/study/study.hpp"

namespace trivela::experiment {

/// Laws of height and motion together, from the paper's words to the exact ones: "paper" as printed, "released" with
/// the extended range of the released code, "exact". Directions go by the paper's lines in all.
std::vector<std::string> factorial_laws();

/// {old, new table} x ({stopped, moving} x law, predictive), 14 cells of kind "cell"; predictive has no law. Then the
/// old table and `stopped` against the new one and `moving`, as the paper's two tournaments, both with `law`:
/// - kind "sweep": by the opponents' median distance [m]
/// - kind "bias": by the error of the person who made the old table [m]; balls so much too high seemed right then
/// `like`: settings and robots of all. An old table is drawn for each match.
/// It answers with main effects and interactions, each averaged over all levels of the other two factors; last "gain",
/// from the old table and `stopped` to the new one and `moving`: calibration and motion, each as the mean of both
/// orders of introducing them, add up to it. Of a sweep it says where the kick ratio is the paper's 2.03, linear
/// between points, and where its 95 % interval begins and ends to have it.
Study factorial_study(const sim::Scenario& scenario, const Arm& like, const std::string& law,
                      const std::vector<double>& opponent_medians_m, const std::vector<double>& eye_biases_m);

}  // namespace trivela::experiment
