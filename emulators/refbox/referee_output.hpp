#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "emulators/refbox/box_act.hpp"
#include "sim/sensors.hpp"

namespace trivela::hal::refbox {

/// What a box says so that those who hear it know the referee's word of a simulated match, in which our team has every
/// set piece: the first word of a half, STOP, GOAL (while play is stopped, as a referee does), KICKOFF
/// for a half's first possession, FREEKICK for each further one, START, and HALF_TIME, END_GAME or END_PART once the
/// next half begins.
class RefereeOutput {
 public:
  /// A match has at most so many halves: the box has no words for more.
  static constexpr int kMostHalves = 4;

  /// `our_team`: 0 the left one, 1 the right one.
  explicit RefereeOutput(std::size_t our_team = 0) : our_team_(our_team) {}

  /// What is new in `word` against the last one, in the order in which it is to be said. Half 1 to kMostHalves.
  std::vector<BoxCommand> receive(const sim::RefereeState& word);

  /// What is said when the match is over.
  static std::vector<BoxCommand> over();

 private:
  void say_new_half(const sim::RefereeState& word, std::vector<BoxCommand>& words) const;

  std::size_t our_team_;
  std::optional<sim::RefereeState> said_;
  std::uint32_t goals_said_ = 0;
};

}  // namespace trivela::hal::refbox
