#include "robot/referee/set_piece_clock.hpp"

#include <gtest/gtest.h>

#include "robot/referee/match_state.hpp"
#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

using hal::refbox::CommandKind;
using hal::refbox::Side;

class SetPieceClockTest : public testing::Test {
 protected:
  SetPieceClockTest() { state.connected(); }

  /// The box says so, and the clock hears it at once and again 100 ms later.
  void box_says(CommandKind kind, Side side = Side::kBoth) {
    state.command({kind, side, {}}, now_ns);
    clock.receive(state.message(now_ns));
    clock.receive(state.message(now_ns));
  }
  /// What is left after a time with the ball in the handler or not.
  std::optional<double> left_s_after(double time_s, bool possession) {
    now_ns += static_cast<std::int64_t>(time_s * 1e9);
    clock.receive(state.message(now_ns));
    msg::WorldState world{};
    world.t_ns = now_ns;
    world.possession = possession;
    return clock.left_s(world);
  }

  SetPieceClock clock{7.0};
  MatchState state;
  std::int64_t now_ns = 100 * kSecond_ns;
};

TEST_F(SetPieceClockTest, RunsFromTheStartOfOurSetPieceUntilItsTimeIsOver) {
  box_says(CommandKind::kFreeKick, Side::kOurs);
  EXPECT_FALSE(left_s_after(3.0, false)) << "announced only";
  box_says(CommandKind::kStart);
  EXPECT_EQ(left_s_after(0.0, false), 7.0);
  EXPECT_EQ(left_s_after(2.0, true), 5.0);
  EXPECT_EQ(left_s_after(4.5, true), 0.5);
  EXPECT_FALSE(left_s_after(0.5, true)) << "the ball is anybody's";
  EXPECT_FALSE(left_s_after(0.0, true));
}

TEST_F(SetPieceClockTest, EndsWithTheBallThatWasHad) {
  box_says(CommandKind::kThrowIn, Side::kOurs);
  box_says(CommandKind::kStart);
  EXPECT_TRUE(left_s_after(1.0, false)) << "not there yet";
  EXPECT_TRUE(left_s_after(1.0, true));
  EXPECT_FALSE(left_s_after(0.5, false)) << "taken";
  EXPECT_FALSE(left_s_after(0.5, true)) << "the next possession is another matter";
}

TEST_F(SetPieceClockTest, EndsWithTheWhistleAndBeginsAnewWithTheNextOne) {
  box_says(CommandKind::kCorner, Side::kOurs);
  box_says(CommandKind::kStart);
  EXPECT_EQ(left_s_after(3.0, true), 4.0);
  box_says(CommandKind::kStop);
  EXPECT_FALSE(left_s_after(0.1, true));
  box_says(CommandKind::kStart);
  EXPECT_FALSE(left_s_after(0.1, true)) << "no set piece was announced";
  box_says(CommandKind::kStop);
  box_says(CommandKind::kFreeKick, Side::kOurs);
  box_says(CommandKind::kStart);
  EXPECT_EQ(left_s_after(1.0, true), 6.0);
}

TEST_F(SetPieceClockTest, IsNotForTheirsNorForNobodys) {
  box_says(CommandKind::kFreeKick, Side::kTheirs);
  box_says(CommandKind::kStart);
  EXPECT_FALSE(left_s_after(1.0, true));
  box_says(CommandKind::kStop);
  box_says(CommandKind::kDropBall);
  box_says(CommandKind::kStart);
  EXPECT_FALSE(left_s_after(1.0, true));
}

TEST_F(SetPieceClockTest, AnnouncedWhileTheGameIsOnItCountsFromItsStart) {
  box_says(CommandKind::kStart);
  box_says(CommandKind::kFreeKick, Side::kOurs);
  EXPECT_FALSE(left_s_after(1.0, true));
  box_says(CommandKind::kStart);
  EXPECT_EQ(left_s_after(1.0, true), 6.0);
}

TEST_F(SetPieceClockTest, SaysNothingWithoutTheRule) {
  clock = SetPieceClock{0.0};
  box_says(CommandKind::kKickOff, Side::kOurs);
  box_says(CommandKind::kStart);
  EXPECT_FALSE(left_s_after(0.0, true));
}

}  // namespace
}  // namespace trivela::robot
