#include "idl/refbox/command.hpp"

namespace trivela::refbox {
namespace {

struct Letter {
  char letter;  // of a team: as magenta's
  CommandKind kind;
};

using enum CommandKind;
constexpr std::array kCommonLetters{Letter{'S', kStop},
                                    Letter{'s', kStart},
                                    Letter{'W', kWelcome},
                                    Letter{'Z', kReset},
                                    Letter{'U', kTestModeOn},
                                    Letter{'u', kTestModeOff},
                                    Letter{'1', kFirstHalf},
                                    Letter{'2', kSecondHalf},
                                    Letter{'h', kHalfTime},
                                    Letter{'3', kFirstHalfOvertime},
                                    Letter{'4', kSecondHalfOvertime},
                                    Letter{'e', kEndGame},
                                    Letter{'z', kGameOver},
                                    Letter{'L', kPark},
                                    Letter{'N', kDropBall}};
constexpr std::array kTeamLetters{Letter{'a', kGoal},       Letter{'d', kSubGoal},  Letter{'k', kKickOff},
                                  Letter{'f', kFreeKick},   Letter{'g', kGoalKick}, Letter{'t', kThrowIn},
                                  Letter{'c', kCorner},     Letter{'p', kPenalty},  Letter{'o', kRepair},
                                  Letter{'y', kYellowCard}, Letter{'r', kRedCard},  Letter{'b', kDoubleYellow}};

}  // namespace

std::optional<CommandLetter> word_of_letter(char letter) {
  for (const Letter& known : kCommonLetters) {
    if (known.letter == letter) return CommandLetter{known.kind};
  }
  const bool cyan = letter >= 'A' && letter <= 'Z';
  const char lower = cyan ? static_cast<char>(letter - 'A' + 'a') : letter;
  for (const Letter& known : kTeamLetters) {
    if (known.letter == lower) return CommandLetter{known.kind, cyan ? Colour::kCyan : Colour::kMagenta};
  }
  return std::nullopt;
}

}  // namespace trivela::refbox
