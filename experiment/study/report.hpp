#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "evaluator/render/json_values.hpp"
#include "experiment/study/effects.hpp"

namespace trivela::experiment {

using evaluator::Json;

/// "87.8 (87.1 to 88.5)" by `number`; "87.8 (-)" without an interval, "-" without a value.
std::string effect_text(const Effect& effect, const std::function<std::string(double)>& number);

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

/// "SIMULATED ... 400 matches of 45 opportunities, the same for every WHOM; ..."
std::string heading(const StudyPlayed& played, const std::string& whom);

/// What tells a row of a study from the others: "threshold", with a text; empty: this row has none.
struct RowLabel {
  std::string key;
  std::string text;
};
using RowLabels = std::vector<RowLabel>;  ///< of the same keys in all rows of a study

/// A comparison of a row with others: its name as a path in JSON ("minus_first/efficiency"), and for people.
struct RowChange {
  std::string key;
  std::string heading;
};

/// An arm in a world of a study, and its matches.
struct StudyRow {
  RowLabels labels;
  ArmTally matches;
  std::vector<Effect> changes{};  ///< in the order of the study's; empty: it is what others are compared with

  const std::string& label(const std::string& key) const;
};

// Rows of a study in each form. `changes`: those that its rows may have.

/// Labels, kicks, kicks and shots on target per opportunity, efficiency, goals where there is a keeper, blocked of
/// kicks, bounced of those on target, changes.
std::string table_of(const std::vector<StudyRow>& rows, const std::vector<RowChange>& changes,
                     const StudyPlayed& played);

/// Labels; opportunities, kicks, on_target, blocked, bounced, goals; efficiency and per_opportunity, each with its
/// interval (_low, _high); changes; simulated. Empty: there are too few kicks.
std::string csv_of(const std::vector<StudyRow>& rows, const std::vector<RowChange>& changes, const StudyPlayed& played);

/// The head of every study's JSON, with "rows" of the same columns.
Json json_of(const std::string& study, const std::vector<StudyRow>& rows, const std::vector<RowChange>& changes,
             const StudyPlayed& played);

/// A sentence where the simulator's truth lies outside of what the labels say: a robot's file that is far from the
/// robot makes wrong labels. Empty: nowhere.
std::string label_warning(const std::string& arm, const ArmTally& observed);

}  // namespace trivela::experiment
