#include "hal/refbox/words.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace trivela::hal::refbox {
namespace {

using testing::HasSubstr;
using namespace std::string_literals;

constexpr const char* kGroup = "224.16.32.39";

Command command_of(const ParsedCommand& word) {
  if (const auto* none = std::get_if<NoCommand>(&word)) ADD_FAILURE() << none->why;
  return std::holds_alternative<Command>(word) ? std::get<Command>(word) : Command{};
}
Command command_of(const std::string& object) { return command_of(read_object(object, kGroup)); }

std::string why(const ParsedCommand& word) {
  EXPECT_TRUE(std::holds_alternative<NoCommand>(word)) << "it is a command";
  return std::holds_alternative<NoCommand>(word) ? std::get<NoCommand>(word).why : "";
}
std::string why(const std::string& object) { return why(read_object(object, kGroup)); }

TEST(RefboxWords, EveryCommandOfTheLeagueIsKnown) {
  for (std::size_t i = 0; i < kCommandNames.size(); ++i) {
    const auto kind = static_cast<CommandKind>(i);
    EXPECT_EQ(command_of(fmt::format(R"({{"command":"{}","targetTeam":""}})", name(kind))),
              (Command{kind, Side::kBoth, {}}));
  }
}

TEST(RefboxWords, WhatOtherBoxesSayIsUnderstood) {
  EXPECT_EQ(command_of(R"({"command":"GAME_OVER","targetTeam":""})"s).kind, CommandKind::kGameOver);
  EXPECT_EQ(command_of(R"({"command":" WELCOME","targetTeam":""})"s).kind, CommandKind::kWelcome);
  EXPECT_FALSE(command_of(R"({"command":"WELCOME","targetTeam":""})"s).emulated);
  EXPECT_TRUE(command_of(R"({"command":"WELCOME","emulated":true,"targetTeam":""})"s).emulated);
  EXPECT_FALSE(command_of(R"({"command":"START","emulated":true,"targetTeam":""})"s).emulated);
  EXPECT_FALSE(command_of(R"({"command":"WELCOME","emulated":"yes","targetTeam":""})"s).emulated);
  EXPECT_EQ(command_of(R"({"command":"WELCOM","targetTeam":""})"s).kind, CommandKind::kWelcome);
}

TEST(RefboxWords, KeysComeInAnyOrderWithOthersBesideThem) {
  EXPECT_EQ(command_of(R"( {"x":[1,{}],"targetTeam":"224.16.32.39","robotID":3,"command":"SUBSTITUTION"} )"s),
            (Command{CommandKind::kSubstitution, Side::kOurs, 3}));
}

TEST(RefboxWords, ATargetIsBothTeamsOursOrTheirs) {
  const auto side = [](const std::string& target) {
    return command_of(R"({"command":"KICKOFF","targetTeam":)" + target + "}").side;
  };
  EXPECT_EQ(side(R"("")"), Side::kBoth);
  EXPECT_EQ(side("null"), Side::kBoth);
  EXPECT_EQ(command_of(R"({"command":"KICKOFF"})"s).side, Side::kBoth);
  EXPECT_EQ(side(R"("224.16.32.39")"), Side::kOurs);
  EXPECT_EQ(side(R"("224.16.32.39:1")"), Side::kOurs);
  EXPECT_EQ(side(R"("224.16.32.3")"), Side::kTheirs);
  EXPECT_EQ(side(R"("224.16.32.39:2")"), Side::kTheirs);
  EXPECT_EQ(side(R"(":1")"), Side::kTheirs);
  EXPECT_THAT(why(R"({"command":"KICKOFF","targetTeam":39})"s), HasSubstr("a targetTeam that is no text"));
}

TEST(RefboxWords, AStopIsEverybodysWhateverElseItSays) {
  for (const char* const target : {R"("")", R"("224.16.32.63")", "39", "null", "[]"}) {
    EXPECT_EQ(command_of(fmt::format(R"({{"command":"STOP","targetTeam":{}}})", target)),
              (Command{CommandKind::kStop, Side::kBoth, {}}));
  }
}

TEST(RefboxWords, ARobotIsAWholeNumberOrNobody) {
  const auto robot = [](const std::string& id) {
    return command_of(R"({"command":"IS_ALIVE","targetTeam":"","robotID":)" + id + "}").robot_id;
  };
  EXPECT_EQ(robot("0"), 0);
  EXPECT_EQ(robot("255"), 255);
  for (const char* const id : {"-1", "256", "1.5", "\"1\"", "null", "18446744073709551615"})
    EXPECT_EQ(robot(id), std::nullopt) << id;
}

TEST(RefboxWords, WhatIsNoCommandIsSaidWithItsBeginning) {
  EXPECT_EQ(why(R"({"status":"connected"})"s), R"(an object without a command: {"status":"connected"})");
  EXPECT_THAT(why(R"({"command":5})"s), HasSubstr("an object without a command"));
  EXPECT_THAT(why(R"({"command":"KICKOF","targetTeam":""})"s), HasSubstr("a command that nobody knows"));
  EXPECT_THAT(why(R"({"command":"START)"s), HasSubstr("what is no JSON"));
  EXPECT_THAT(why("START"s), HasSubstr("what is no JSON"));
  EXPECT_THAT(why("[1]"s), HasSubstr("JSON that is no object"));
  EXPECT_THAT(why("\xff\x1b[2J\"" + std::string(5000, 'x')), testing::SizeIs(testing::Lt(600U)));
  EXPECT_THAT(why("\x1b[2J"s), testing::Not(HasSubstr("\x1b"))) << "a terminal would obey it";
}

TEST(RefboxWords, GarbageIsNoCommand) {
  std::mt19937 random{7};
  const std::string good = R"({"command":"START","targetTeam":""})";
  int refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string bad = good;
    for (int hits = 1 + static_cast<int>(random() % 3); hits > 0; --hits)
      bad[random() % bad.size()] = static_cast<char>(random());
    const ParsedCommand word = read_object(bad, kGroup);  // whatever it is, it ends
    refused += std::holds_alternative<NoCommand>(word) ? 1 : 0;
  }
  EXPECT_GT(refused, 10'000);
}

TEST(RefboxWords, DeepNestingIsNoCommand) {
  EXPECT_THAT(why(std::string(90'000, '[')), HasSubstr("no JSON"));
  EXPECT_THAT(why(std::string(45'000, '[') + std::string(45'000, ']')), HasSubstr("no object"));
}

TEST(RefboxLetters, AreForOurColourByTheirCase) {
  const std::vector<std::pair<char, CommandKind>> letters{
      {'a', CommandKind::kGoal},       {'d', CommandKind::kSubGoal},  {'k', CommandKind::kKickOff},
      {'f', CommandKind::kFreeKick},   {'g', CommandKind::kGoalKick}, {'t', CommandKind::kThrowIn},
      {'c', CommandKind::kCorner},     {'p', CommandKind::kPenalty},  {'o', CommandKind::kRepair},
      {'y', CommandKind::kYellowCard}, {'r', CommandKind::kRedCard},  {'b', CommandKind::kDoubleYellow}};
  for (const auto& [letter, kind] : letters) {
    const char upper = static_cast<char>(letter - 'a' + 'A');
    EXPECT_EQ(command_of(read_letter(letter, Colour::kMagenta)), (Command{kind, Side::kOurs, {}}));
    EXPECT_EQ(command_of(read_letter(letter, Colour::kCyan)), (Command{kind, Side::kTheirs, {}}));
    EXPECT_EQ(command_of(read_letter(upper, Colour::kCyan)), (Command{kind, Side::kOurs, {}}));
    EXPECT_EQ(command_of(read_letter(upper, Colour::kMagenta)), (Command{kind, Side::kTheirs, {}}));
  }
}

TEST(RefboxLetters, OfBothTeamsMeanOneThingEach) {
  const std::vector<std::pair<char, CommandKind>> letters{{'S', CommandKind::kStop},
                                                          {'s', CommandKind::kStart},
                                                          {'W', CommandKind::kWelcome},
                                                          {'Z', CommandKind::kReset},
                                                          {'U', CommandKind::kTestModeOn},
                                                          {'u', CommandKind::kTestModeOff},
                                                          {'1', CommandKind::kFirstHalf},
                                                          {'2', CommandKind::kSecondHalf},
                                                          {'3', CommandKind::kFirstHalfOvertime},
                                                          {'4', CommandKind::kSecondHalfOvertime},
                                                          {'h', CommandKind::kHalfTime},
                                                          {'e', CommandKind::kEndGame},
                                                          {'z', CommandKind::kGameOver},
                                                          {'L', CommandKind::kPark},
                                                          {'N', CommandKind::kDropBall}};
  for (const auto& [letter, kind] : letters)
    EXPECT_EQ(command_of(read_letter(letter, Colour::kCyan)), (Command{kind, Side::kBoth, {}}));
  for (const char letter : {'x', 'X', '5', '{', '\x1b', 'n'})
    EXPECT_THAT(why(read_letter(letter, Colour::kCyan)), HasSubstr("a letter that nobody knows"));
}

TEST(RefboxWordStream, ReadsObjectsAcrossReads) {
  CommandStream objects{{Protocol::kJson, kGroup, Colour::kCyan}};
  EXPECT_TRUE(objects.add(R"({"command":"KICK)").empty());
  const auto words =
      objects.add(R"(OFF","targetTeam":"224.16.32.39"})"s + '\0' + R"({"command":"START","targetTeam":""})" + '\0');
  ASSERT_EQ(words.size(), 2U);
  EXPECT_EQ(command_of(words[0]), (Command{CommandKind::kKickOff, Side::kOurs, {}}));
  EXPECT_EQ(command_of(words[1]), (Command{CommandKind::kStart, Side::kBoth, {}}));
  const auto overlong = objects.add(std::string(kLongestObject_B + 1, ' ') + '\0');
  ASSERT_EQ(overlong.size(), 1U);
  EXPECT_THAT(why(overlong[0]), HasSubstr("over 100000 bytes"));
}

TEST(RefboxWordStream, WhoHearsLettersObeysNoneOfAnObject) {
  CommandStream letters{{Protocol::kLetters, "", Colour::kMagenta}};
  EXPECT_EQ(letters.add("S").size(), 1U);
  EXPECT_FALSE(letters.wrong_protocol());
  EXPECT_EQ(letters.add(R"(S{"command":"SUBSTITUTION","targetTeam":"","s)").size(), 1U);
  EXPECT_THAT(std::string{letters.wrong_protocol().value()}, HasSubstr("refbox.letters = false"));
  EXPECT_TRUE(letters.add("s").empty());
}

TEST(RefboxWordStream, WhoHearsObjectsSaysOnceThatItBeganWithNone) {
  CommandStream objects{{Protocol::kJson, kGroup, Colour::kCyan}};
  EXPECT_TRUE(objects.add("\0\n"s).empty());
  const auto words = objects.add("W");
  ASSERT_EQ(words.size(), 1U);
  EXPECT_THAT(why(words[0]), HasSubstr("refbox.letters = true"));
  EXPECT_TRUE(objects.add("1Ks").empty());
}

TEST(RefboxWordStream, ReadsLettersAcrossReads) {
  CommandStream letters{{Protocol::kLetters, "", Colour::kMagenta}};
  const auto told = letters.add("k\r\n\0s"s);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(command_of(told[0]), (Command{CommandKind::kKickOff, Side::kOurs, {}}));
  EXPECT_EQ(command_of(told[1]).kind, CommandKind::kStart);
}

}  // namespace
}  // namespace trivela::hal::refbox
