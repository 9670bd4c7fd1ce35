#include "robot/referee/match_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

using hal::refbox::Command;
using hal::refbox::CommandKind;
using hal::refbox::Side;
using enum hal::refbox::CommandKind;

class MatchStateTest : public testing::Test {
 protected:
  MatchStateTest() { state.connected(); }

  msg::Referee after(CommandKind kind, Side side = Side::kBoth) {
    state.command({kind, side, {}}, now_ns);
    return word();
  }
  msg::Referee word() const { return state.message(now_ns); }
  void play() {
    after(kFirstHalf);
    EXPECT_TRUE(after(kStart).playing);
  }

  MatchState state;
  std::int64_t now_ns = 100 * kSecond_ns;
};

TEST_F(MatchStateTest, NobodyPlaysBeforeAStart) {
  EXPECT_FALSE(word().playing);
  EXPECT_EQ(word().stage, msg::STAGE_UNKNOWN);
  EXPECT_EQ(word().command_counter, 0U);
  EXPECT_TRUE(std::isnan(word().half_time_s));
}

TEST_F(MatchStateTest, StartPlaysAndStopStops) {
  EXPECT_TRUE(after(kStart).playing);
  EXPECT_FALSE(after(kStop).playing);
  EXPECT_EQ(word().command_counter, 2U);
}

TEST_F(MatchStateTest, ASetPieceStartsNothingStopsNothingAndIsAnnouncedUntilTheStart) {
  const std::vector<std::pair<CommandKind, msg::Restart>> pieces{
      {kKickOff, msg::RESTART_KICKOFF},   {kFreeKick, msg::RESTART_FREEKICK}, {kGoalKick, msg::RESTART_GOALKICK},
      {kThrowIn, msg::RESTART_THROWIN},   {kCorner, msg::RESTART_CORNER},     {kPenalty, msg::RESTART_PENALTY},
      {kDropBall, msg::RESTART_DROP_BALL}};
  for (const auto& [kind, restart] : pieces) {
    for (const bool playing : {false, true}) {
      after(playing ? kStart : kStop);
      EXPECT_EQ(after(kind, Side::kOurs).playing, playing);
      EXPECT_EQ(word().restart, restart);
      EXPECT_TRUE(word().ours);
      EXPECT_FALSE(after(kind, Side::kTheirs).ours);
      EXPECT_EQ(word().restart, restart);
      EXPECT_TRUE(after(kStart).playing);
      EXPECT_EQ(word().restart, msg::RESTART_NONE);
    }
  }
}

TEST_F(MatchStateTest, AStopTakesTheSetPieceBack) {
  after(kCorner, Side::kOurs);
  EXPECT_EQ(after(kStop).restart, msg::RESTART_NONE);
  EXPECT_FALSE(word().ours);
}

TEST_F(MatchStateTest, GoalsCountForTheirTeamAndNeverBelowNone) {
  after(kGoal, Side::kOurs);
  after(kGoal, Side::kTheirs);
  EXPECT_EQ(after(kGoal, Side::kTheirs).goals_other, 2U);
  EXPECT_EQ(word().goals_own, 1U);
  after(kSubGoal, Side::kOurs);
  EXPECT_EQ(after(kSubGoal, Side::kOurs).goals_own, 0U);
  EXPECT_EQ(after(kGoal, Side::kBoth).goals_own + word().goals_other, 2);
}

TEST_F(MatchStateTest, GoesThroughAMatchWithOvertime) {
  struct Part {
    CommandKind begin;
    msg::GameStage stage;
    std::uint8_t half;
    CommandKind end;
    msg::GameStage then;
  };
  for (const Part& part : {Part{kFirstHalf, msg::STAGE_FIRST_HALF, 1, kHalfTime, msg::STAGE_HALF_TIME},
                           Part{kSecondHalf, msg::STAGE_SECOND_HALF, 2, kEndGame, msg::STAGE_FULL_TIME},
                           Part{kFirstHalfOvertime, msg::STAGE_FIRST_OVERTIME, 3, kHalfTime, msg::STAGE_OVERTIME_BREAK},
                           Part{kSecondHalfOvertime, msg::STAGE_SECOND_OVERTIME, 4, kEndGame, msg::STAGE_PENALTIES}}) {
    EXPECT_EQ(after(part.begin).stage, part.stage);
    EXPECT_EQ(word().half, part.half);
    EXPECT_FALSE(word().playing) << "the first word of a half starts nothing";
    EXPECT_TRUE(after(kStart).playing);
    EXPECT_EQ(after(part.end).stage, part.then);
    EXPECT_FALSE(word().playing) << "the end of a part stops";
  }
  EXPECT_EQ(after(kGameOver).stage, msg::STAGE_GAME_OVER);
}

TEST_F(MatchStateTest, TheEndOfAPartWithoutANameEndsTheOneUnderWay) {
  after(kFirstHalf);
  EXPECT_EQ(after(kEndPart).stage, msg::STAGE_HALF_TIME);
  EXPECT_EQ(after(kEndPart).stage, msg::STAGE_HALF_TIME) << "no part is under way";
}

