#include "emulators/refbox/referee_output.hpp"

#include <array>

namespace trivela::hal::refbox {
namespace {

constexpr std::array kFirstWords{CommandKind::kFirstHalf, CommandKind::kSecondHalf, CommandKind::kFirstHalfOvertime,
                                 CommandKind::kSecondHalfOvertime};
constexpr std::array kLastWords{CommandKind::kHalfTime, CommandKind::kEndGame, CommandKind::kEndPart,
                                CommandKind::kEndPart};
static_assert(kFirstWords.size() == RefereeOutput::kMostHalves && kLastWords.size() == kFirstWords.size());

}  // namespace

void RefereeOutput::say_new_half(const sim::RefereeState& word, std::vector<BoxCommand>& words) const {
  if (said_) words.push_back({.kind = kLastWords.at(static_cast<std::size_t>(said_->half) - 1)});
  words.push_back({.kind = kFirstWords.at(static_cast<std::size_t>(word.half) - 1)});
}

std::vector<BoxCommand> RefereeOutput::receive(const sim::RefereeState& word) {
  const bool new_half = !said_ || word.half != said_->half;
  const bool new_possession = new_half || word.possession_id != said_->possession_id;
  std::vector<BoxCommand> words;
  const bool played = said_ && said_->playing;
  const bool stopped = played && (!word.playing || new_possession);
  if (stopped) words.push_back({.kind = CommandKind::kStop});
  if (!played || stopped) {
    for (; goals_said_ < word.goals; ++goals_said_) words.push_back({.kind = CommandKind::kGoal, .team = our_team_});
  }
  if (new_half) say_new_half(word, words);
  if (new_possession)
    words.push_back({.kind = new_half ? CommandKind::kKickOff : CommandKind::kFreeKick, .team = our_team_});
  if (word.playing && (!played || stopped)) words.push_back({.kind = CommandKind::kStart});
  said_ = word;
  return words;
}

std::vector<BoxCommand> RefereeOutput::over() {
  return {{.kind = CommandKind::kStop}, {.kind = CommandKind::kGameOver}};
}

}  // namespace trivela::hal::refbox
