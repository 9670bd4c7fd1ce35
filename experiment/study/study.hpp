#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiment/play/arm.hpp"
#include "experiment/run/arms.hpp"
#include "experiment/study/effects.hpp"
#include "log/shards/study_results.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

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

/// A name for programs to read, a path in JSON, with its text. What tells a row from the others: "threshold", the text
/// empty where this row has none. A comparison of a row with others: "minus_first/efficiency", the text its heading.
struct KeyText {
  std::string key;
  std::string text;
};
using RowLabels = std::vector<KeyText>;  ///< of the same keys in all rows of a study

/// An arm in a world of a study, and its matches.
struct StudyRow {
  RowLabels labels;
  ArmTally matches;
  std::vector<Effect> changes{};  ///< in the order of the study's; empty: it is what others are compared with

  /// The text of a label that all rows of the study have.
  const std::string& label(const std::string& key) const { return std::ranges::find(labels, key, &KeyText::key)->text; }
};

/// A world of a study, and who plays it: all arms meet the same opportunities.
struct StudyWorld {
  std::string what;  ///< "opponents at 2 m"; tells it from the study's other worlds
  sim::Scenario scenario{};
  std::vector<Arm> arms{};
  std::vector<RowLabels> labels{};  ///< an arm's each; empty: there are none
  std::string why{};                ///< it is as it is

  void add(const Arm& arm, RowLabels labels_of_arm) {
    arms.push_back(arm);
    labels.push_back(std::move(labels_of_arm));
  }
};

/// What is known of the arms.
struct KnownPlay {
  std::vector<StudyRow> rows;  ///< by world and arm; a match that is not known is empty
  bool whole = false;          ///< every match of every arm is known
};

/// Plays the matches of the plan that `results` do not have, and keeps them there; arms have the name "what: NAME". All
/// arms of a match meet the same opportunities. The rows do not depend on the number of threads. `progress(done, all,
/// what)`, of what is to be played, is called before the first match, then by one thread at a time; where it throws,
/// nothing more is played or reported. Rethrows what it or a match throws.
KnownPlay play_missing(const std::vector<StudyWorld>& worlds, const PlayPlan& plan, log::StudyResults& results,
                       const std::function<void(std::size_t done, std::size_t all, const std::string& what)>& progress);

/// What a study says.
struct StudyReport {
  std::string text{};
  Json json = Json::object();
  std::string svg{};  ///< chart_of() some rows
  std::string csv{};
};

/// A question that is answered by arms in worlds.
struct Study {
  std::string name;                  ///< of its verb
  std::string whom;                  ///< meet the same opportunities: "cell"
  std::vector<KeyText> changes{};    ///< of its rows
  std::vector<StudyWorld> worlds{};  ///< the first is the scenario as it is
  /// Of this study's rows, in the order of worlds and arms; gives them their changes, and may sort them. Its text
  /// stands below the table of the rows, which the report adds with their CSV.
  std::function<StudyReport(const Study& study, std::vector<StudyRow>& rows, const StudyPlayed& played)> answer{};
};

/// The report on the rows.
StudyReport report_of(const Study& study, std::vector<StudyRow> rows, const StudyPlayed& played);

/// What the rows of a study depend on besides seed, matches and calibrations, as text: its first scenario and arms, of
/// each other world what is another value there.
std::string arguments_of(const Study& study);

/// Shares with their 95 % intervals, a panel a measure, then a panel a change, as SVG: a line for each thing that the
/// labels tell apart but `series`, which has a colour for each of its texts. The first forty lines.
std::string chart_of(const std::vector<StudyRow>& rows, const std::string& series, const std::vector<Measure>& measures,
                     const std::vector<KeyText>& changes);

}  // namespace trivela::experiment
