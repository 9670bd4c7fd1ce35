#pragma once

#include <cstdint>
#include <optional>

#include "idl/messages.hpp"

namespace trivela::nodes {

/// When the simulator says its referee's word in real time: at each change and a period after the last one, as refbox
/// does for a referee box.
class RefereeRepeats {
 public:
  explicit RefereeRepeats(std::int64_t period_ns) : period_ns_(period_ns) {}

  /// Whether the word of the instant word.t_ns is to be said; it is the last one then.
  bool due(const msg::Referee& word) {
    if (said_ && word.t_ns - said_->t_ns < period_ns_ && same(word, *said_)) return false;
    said_ = word;
    return true;
  }

 private:
  /// But for the clock of the half.
  static bool same(const msg::Referee& a, const msg::Referee& b) {
    return a.half == b.half && a.playing == b.playing && a.possession_id == b.possession_id && a.stage == b.stage &&
           a.restart == b.restart && a.ours == b.ours && a.goals_own == b.goals_own && a.goals_other == b.goals_other &&
           a.command_counter == b.command_counter;
  }

  std::int64_t period_ns_;
  std::optional<msg::Referee> said_;
};

}  // namespace trivela::nodes
