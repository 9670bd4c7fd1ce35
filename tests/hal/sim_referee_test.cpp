#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "emulators/sim/sim_messages.hpp"
#include "tests/sim/played_match.hpp"

namespace trivela::sim {
namespace {

TEST(RefereeState, CountsEachStartAndStopOfPlayOnce) {
  const Record record = play({}, 3, 2, 0.2, idle);
  RefereeState before = record.sensors.front().referee;
  EXPECT_EQ(before.commands, 1U) << "the stop that a match begins with";
  int changes = 0;
  for (const Sensors& now : record.sensors) {
    if (now.referee.playing != before.playing) {
      EXPECT_EQ(now.referee.commands, before.commands + 1) << now.t_ns;
      ++changes;
    }
    EXPECT_GE(now.referee.commands, before.commands);
    before = now.referee;
  }
  EXPECT_GT(changes, 10);
}

TEST(RefereeState, TheClockOfAHalfRunsFromItsFirstStartThroughStops) {
  const Record record = play({}, 3, 2, 0.2, idle);
  std::int64_t began_ns = -1;
  int half = 0, stops = 0;
  for (const Sensors& now : record.sensors) {
    if (now.referee.half != half) {
      EXPECT_FALSE(now.referee.half_s) << "half " << now.referee.half << " has not begun to play";
      half = now.referee.half;
      began_ns = -1;
    }
    if (began_ns < 0 && now.referee.playing) began_ns = now.t_ns;
    if (began_ns < 0) continue;
    ASSERT_TRUE(now.referee.half_s);
    EXPECT_NEAR(*now.referee.half_s, static_cast<double>(now.t_ns - began_ns) * 1e-9, 1e-9);
    stops += now.referee.playing ? 0 : 1;
  }
  EXPECT_EQ(half, 2);
  EXPECT_GT(stops, 0);
}

TEST(RefereeState, AGoalIsABallOnTargetThatNobodySaved) {
  Scenario scenario = alone();
  scenario.possession.goal_distance_max_m = 5.0;
  scenario.possession.aim_error_sd_rad = 0.05;
  const Record record = play(scenario, 7, 2, 1.0, fire_at_once(16));
  const auto goals = std::ranges::count_if(
      record.kicks, [](const KickTruth& kick) { return kick.outcome == kicking::Outcome::kOnTarget && !kick.saved; });
  EXPECT_GT(goals, 0);
  EXPECT_LT(goals, std::ssize(record.kicks));
  EXPECT_EQ(record.sensors.back().referee.goals, goals) << "over both halves";
  std::uint32_t before = 0;
  for (const Sensors& now : record.sensors) {
    EXPECT_GE(now.referee.goals, before);
    before = now.referee.goals;
  }
}

TEST(RefereeMessage, AnnouncesASetPieceOfOursAsAKickOffAndThenAsFreeKicks) {
  RefereeState word{.half = 2, .possession_id = 1, .half_s = {}, .set_piece = true};
  EXPECT_EQ(hal::referee_message(7, word).restart, msg::RESTART_KICKOFF);
  EXPECT_TRUE(hal::referee_message(7, word).ours);
  word.possession_id = 2;
  EXPECT_EQ(hal::referee_message(7, word).restart, msg::RESTART_FREEKICK);
}

TEST(RefereeMessage, SaysTheStageOfTheHalfAndAnnouncesNothing) {
  const RefereeState word{.half = 2, .playing = true, .possession_id = 9, .goals = 3, .commands = 4, .half_s = 1.5};
  const msg::Referee message = hal::referee_message(7, word);
  EXPECT_EQ(message.t_ns, 7);
  EXPECT_EQ(message.half, 2);
  EXPECT_TRUE(message.playing);
  EXPECT_EQ(message.possession_id, 9U);
  EXPECT_EQ(message.stage, msg::STAGE_SECOND_HALF);
  EXPECT_EQ(message.restart, msg::RESTART_NONE);
  EXPECT_FALSE(message.ours);
  EXPECT_EQ(message.goals_own, 3);
  EXPECT_EQ(message.goals_other, 0);
  EXPECT_EQ(message.command_counter, 4U);
  EXPECT_EQ(message.half_time_s, 1.5);
  RefereeState other;
  EXPECT_TRUE(std::isnan(hal::referee_message(0, other).half_time_s));
  other.half = 5;
  EXPECT_EQ(hal::referee_message(0, other).stage, msg::STAGE_UNKNOWN) << "an experiment's fifth half has no name";
  other.goals = 70'000;
  EXPECT_EQ(hal::referee_message(0, other).goals_own, 65'535);
}

}  // namespace
}  // namespace trivela::sim
