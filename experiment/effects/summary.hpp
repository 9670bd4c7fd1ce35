#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "evaluator/log/tally_book.hpp"
#include "experiment/effects/effects.hpp"

namespace trivela::experiment {

/// A sentence where the simulator's truth lies outside of what the labels say: a robot's file that is far from the
/// robot makes wrong labels. Empty: nowhere.
std::string label_warning(const std::string& arm, const ArmTally& observed);

/// A row of a book.
MatchTally tally_of(const evaluator::log::MatchCounts& counts);

/// What a book of tallies says of its arms, on the matches that all of them have.
struct Summary {
  struct Arm {
    std::string name;
    ArmTally matches;
  };
  std::vector<Arm> arms;                      ///< in the order in which they were asked for
  std::int64_t matches = 0;                   ///< that all arms have
  std::int64_t asked = 0;                     ///< of each arm, when the book is finished
  std::size_t evenings = 0;                   ///< of calibration; 0: robot files
  Measure efficiency = Measure::kEfficiency;  ///< or, with blocked kicks apart, kUnblocked
};

/// Throws std::invalid_argument where the arms have no match in common.
Summary summary_of(const evaluator::log::Book& book, bool blocked_apart);

/// The arm comes first, so that the others are compared with it; false: there is none of this name.
bool put_first(Summary& summary, const std::string& arm);

/// Arms, their differences from the first one with 95 % intervals, and what a book of tallies cannot say.
std::string to_text(const Summary& summary);
nlohmann::ordered_json to_json(const Summary& summary);

/// A line an arm.
std::string to_csv(const Summary& summary);

}  // namespace trivela::experiment