TEST_F(MatchStateTest, TheClockOfAHalfRunsFromItsFirstStartThroughStops) {
  EXPECT_TRUE(std::isnan(after(kFirstHalf).half_time_s));
  after(kStart);
  now_ns += 7 * kSecond_ns;
  EXPECT_DOUBLE_EQ(after(kStop).half_time_s, 7.0);
  now_ns += 3 * kSecond_ns;
  EXPECT_DOUBLE_EQ(after(kStart).half_time_s, 10.0);
  EXPECT_TRUE(std::isnan(after(kHalfTime).half_time_s));
  after(kSecondHalf);
  now_ns += kSecond_ns;
  EXPECT_DOUBLE_EQ(after(kStart).half_time_s, 0.0);
}

TEST_F(MatchStateTest, AHalfMayBeNamedAfterItsStart) {
  after(kStart);
  now_ns += kSecond_ns;
  EXPECT_TRUE(after(kFirstHalf).playing) << "only a stop stops";
  EXPECT_DOUBLE_EQ(word().half_time_s, 0.0);
}

TEST_F(MatchStateTest, ALostConnectionStopsUntilANewStartAndKeepsTheScore) {
  play();
  after(kGoal, Side::kOurs);
  after(kKickOff, Side::kTheirs);
  state.disconnected();
  EXPECT_FALSE(word().playing);
  EXPECT_EQ(word().restart, msg::RESTART_NONE);
  state.connected();
  EXPECT_FALSE(word().playing);
  for (const CommandKind kind : {kWelcome, kFirstHalf, kKickOff, kGoal, kIsAlive}) EXPECT_FALSE(after(kind).playing);
  EXPECT_EQ(word().goals_own, 1U);
  EXPECT_EQ(word().stage, msg::STAGE_FIRST_HALF);
  EXPECT_TRUE(after(kStart).playing);
}

TEST_F(MatchStateTest, AResetBeforeTheConnectionsEndSetsTheMatchBack) {
  after(kWelcome);
  play();
  after(kGoal, Side::kOurs);
  EXPECT_FALSE(after(kReset).playing);
  EXPECT_EQ(word().goals_own, 1U) << "it may be for somebody whom the box turns away";
  after(kReset);
  state.disconnected();
  EXPECT_EQ(word().goals_own, 0U);
  EXPECT_EQ(word().stage, msg::STAGE_PRE_GAME);
  EXPECT_EQ(word().half, 1U);
  EXPECT_EQ(word().command_counter, 6U) << "it goes on";
}

TEST_F(MatchStateTest, AResetForSomebodyElseOnlyStops) {
  play();
  after(kGoal, Side::kOurs);
  after(kReset);
  EXPECT_TRUE(after(kStart).playing);
  state.disconnected();
  EXPECT_EQ(word().goals_own, 1U);
  EXPECT_EQ(word().stage, msg::STAGE_FIRST_HALF);
}

TEST_F(MatchStateTest, BeingTurnedAwayKeepsTheMatch) {
  play();
  after(kGoal, Side::kTheirs);
  state.disconnected();
  state.connected();
  after(kReset);
  state.disconnected();
  EXPECT_EQ(word().goals_other, 1U);
  EXPECT_EQ(word().stage, msg::STAGE_FIRST_HALF);
}

TEST_F(MatchStateTest, ParkStops) {
  play();
  EXPECT_FALSE(after(kPark).playing);
}

TEST_F(MatchStateTest, WhoJoinsLateKnowsNoStageUntilItIsNamed) {
  EXPECT_EQ(after(kStart).stage, msg::STAGE_UNKNOWN);
  EXPECT_EQ(after(kHalfTime).stage, msg::STAGE_UNKNOWN) << "of play or of overtime";
  EXPECT_EQ(after(kEndGame).stage, msg::STAGE_FULL_TIME);
}

TEST_F(MatchStateTest, OtherCommandsOnlyCount) {
  play();
  const msg::Referee before = word();
  for (const CommandKind kind : {kWelcome, kTestModeOn, kTestModeOff, kYellowCard, kRedCard, kDoubleYellow, kRepair,
                                 kRepairEnd, kSubstitution, kIsAlive}) {
    const msg::Referee now = after(kind, Side::kOurs);
    EXPECT_TRUE(now.playing);
    EXPECT_EQ(now.stage, before.stage);
    EXPECT_EQ(now.restart, before.restart);
  }
  EXPECT_EQ(word().command_counter, before.command_counter + 10);
}

// Whatever is said in whatever order: nobody plays but after a START, with no stopping word since.
TEST_F(MatchStateTest, PlayIsAlwaysByAStart) {
  std::mt19937 random{11};
  bool may_play = false;
  for (int i = 0; i < 100'000; ++i) {
    const auto draw = random() % (hal::refbox::kCommandNames.size() + 1);
    if (draw == hal::refbox::kCommandNames.size()) {
      state.disconnected();
      may_play = false;
      state.connected();
    } else {
      const auto kind = static_cast<CommandKind>(draw);
      after(kind, static_cast<Side>(random() % 3));
      if (kind == kStart) may_play = true;
      for (const CommandKind stops : {kStop, kHalfTime, kEndGame, kEndPart, kGameOver, kPark, kReset})
        if (kind == stops) may_play = false;
    }
    ASSERT_EQ(word().playing, may_play) << i;
  }
}

}  // namespace
}  // namespace trivela::robot
