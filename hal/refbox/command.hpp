#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace trivela::hal::refbox {

/// What a referee box says, by the names of RoboCup-MSL/RefBox, mslrb2015/Comms.pde.
enum class CommandKind : std::uint8_t {
  kStop,
  kStart,
  kWelcome,
  kReset,
  kTestModeOn,
  kTestModeOff,
  kYellowCard,
  kRedCard,
  kDoubleYellow,
  kFirstHalf,
  kSecondHalf,
  kFirstHalfOvertime,
  kSecondHalfOvertime,
  kHalfTime,
  kEndGame,
  kEndPart,
  kGameOver,
  kPark,
  kGoal,
  kSubGoal,
  kKickOff,
  kFreeKick,
  kGoalKick,
  kThrowIn,
  kCorner,
  kPenalty,
  kDropBall,
  kRepair,
  kRepairEnd,
  kSubstitution,
  kIsAlive
};

inline constexpr std::array<std::string_view, 31> kCommandNames{"STOP",
                                                                "START",
                                                                "WELCOME",
                                                                "RESET",
                                                                "TESTMODE_ON",
                                                                "TESTMODE_OFF",
                                                                "YELLOW_CARD",
                                                                "RED_CARD",
                                                                "DOUBLE_YELLOW",
                                                                "FIRST_HALF",
                                                                "SECOND_HALF",
                                                                "FIRST_HALF_OVERTIME",
                                                                "SECOND_HALF_OVERTIME",
                                                                "HALF_TIME",
                                                                "END_GAME",
                                                                "END_PART",
                                                                "GAMEOVER",
                                                                "PARK",
                                                                "GOAL",
                                                                "SUBGOAL",
                                                                "KICKOFF",
                                                                "FREEKICK",
                                                                "GOALKICK",
                                                                "THROWIN",
                                                                "CORNER",
                                                                "PENALTY",
                                                                "DROP_BALL",
                                                                "REPAIR",
                                                                "REPAIR_END",
                                                                "SUBSTITUTION",
                                                                "IS_ALIVE"};
static_assert(kCommandNames.size() == std::size_t{static_cast<std::uint8_t>(CommandKind::kIsAlive)} + 1);

/// The league's word for a kind.
constexpr std::string_view name(CommandKind kind) { return kCommandNames[static_cast<std::size_t>(kind)]; }

/// Whom a command is for.
enum class Side : std::uint8_t { kBoth, kOurs, kTheirs };

/// One word of the referee box, as our team hears it.
struct Command {
  CommandKind kind = CommandKind::kStop;
  Side side = Side::kBoth;
  std::optional<int> robot_id{};  ///< the league's number of a robot: SUBSTITUTION and IS_ALIVE have one

  friend bool operator==(const Command&, const Command&) = default;
};

/// The kind of a word, spaces around it left out. Beside the code's names those that other boxes say: "GAME_OVER" (the
/// league's jsonCommands.pdf), "WELCOM" (Hibikino-Musashi's test server). None: nobody knows it.
constexpr std::optional<CommandKind> kind_of(std::string_view word) {
  while (word.starts_with(' ')) word.remove_prefix(1);
  while (word.ends_with(' ')) word.remove_suffix(1);
  if (word == "GAME_OVER") return CommandKind::kGameOver;
  if (word == "WELCOM") return CommandKind::kWelcome;
  for (std::size_t i = 0; i < kCommandNames.size(); ++i) {
    if (kCommandNames[i] == word) return static_cast<CommandKind>(i);
  }
  return std::nullopt;
}

}  // namespace trivela::hal::refbox
