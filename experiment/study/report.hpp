#pragma once

#include <cstdint>
#include <string>

#include "evaluator/render/json_values.hpp"
#include "experiment/study/effects.hpp"

namespace trivela::experiment {

using evaluator::Json;

/// "87.8 (87.1 to 88.5)" of `scale` times the numbers by fmt's `form`; "87.8 (-)" without an interval, "-" without a
/// value.
std::string effect_text(const Effect& effect, double scale, const std::string& form);

/// A share in per cent.
std::string share_text(const Effect& effect);

/// A difference of shares in percentage points, always with its sign.
std::string points_text(const Effect& effect);

/// {"value": ..., "ci": [lo, hi]}; null without a value, "ci" null without an interval.
Json json_of(const Effect& effect);

/// What a study played.
struct StudyPlayed {
  std::string scenario{};  ///< name of its file, and what was changed of it
  std::uint64_t seed = 1;
  std::uint32_t matches = 0;
  std::uint32_t possessions = 0;              ///< opportunities a match
  std::size_t calibrations = 0;               ///< 0: robot files
  Measure efficiency = Measure::kEfficiency;  ///< kUnblocked: blocked kicks stand apart
  bool keeper = false;                        ///< goals mean something
};

/// A sentence where the simulator's truth lies outside of what the labels say: a robot's file that is far from the
/// robot makes wrong labels. Empty: nowhere.
std::string label_warning(const std::string& arm, const ArmTally& observed);

}  // namespace trivela::experiment
