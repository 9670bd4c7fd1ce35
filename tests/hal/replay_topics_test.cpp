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
  log.row("referee", {"robot_id", "seq", "t_ns", "half", "playing", "possession_id"},
          {Int{3}, seq, t_ns, Int{2}, Int{1}, Int{17}});
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
    EXPECT_TRUE(topics.next_t_ns());
    all.push_back(*topics.next());
    order.emplace_back(all.back().t_ns, all.back().what.index());
  }
  EXPECT_FALSE(topics.next());
  EXPECT_THAT(order, testing::ElementsAre(std::pair(20, 0U), std::pair(20, 1U), std::pair(20, 2U), std::pair(30, 1U),
                                          std::pair(40, 0U), std::pair(50, 2U)));

  const auto& seen = std::get<sim::VisionFrame>(all[0].what);
  EXPECT_EQ(seen.t_exposure_ns, 15);
  EXPECT_EQ(seen.pose->x_m, 1.0);
  EXPECT_EQ(seen.pose->heading_rad, 0.5);
  EXPECT_EQ(seen.ball->y_m, 0.25);
  EXPECT_EQ(seen.opponent->x_m, 3.0);
  const auto& unseen = std::get<sim::VisionFrame>(all[4].what);
  EXPECT_FALSE(unseen.pose);
  EXPECT_TRUE(unseen.ball);
  EXPECT_FALSE(unseen.opponent);
  EXPECT_EQ(std::get<sim::FlightFrame>(all[1].what).ball->z_m, 0.75);
  EXPECT_FALSE(std::get<sim::FlightFrame>(all[3].what).ball);
  const auto& word = std::get<sim::RefereeWord>(all[5].what);
  EXPECT_EQ(word.half, 2);
  EXPECT_TRUE(word.playing);
  EXPECT_EQ(word.possession_id, 17U);
  EXPECT_EQ(all[5].seq, 2);
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
