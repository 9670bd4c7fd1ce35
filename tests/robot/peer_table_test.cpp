#include "robot/team/peer_table.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "idl/messages.hpp"
#include "robot/team/team_summary.hpp"
#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

constexpr std::int64_t kS = 1'000'000'000;

/// A state that `from` sent at `sent_ns` of its clock.
msg::TeamState said(PeerTable& from, std::int64_t sent_ns) {
  msg::TeamState state{};
  from.fill(state, sent_ns);
  return state;
}

TEST(PeerTable, EchoesEachOtherInTurn) {
  PeerTable ours{3, 0}, base{0, 0}, five{5, 0};
  EXPECT_FALSE(said(ours, kS).echoes) << "nobody was heard";
  ours.received(said(base, 10), kS);
  ours.received(said(five, 20), kS);
  std::vector<int> turns;
  for (int i = 0; i < 4; ++i) turns.push_back(said(ours, kS + i).echo_robot_id);
  EXPECT_THAT(turns, testing::ElementsAre(5, 0, 5, 0));
}

TEST(PeerTable, AnOldStateThatCameLateIsNoNews) {
  PeerTable ours{1, 0}, other{2, 0};
  const auto first = said(other, kS), second = said(other, kS + 100 * kMs);
  EXPECT_TRUE(ours.received(second, kS));
  EXPECT_FALSE(ours.received(first, kS + 1));
  EXPECT_FALSE(ours.received(second, kS + 2)) << "nor one that comes twice";
}

TEST(PeerTable, AnotherLifeBeginsAnew) {
  PeerTable ours{1, 0}, other{2, 5}, reborn{2, 9};
  for (int i = 0; i < 5; ++i) ours.received(said(other, kS + i), kS + i);
  EXPECT_TRUE(ours.received(said(reborn, 10), kS + 10)) << "its numbers begin with 1";
}

TEST(PeerTable, OurOwnNumberFromAnotherLifeIsATwin) {
  PeerTable ours{1, 7}, twin{1, 8};
  EXPECT_FALSE(ours.is_duplicate(said(ours, kS)));
  const auto word = said(twin, kS);
  EXPECT_TRUE(ours.is_duplicate(word));
  EXPECT_FALSE(ours.received(word, kS));
}

TEST(PeerTable, AnEchoOfAnEarlierLifeIsNoMeasurement) {
  PeerTable before{1, 0}, now{1, 10 * kS}, other{2, 0};
  other.received(said(before, 9 * kS), 9 * kS);
  now.received(said(other, 11 * kS), 11 * kS);
  EXPECT_FALSE(now.offset(2, 11 * kS));
}

class RefereeOfTheBase : public testing::Test {
 protected:
  // The base is 50 s ahead; each message takes 2 ms.
  void meet(std::int64_t now_ns) {
    base.received(said(robot, now_ns), now_ns + 50 * kS + 2 * kMs);
    robot.received(said(base, now_ns + 50 * kS + 2 * kMs), now_ns + 4 * kMs);
  }
  static msg::Referee word(std::int64_t t_ns, bool playing) {
    msg::Referee word{};
    word.t_ns = t_ns;
    word.playing = playing;
    word.command_counter = 4;
    return word;
  }
  PeerTable robot{3, 0}, base{0, 0};
};

TEST_F(RefereeOfTheBase, IsNotHeardBeforeItsClockIsKnown) {
  EXPECT_FALSE(robot.own_referee(word(51 * kS, true), kS + 5 * kMs));
  meet(kS);
  EXPECT_TRUE(robot.own_referee(word(51 * kS, true), kS + 5 * kMs));
}

TEST_F(RefereeOfTheBase, HasOurNumberAndOurClockAndIsNeverYoungerThanItIs) {
  meet(kS);
  const auto ours = robot.own_referee(word(51 * kS, true), kS + 5 * kMs);
  ASSERT_TRUE(ours);
  EXPECT_EQ(ours->robot_id, 3);
  EXPECT_EQ(ours->seq, 1u);
  EXPECT_TRUE(ours->playing);
  EXPECT_EQ(ours->command_counter, 4u);
  EXPECT_LE(ours->t_ns, kS);
  EXPECT_GT(ours->t_ns, kS - 3 * kMs) << "older by no more than what the clock is not known to";
  const auto ahead = robot.own_referee(word(60 * kS, true), kS + 6 * kMs);
  ASSERT_TRUE(ahead);
  EXPECT_EQ(ahead->t_ns, kS + 6 * kMs) << "nothing is of the future";
}

TEST_F(RefereeOfTheBase, AStopIsNotUndoneByAnOlderWordThatCameLate) {
  meet(kS);
  EXPECT_TRUE(robot.own_referee(word(51 * kS + 100 * kMs, false), kS + 5 * kMs));
  EXPECT_FALSE(robot.own_referee(word(51 * kS, true), kS + 5 * kMs));
  EXPECT_FALSE(robot.own_referee(word(std::numeric_limits<std::int64_t>::max(), true), kS + 5 * kMs));
  EXPECT_FALSE(robot.own_referee(word(std::numeric_limits<std::int64_t>::min(), true), kS + 5 * kMs));
}

TEST(TeamSummary, WhatIsSilentIsAnAlarmAndNoNumber) {
  const msg::TeamSummary nothing = robot_summary({}, 10 * kS);
  EXPECT_EQ(alarm_words(nothing.alarms),
            "world_state silent, vision silent, kick_decision silent, kicker silent, referee silent");
  EXPECT_TRUE(std::isnan(nothing.x_m));
  EXPECT_FALSE(nothing.placed);
  TeamInputs inputs;
  inputs.world.word.emplace();
  inputs.world.word->x_m = 1.5;
  inputs.world.word->playing = true;
  inputs.kicker.word.emplace();
  inputs.kicker.word->fault = msg::FAULT_COIL;
  inputs.kicker.word->charge = 0.5;
  inputs.referee.word.emplace();
  inputs.world.received_ns = inputs.kicker.received_ns = inputs.referee.received_ns = inputs.vision_received_ns =
      inputs.drive_received_ns = 10 * kS;
  const msg::TeamSummary well = robot_summary(inputs, 10 * kS + kAlarmSilence_ns);
  EXPECT_EQ(alarm_words(well.alarms), "kicker fault");
  EXPECT_EQ(well.x_m, 1.5);
  EXPECT_EQ(well.charge, 0.5);
  EXPECT_EQ(well.reason, msg::REASON_NO_BALL);
  EXPECT_EQ(alarm_words(robot_summary(inputs, 11 * kS + 1).alarms), alarm_words(nothing.alarms));
}

TEST(TeamSummary, ComesBackAsTheBeliefThatTheRefereeBoxIsTold) {
  msg::TeamHeard received{};
  received.other_robot_id = 4;
  received.t_ns = 12;
  EXPECT_FALSE(world_of(received)) << "it does not know where it is";
  received.summary.placed = received.summary.ball_known = true;
  received.summary.x_m = -2.0;
  received.summary.ball_y_m = 3.0;
  const auto world = world_of(received);
  ASSERT_TRUE(world);
  EXPECT_EQ(world->robot_id, 4);
  EXPECT_EQ(world->t_ns, 12);
  EXPECT_EQ(world->x_m, -2.0);
  EXPECT_EQ(world->ball_y_m, 3.0);
}

TEST(TeamSummary, AlarmsOfANewerVersionAreToldByNumber) {
  EXPECT_EQ(alarm_words(0), "");
  EXPECT_EQ(alarm_words(1u << 20 | 1u), "world_state silent, alarms 0x100000");
}

}  // namespace
}  // namespace trivela::robot
