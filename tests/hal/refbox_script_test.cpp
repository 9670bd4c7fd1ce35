#include "emulators/refbox/box_act.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trivela::hal::refbox {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& script) {
  try {
    read_box_script(script, "s.txt");
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TEST(BoxScript, IsALineAnAct) {
  const auto steps = read_box_script(
      "# a kick-off\n0 FIRST_HALF\n\n1.5 KICKOFF left  # ours\r\n1.5 START\n3 fault split\n4 SUBSTITUTION right 5\n",
      "s.txt");
  ASSERT_EQ(steps.size(), 5U);
  EXPECT_EQ(steps[0].at_s, 0.0);
  EXPECT_EQ(std::get<BoxCommand>(steps[0].act), (BoxCommand{CommandKind::kFirstHalf, {}, {}}));
  EXPECT_EQ(std::get<BoxCommand>(steps[1].act), (BoxCommand{CommandKind::kKickOff, 0, {}}));
  EXPECT_EQ(steps[2].at_s, 1.5);
  EXPECT_EQ(std::get<BoxFault>(steps[3].act), BoxFault::kSplit);
  EXPECT_EQ(std::get<BoxCommand>(steps[4].act), (BoxCommand{CommandKind::kSubstitution, 1, 5}));
  EXPECT_TRUE(read_box_script("", "s.txt").empty());
}

TEST(BoxScript, KnowsEveryCommandAndEveryFault) {
  for (const std::string_view word : kCommandNames) EXPECT_EQ(refusal("0 " + std::string(word)), "") << word;
  for (const BoxFaultWord& word : kBoxFaults)
    EXPECT_EQ(std::get<BoxFault>(read_box_script("0 fault " + std::string(word.name), "s.txt").at(0).act), word.fault);
}

TEST(BoxScript, WhatIsWrongIsNamedWithFileLineAndValue) {
  EXPECT_EQ(refusal("0 START\nsoon STOP"), "s.txt:2: \"soon\" is no time in seconds");
  EXPECT_EQ(refusal("nan STOP"), "s.txt:1: \"nan\" is no time in seconds");
  EXPECT_EQ(refusal("-1 STOP"), "s.txt:1: \"-1\" is no time in seconds");
  EXPECT_EQ(refusal("2 START\n1 STOP"), "s.txt:2: \"1\" is before the line above it, 2");
  EXPECT_EQ(refusal("1 DANCE"), "s.txt:1: \"DANCE\" is no command");
  EXPECT_EQ(refusal("1"), "s.txt:1: \"1\" has no command");
  EXPECT_EQ(refusal("1 GOAL ours"), "s.txt:1: \"ours\" is neither left nor right");
  EXPECT_EQ(refusal("1 IS_ALIVE left 256"), "s.txt:1: \"256\" is no robot's number");
  EXPECT_EQ(refusal("1 IS_ALIVE left 1 2"), "s.txt:1: \"2\" is one word too many");
  EXPECT_EQ(refusal("1 fault fire"), "s.txt:1: \"fire\" is no fault");
  EXPECT_EQ(refusal("1 fault"), "s.txt:1: \"fault\" wants the name of one fault");
}

TEST(BoxLog, OfLettersHasItsTeamsByColour) {
  const auto steps = read_box_log(
      "New BaseStation @ 172.16.74.27\n"
      "Connection from 172.16.74.27 accepted - Magenta\n"
      "1529326805014,06:53(00:00),Pre-Game,k,MAGENTA Kickoff\n"
      "1529326813080,07:01(00:00),Pre-Game,1,1st half\r\n"
      "1529326813081,07:01(00:00),1st Half,s,START\n"
      "1529326831941,00:18(00:15),1st Half - STOP,A,CYAN Goal+\n",
      "a.msl");
  ASSERT_EQ(steps.size(), 4U);
  EXPECT_EQ(steps[0].at_s, 0.0);
  EXPECT_EQ(std::get<BoxCommand>(steps[0].act), (BoxCommand{CommandKind::kKickOff, 1, {}}));
  EXPECT_EQ(std::get<BoxCommand>(steps[1].act), (BoxCommand{CommandKind::kFirstHalf, {}, {}}));
  EXPECT_DOUBLE_EQ(steps[2].at_s, 8.067);
  EXPECT_EQ(std::get<BoxCommand>(steps[3].act), (BoxCommand{CommandKind::kGoal, 0, {}}));
}

TEST(BoxLog, OfObjectsHasItsTeamsByTheirGroups) {
  const auto steps =
      read_box_log(R"(1000,00:00(00:00),Pre-Game,{"command":"KICKOFF","targetTeam":"224.16.32.74"},null)"
                   "\n"
                   R"(900,00:00(00:00),1st Half,{"command":"START","targetTeam":""},null)"
                   "\n"
                   R"(3000,00:02(00:02),1st Half - STOP,{"targetTeam":"224.16.32.63","command":"GOAL"},null)"
                   "\n4000,00:03(00:02),1st Half - STOP,CORNER,Corner\n5000,x,y,DANCE,?\n",
                   "b.msl");
  ASSERT_EQ(steps.size(), 4U);
  EXPECT_EQ(std::get<BoxCommand>(steps[0].act), (BoxCommand{CommandKind::kKickOff, 0, {}}));
  EXPECT_EQ(steps[1].at_s, 0.0) << "its clock was set back";
  EXPECT_EQ(std::get<BoxCommand>(steps[2].act), (BoxCommand{CommandKind::kGoal, 1, {}}));
  EXPECT_EQ(std::get<BoxCommand>(steps[3].act), (BoxCommand{CommandKind::kCorner, {}, {}}));
}

TEST(BoxLog, OfWordsHasItsTeamsByTheirNames) {
  const auto steps = read_box_log(
      "1721384160000,03:00(00:00),Pre-Game,Kickoff,TeamA\n"
      "1721384170001,00:00(00:00),1st Half,START,\n"
      "1721384205000,00:35(00:30),1st Half - STOP,Throw In,TeamB\n"
      "1721384256000,01:26(01:05),1st Half - STOP,Repair,robotID:3,TeamB\n",
      "e.msl");
  ASSERT_EQ(steps.size(), 4U);
  EXPECT_EQ(std::get<BoxCommand>(steps[0].act), (BoxCommand{CommandKind::kKickOff, 0, {}}));
  EXPECT_EQ(std::get<BoxCommand>(steps[1].act), (BoxCommand{CommandKind::kStart, {}, {}}));
  EXPECT_EQ(std::get<BoxCommand>(steps[2].act), (BoxCommand{CommandKind::kThrowIn, 1, {}}));
  EXPECT_EQ(std::get<BoxCommand>(steps[3].act), (BoxCommand{CommandKind::kRepair, 1, 3}));
}

TEST(BoxLog, TimesFarApartAreASpanLikeAnyOther) {
  const auto steps = read_box_log("-9223372036854775808,a,b,START\n9223372036854775807,a,b,STOP\n", "d.msl");
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].at_s, 0.0);
  EXPECT_NEAR(steps[1].at_s, 1.8446744073709552e16, 1e3);
}

