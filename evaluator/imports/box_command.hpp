#pragma once

#include <optional>
#include <string_view>

namespace trivela::evaluator::imports {

/// What the Middle Size League's referee box commands.
enum class BoxCommand {
  kStart,
  kStop,
  kFirstHalf,
  kSecondHalf,
  kFirstOvertime,
  kSecondOvertime,
  kHalfTime,
  kEndPart,
  kEndGame,
  kGameOver,
  kPark,
  kGoal,
  kGoalTaken,
  kKickoff,
  kFreeKick,
  kGoalKick,
  kThrowIn,
  kCorner,
  kPenalty,
  kDropBall,
  kYellowCard,
  kRedCard,
  kDoubleYellow,
  kRepair,
  kRepairEnd,
  kSubstitution,
  kIsAlive,
  kWelcome,
  kReset,
  kTestModeOn,
  kTestModeOff
};

/// For whom: the box's left team is cyan (its log is `.A.msl`), the right one magenta (`.B.msl`).
enum class BoxSide { kBoth, kCyan, kMagenta };

/// A command of a log with its side; of one that was sent as JSON the side is that of its targetTeam.
struct BoxWord {
  BoxCommand command{};
  BoxSide side = BoxSide::kBoth;
};

/// The one-letter protocol, upper case for cyan and lower case for magenta where it is for one team. None: no such
/// letter. Source: wiki of RoboCup-MSL/RefBox (Basestation-Protocol), logs of 2016 and 2018.
std::optional<BoxWord> word_of_letter(char letter);

/// A command of the JSON protocol such as "THROWIN", with the spellings that boxes and clients differ in. None: no
/// such command. Source: RoboCup-MSL/RefBox mslrb2015/Comms.pde.
std::optional<BoxCommand> command_of_name(std::string_view name);

/// Its name in the JSON protocol.
const char* name_of(BoxCommand command);

/// The commands after which a START puts the ball into play.
bool is_restart(BoxCommand command);

/// The part of the match that a command begins, 1 to 4 (3 and 4: overtime); none: it begins none.
std::optional<int> begun_part(BoxCommand command);

/// A part of the match, or all of it, is over: nobody plays until the next one begins.
bool ends_part(BoxCommand command);

}  // namespace trivela::evaluator::imports
