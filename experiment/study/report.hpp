#pragma once

#include <cstdint>
#include <functional>
#include <optional>
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
  std::string scenario;  ///< name of its file, and what was changed of it
  std::uint64_t seed = 1;
  std::uint32_t matches = 0;
  std::uint32_t possessions = 0;              ///< opportunities a match
  std::size_t calibrations = 0;               ///< 0: robot files
  Measure efficiency = Measure::kEfficiency;  ///< kUnblocked: blocked kicks stand apart
  bool keeper = false;                        ///< goals mean something
};

/// "SIMULATED ... 400 matches of 45 opportunities, the same for every WHOM; ..."
std::string heading(const StudyPlayed& played, const std::string& whom);

/// A row of every study: what tells it from the others, and its matches.
struct StudyRow {
  struct Label {
    std::string key;   ///< "threshold"
    std::string text;  ///< empty: this row has none
    bool operator==(const Label&) const = default;
  };
  std::vector<Label> labels;  ///< of the same keys in all rows
  ArmTally matches;
  /// What the row changes of another one, where the study has such rows.
  std::optional<Effect> change{};

  const std::string& label(const std::string& key) const;
};

/// A column of a table for people.
struct StudyColumn {
  std::string heading;
  std::function<std::string(const StudyRow&)> cell;
};

StudyColumn label_column(const std::string& heading, const std::string& key);
StudyColumn kicks_column();
StudyColumn kicks_per_opportunity_column(const std::string& heading = "kicks/opp.");
StudyColumn share_column(const std::string& heading, Measure measure);

/// efficiency [%], on target/opp. [%] and, with a keeper, goals/opp. [%].
std::vector<StudyColumn> share_columns(const StudyPlayed& played);

std::string table_of(const std::vector<StudyRow>& rows, const std::vector<StudyColumn>& columns);

/// Labels; opportunities, kicks, on_target, blocked, bounced, goals; efficiency and per_opportunity, each with its
/// interval (_low, _high); change, where rows have it; simulated. Empty: there are too few kicks.
std::string csv_of(const std::vector<StudyRow>& rows, const StudyPlayed& played);

/// The head of every study's JSON, with "rows" of the same columns.
Json json_of(const std::string& study, const std::vector<StudyRow>& rows, const StudyPlayed& played);

double kicks_per_opportunity(const MatchTally& total);
double on_target_per_opportunity(const MatchTally& total);
double efficiency_of(const MatchTally& total);

/// A sentence where the simulator's truth lies outside of what the labels say: a robot's file that is far from the
/// robot makes wrong labels. Empty: nowhere.
std::string label_warning(const std::string& arm, const ArmTally& observed);

}  // namespace trivela::experiment