TEST(BoxLog, WithoutACommandIsNone) {
  for (const char* const text : {"", "hello\n", "1,2,3\n", ",,,s\n", "1,,,", "9223372036854775808,,,s,"}) {
    EXPECT_THROW(read_box_log(text, "c.msl"), std::runtime_error) << text;
  }
}

TEST(BoxKeys, AreTheOldLettersOfTheLeftTeamInUpperCaseAndOfTheRightOneInLowerCase) {
  const auto said = [](char key) { return std::get<BoxCommand>(act_of_key(key).value()); };
  EXPECT_EQ(said('s'), (BoxCommand{CommandKind::kStart, {}, {}}));
  EXPECT_EQ(said('S'), (BoxCommand{CommandKind::kStop, {}, {}}));
  EXPECT_EQ(said(' '), (BoxCommand{CommandKind::kStop, {}, {}}));
  EXPECT_EQ(said('K'), (BoxCommand{CommandKind::kKickOff, 0, {}}));
  EXPECT_EQ(said('k'), (BoxCommand{CommandKind::kKickOff, 1, {}}));
  EXPECT_EQ(said('E'), (BoxCommand{CommandKind::kEndPart, {}, {}}));
}

TEST(BoxKeys, ReachEveryFaultAndNothingElseUnderAnUnknownKey) {
  std::size_t faults = 0;
  for (int key = 0; key < 256; ++key) {
    const auto act = act_of_key(static_cast<char>(key));
    faults += act && std::holds_alternative<BoxFault>(*act) ? 1 : 0;
  }
  EXPECT_EQ(faults, kBoxFaults.size());
  for (const char key : {'?', '\n', '\0', '5', '~'}) EXPECT_FALSE(act_of_key(key)) << key;
}

}  // namespace
}  // namespace trivela::hal::refbox
