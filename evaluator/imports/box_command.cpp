#include "evaluator/imports/box_command.hpp"

#include <algorithm>
#include <array>

namespace trivela::evaluator::imports {
namespace {

using enum BoxCommand;

struct CommandName {
  BoxCommand command;
  const char* name;
  char letter;      ///< of the one-letter protocol; 0: it has none
  bool for_a_team;  ///< upper case is cyan, lower case magenta; otherwise the letter is as it stands
};

constexpr std::array kCommands{
    CommandName{kStart, "START", 's', false},
    CommandName{kStop, "STOP", 'S', false},
    CommandName{kFirstHalf, "FIRST_HALF", '1', false},
    CommandName{kSecondHalf, "SECOND_HALF", '2', false},
    CommandName{kFirstOvertime, "FIRST_HALF_OVERTIME", '3', false},
    CommandName{kSecondOvertime, "SECOND_HALF_OVERTIME", '4', false},
    CommandName{kHalfTime, "HALF_TIME", 'h', false},
    CommandName{kEndPart, "END_PART", 0, false},
    CommandName{kEndGame, "END_GAME", 'e', false},
    CommandName{kGameOver, "GAMEOVER", 'z', false},
    CommandName{kPark, "PARK", 'L', false},
    CommandName{kGoal, "GOAL", 'a', true},
    CommandName{kGoalTaken, "SUBGOAL", 'd', true},
    CommandName{kKickoff, "KICKOFF", 'k', true},
    CommandName{kFreeKick, "FREEKICK", 'f', true},
    CommandName{kGoalKick, "GOALKICK", 'g', true},
    CommandName{kThrowIn, "THROWIN", 't', true},
    CommandName{kCorner, "CORNER", 'c', true},
    CommandName{kPenalty, "PENALTY", 'p', true},
    CommandName{kDropBall, "DROP_BALL", 'N', false},
    CommandName{kYellowCard, "YELLOW_CARD", 'y', true},
    CommandName{kRedCard, "RED_CARD", 'r', true},
    CommandName{kDoubleYellow, "DOUBLE_YELLOW", 'b', true},
    CommandName{kRepair, "REPAIR", 'o', true},
    CommandName{kRepairEnd, "REPAIR_END", 0, true},
    CommandName{kSubstitution, "SUBSTITUTION", 0, true},
    CommandName{kIsAlive, "IS_ALIVE", 0, true},
    CommandName{kWelcome, "WELCOME", 'W', false},
    CommandName{kReset, "RESET", 'Z', false},
    CommandName{kTestModeOn, "TESTMODE_ON", 'U', false},
    CommandName{kTestModeOff, "TESTMODE_OFF", 'u', false},
};

char lower_of(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

std::optional<BoxWord> word_of_letter(char letter) {
  for (const CommandName& known : kCommands) {
    if (known.letter == 0) continue;
    if (!known.for_a_team && known.letter == letter) return BoxWord{known.command, BoxSide::kBoth};
    if (known.for_a_team && known.letter == lower_of(letter))
      return BoxWord{known.command, letter == known.letter ? BoxSide::kMagenta : BoxSide::kCyan};
  }
  return std::nullopt;
}

std::optional<BoxCommand> command_of_name(std::string_view name) {
  while (name.starts_with(' ')) name.remove_prefix(1);  // " WELCOME"
  if (name == "GAME_OVER") return kGameOver;
  if (name == "WELCOM") return kWelcome;
  const auto known = std::ranges::find_if(kCommands, [&](const CommandName& c) { return c.name == name; });
  return known == kCommands.end() ? std::nullopt : std::optional(known->command);
}

const char* name_of(BoxCommand command) { return std::ranges::find(kCommands, command, &CommandName::command)->name; }

bool is_restart(BoxCommand command) { return command >= kKickoff && command <= kDropBall; }

std::optional<int> begun_part(BoxCommand command) {
  if (command < kFirstHalf || command > kSecondOvertime) return std::nullopt;
  return static_cast<int>(command) - static_cast<int>(kFirstHalf) + 1;
}

bool ends_part(BoxCommand command) { return (command >= kHalfTime && command <= kPark) || command == kReset; }

}  // namespace trivela::evaluator::imports
