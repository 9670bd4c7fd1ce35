#pragma once

#include <functional>
#include <string>
#include <vector>

#include "evaluator/log/tally_book.hpp"
#include "experiment/factorial/play.hpp"

namespace trivela::experiment {

/// All that the matches of an arm depend on but their number, as text.
std::string arm_text(const sim::Scenario& scenario, const Arm& arm, const PlayPlan& plan);

/// What was played, and what is known now.
struct KeptPlay {
  std::vector<ArmTally> arms;  ///< by match; what is not known is empty
  bool whole = false;          ///< every match of every arm is known
};

/// Plays the matches of the book's range that it does not have and keeps them there, arms by the name "what:
/// NAME". `progress(done, all)`, of what is to be played, is called before the first match, then from one thread at a
/// time; where it throws, nothing more is played.
KeptPlay play_kept(const sim::Scenario& scenario, const std::vector<Arm>& arms, const PlayPlan& plan,
                   const std::string& what, const evaluator::log::MatchRange& range, evaluator::log::TallyBook& book,
                   const std::function<void(std::size_t done, std::size_t all)>& progress);

}  // namespace trivela::experiment
