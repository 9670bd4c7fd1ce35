#include "hal/replay/replay_topics.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/hal/recorded_log.hpp"

namespace trivela::hal {
namespace {

using Int = std::int64_t;
const double kNone = std::nan("");

void vision(RecordedLog& log, Int seq, Int t_ns, bool seen) {
  log.row("vision_frames",
          {"robot_id", "seq", "t_ns", "t_exposure_ns", "pose_seen", "x_m", "y_m", "heading_rad", "ball_seen",
           "ball_x_m", "ball_y_m", "opponent_seen", "opponent_x_m", "opponent_y_m"},
          {Int{3}, seq, t_ns, t_ns - 5, Int{seen}, seen ? 1.0 : kNone, seen ? 2.0 : kNone, seen ? 0.5 : kNone, Int{1},
           0.125, 0.25, Int{seen}, seen ? 3.0 : kNone, seen ? 4.0 : kNone});
}

void flight(RecordedLog& log, Int seq, Int t_ns, bool seen) {
  log.row("flight_frames",
          {"robot_id", "seq", "t_ns", "t_exposure_ns", "ball_seen", "ball_x_m", "ball_y_m", "ball_z_m"},
          {Int{3}, seq, t_ns, t_ns - 4, Int{seen}, seen ? 1.0 : kNone, seen ? 2.0 : kNone, seen ? 0.75 : kNone});
}

void referee(RecordedLog& log, Int seq, Int t_ns) {
  log.row("referee",
          {"robot_id", "seq", "t_ns", "half", "playing", "possession_id", "stage", "restart", "ours", "goals_own",
           "goals_other", "command_counter", "half_time_s"},
          {Int{3}, seq, t_ns, Int{2}, Int{1}, Int{17}, std::string{"second_half"}, std::string{"corner"}, Int{1},
           Int{4}, Int{5}, Int{6}, kNone});
}

TEST(ReplayTopics, MergesTheTablesByTime) {
  RecordedLog log;
  vision(log, 1, 20, true);
  vision(log, 2, 40, false);
  flight(log, 1, 20, true);
  flight(log, 2, 30, false);
  referee(log, 1, 20);
  referee(log, 2, 50);
  log.close();
  ReplayTopics topics{ReplayLog::open(log.file(), 3)};
  std::vector<std::pair<Int, std::size_t>> order;
  std::vector<ReplayedSample> all;
  while (!topics.ended()) {
    const auto t_ns = topics.next_t_ns();
    ASSERT_TRUE(t_ns);
    all.push_back(*topics.next());
    order.emplace_back(*t_ns, all.back().index());
  }
  EXPECT_FALSE(topics.next());
  EXPECT_THAT(order, testing::ElementsAre(std::pair(20, 0U), std::pair(20, 1U), std::pair(20, 2U), std::pair(30, 1U),
                                          std::pair(40, 0U), std::pair(50, 2U)));

  const auto& seen = std::get<msg::VisionFrame>(all[0]);
  EXPECT_EQ(seen.robot_id, 3);
  EXPECT_EQ(seen.seq, 1U);
  EXPECT_EQ(seen.t_ns, 20);
  EXPECT_EQ(seen.t_exposure_ns, 15);
  EXPECT_TRUE(seen.pose_seen && seen.ball_seen && seen.opponent_seen);
  EXPECT_EQ(seen.x_m, 1.0);
  EXPECT_EQ(seen.heading_rad, 0.5);
  EXPECT_EQ(seen.ball_y_m, 0.25);
  EXPECT_EQ(seen.opponent_x_m, 3.0);
  const auto& unseen = std::get<msg::VisionFrame>(all[4]);
  EXPECT_FALSE(unseen.pose_seen || unseen.opponent_seen);
  EXPECT_TRUE(std::isnan(unseen.x_m) && std::isnan(unseen.opponent_y_m));
  EXPECT_TRUE(unseen.ball_seen);
  EXPECT_EQ(std::get<msg::FlightFrame>(all[1]).ball_z_m, 0.75);
  EXPECT_FALSE(std::get<msg::FlightFrame>(all[3]).ball_seen);
  const auto& word = std::get<msg::Referee>(all[5]);
  EXPECT_EQ(word.half, 2);
  EXPECT_TRUE(word.playing);
  EXPECT_EQ(word.possession_id, 17U);
  EXPECT_EQ(word.seq, 2U);
  EXPECT_EQ(word.stage, msg::STAGE_SECOND_HALF);
  EXPECT_EQ(word.restart, msg::RESTART_CORNER);
  EXPECT_TRUE(word.ours);
  EXPECT_EQ(word.goals_other, 5);
  EXPECT_TRUE(std::isnan(word.half_time_s));
}

TEST(ReplayTopics, OfARobotThatIsNotInTheLogAreEmpty) {
  RecordedLog log;
  referee(log, 1, 20);
  log.close();
  EXPECT_TRUE(ReplayTopics{ReplayLog::open(log.file(), 4)}.ended());
}

TEST(ReplayLog, NamesWhatIsMissing) {
  RecordedLog log;
  log.close();
  EXPECT_THROW(ReplayLog::open(log.file().parent_path() / "none.db", 3), std::runtime_error);
  try {
    ReplayLog::open(log.file(), 3, 12345);
    FAIL() << "was accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("match.db: holds no session 12345"));
  }
}

}  // namespace
}  // namespace trivela::hal
