#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace trivela::refbox {

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

/// Whether two words have the same letters, digits and signs: case, spaces and underscores do not count.
constexpr bool same_word(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  const auto skip = [](std::string_view& text) {
    while (text.starts_with(' ') || text.starts_with('_')) text.remove_prefix(1);
  };
  for (skip(a), skip(b); !a.empty() && !b.empty(); skip(a), skip(b)) {
    if (lower(a.front()) != lower(b.front())) return false;
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  return a.empty() && b.empty();
}

/// Words that are no kind's name: of the league's jsonCommands.pdf ("GAME_OVER" is GAMEOVER by same_word()), of
/// Hibikino-Musashi's test server, and those that the boxes of 2020 and later write into their logs in place of the
/// name (RoboCup-MSL/RefBox, mslrb2015/Comms.pde, its table of descriptions).
struct CommandAlias {
  std::string_view word;
  CommandKind kind;
};
inline constexpr std::array<CommandAlias, 10> kOtherWords{{{"WELCOM", CommandKind::kWelcome},
                                                           {"Reset Game", CommandKind::kReset},
                                                           {"1st half", CommandKind::kFirstHalf},
                                                           {"2nd half", CommandKind::kSecondHalf},
                                                           {"Overtime 1st half", CommandKind::kFirstHalfOvertime},
                                                           {"Overtime 2nd half", CommandKind::kSecondHalfOvertime},
                                                           {"Goal+", CommandKind::kGoal},
                                                           {"Goal-", CommandKind::kSubGoal},
                                                           {"Repair ended", CommandKind::kRepairEnd},
                                                           {"Dropped Ball", CommandKind::kDropBall}}};

/// The kind of a word, as the box's protocol or its log has it. None: nobody knows it.
constexpr std::optional<CommandKind> kind_of(std::string_view word) {
  for (const CommandAlias& other : kOtherWords) {
    if (same_word(word, other.word)) return other.kind;
  }
  for (std::size_t i = 0; i < kCommandNames.size(); ++i) {
    if (same_word(word, kCommandNames[i])) return static_cast<CommandKind>(i);
  }
  return std::nullopt;
}

/// The colour that the protocol before 2016 knows a team by: magenta in lower case, cyan in upper case.
enum class Colour : std::uint8_t { kCyan, kMagenta };

/// What a letter of that protocol says.
struct CommandLetter {
  CommandKind kind{};
  std::optional<Colour> team{};  ///< none: for both

  friend bool operator==(const CommandLetter&, const CommandLetter&) = default;
};

/// A letter of that protocol. None: no such letter. Source: wiki of RoboCup-MSL/RefBox, "Basestation-Protocol" (to
/// version 1.5.0), and logs of 2016 and 2018.
std::optional<CommandLetter> word_of_letter(char letter);

/// The commands after which a START puts the ball into play.
constexpr bool is_restart(CommandKind kind) { return kind >= CommandKind::kKickOff && kind <= CommandKind::kDropBall; }

/// The part of the match that a command begins, 1 to 4 (3 and 4: overtime); none: it begins none.
constexpr std::optional<int> begun_part(CommandKind kind) {
  if (kind < CommandKind::kFirstHalf || kind > CommandKind::kSecondHalfOvertime) return std::nullopt;
  return static_cast<int>(kind) - static_cast<int>(CommandKind::kFirstHalf) + 1;
}

/// A part of the match, or all of it, is over: nobody plays until the next one begins.
constexpr bool ends_part(CommandKind kind) {
  return (kind >= CommandKind::kHalfTime && kind <= CommandKind::kPark) || kind == CommandKind::kReset;
}

}  // namespace trivela::refbox
