#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiment/factorial/analysis.hpp"

namespace trivela::experiment {

/// The paper's two tournaments, old table and `stopped`, new table and `moving`, with one common error of the eye that
/// made the old table: balls so much over the target's height seemed to pass at it, at every distance and in every
/// match.
struct BiasPoint {
  double eye_bias_m = 0.0;
  ArmTally older;
  ArmTally newer;
};

/// Which of two assumptions bring the pair of efficiencies to the paper's 52 and 76 %: the common error, and whether
/// blocked kicks count as outside or stand apart.
std::string pair_text(const std::vector<BiasPoint>& points, Law law);
nlohmann::ordered_json pair_json(const std::vector<BiasPoint>& points);

}  // namespace trivela::experiment
