// The ReKick backend with its thread, on a socket of packets in place of a CAN bus, against an emulated board.
#include <gtest/gtest.h>

#include "tests/hal/board_on_a_line.hpp"

namespace trivela::hal::rekick {
namespace {

using tests::kTimeout;
using tests::steady_ns;
using tests::until_armed;
using tests::until_link_fault;

constexpr std::int64_t kMs = 1'000'000;

class ReKickKickerTest : public testing::Test {
 protected:
  std::unique_ptr<Kicker> open() {
    const config::ReKickDevice settings{.port = emulator_.address()};
    return tests::kicker_on(std::make_unique<ReKick>(can::can_line(settings.port), settings));
  }
  bool wait_for_pulses(std::size_t n) {
    return emulator_.wait(kTimeout, [=](const EmulatedBoard& board) { return board.pulses().size() >= n; });
  }
  std::uint64_t kicks_told() {
    std::uint64_t told = 0;
    emulator_.with_board([&](const EmulatedBoard& board) { told = board.kicks_told(); });
    return told;
  }

  Emulator emulator_;
};

TEST_F(ReKickKickerTest, FiresOnceAtItsInstantAndNotBefore) {
  const auto kicker = open();
  ASSERT_TRUE(kicker->connected(kTimeout)) << kicker->status();
  const std::int64_t t_ns = steady_ns() + 60 * kMs;
  kicker->fire({1, 30.0, t_ns});
  ASSERT_TRUE(wait_for_pulses(1));
  tests::wait_for_looks(emulator_, 3);
  EXPECT_EQ(kicks_told(), 1u);
  emulator_.with_board([=](const EmulatedBoard& board) {
    EXPECT_EQ(board.pulses()[0].pulse_us, 1000);
    EXPECT_GE(board.pulses()[0].t_ns, t_ns);
  });
}

TEST_F(ReKickKickerTest, ChargesUpAndShowsWhatAKickTook) {
  const auto kicker = open();
  double full = 0.0;
  ASSERT_TRUE(tests::read_until(*kicker, [&](const KickerSample& sample) { return (full = sample.charge) >= 0.3; }));
  kicker->fire({1, 100.0, steady_ns()});
  EXPECT_TRUE(tests::read_until(*kicker, [](const KickerSample& sample) { return sample.charge < 0.2; }));
  EXPECT_TRUE(tests::read_until(*kicker, [](const KickerSample& sample) { return sample.charge > 0.25; }));
}

TEST_F(ReKickKickerTest, LostAnswersAndForeignFramesCostNoKickAndAddNone) {
  emulator_.with_board([](EmulatedBoard& board) {
    board.faults.lost_every = 2;
    board.faults.foreign_every = 3;
  });
  const auto kicker = open();
  ASSERT_TRUE(until_armed(*kicker)) << kicker->status();
  kicker->fire({1, 30.0, steady_ns()});
  ASSERT_TRUE(wait_for_pulses(1));
  tests::wait_for_looks(emulator_, 10);
  EXPECT_EQ(kicks_told(), 1u);
}

TEST_F(ReKickKickerTest, ItsErrorFlagIsAFaultForAsLongAsItStands) {
  const auto kicker = open();
  ASSERT_TRUE(until_armed(*kicker));
  emulator_.with_board([](EmulatedBoard& board) { board.faults.error = true; });
  EXPECT_TRUE(tests::read_until(*kicker, [](const auto& sample) { return sample.fault == KickerFault::kCharger; }));
  emulator_.with_board([](EmulatedBoard& board) { board.faults.error = false; });
  EXPECT_TRUE(tests::read_until(*kicker, [](const auto& sample) { return sample.fault == KickerFault::kNone; }));
}

TEST_F(ReKickKickerTest, NothingLeavesAfterItIsSafe) {
  const auto kicker = open();
  ASSERT_TRUE(kicker->connected(kTimeout));
  kicker->fire({1, 30.0, steady_ns() + 30 * kMs});
  kicker->make_safe();
  kicker->fire({2, 30.0, steady_ns()});
  tests::wait_for_looks(emulator_, 10);
  EXPECT_EQ(kicks_told(), 0u);
}

TEST_F(ReKickKickerTest, APulledCableIsALinkFaultAndIsOpenedAgainByItself) {
  const auto kicker = open();
  ASSERT_TRUE(until_armed(*kicker));
  emulator_.line().pull();
  EXPECT_TRUE(until_link_fault(*kicker));
  kicker->fire({1, 30.0, steady_ns()});
  EXPECT_TRUE(tests::until_status_says(*kicker, "kick 1 was not fired"));
  emulator_.line().plug();
  EXPECT_TRUE(until_armed(*kicker)) << kicker->status();
  tests::wait_for_looks(emulator_, 5);
  EXPECT_EQ(kicks_told(), 0u) << "nothing fires late";
  emulator_.with_board([](const EmulatedBoard& board) { EXPECT_EQ(board.voltages_told(), 2u) << "once on each line"; });
}

TEST_F(ReKickKickerTest, ABoardThatIsSilentAndHeardAgain) {
  const auto kicker = open();
  ASSERT_TRUE(until_armed(*kicker));
  emulator_.with_board([](EmulatedBoard& board) { board.faults.silent = true; });
  EXPECT_TRUE(until_link_fault(*kicker));
  kicker->fire({1, 30.0, steady_ns()});
  EXPECT_TRUE(tests::until_status_says(*kicker, "kick 1 was not fired"));
  emulator_.with_board([](EmulatedBoard& board) { board.faults.silent = false; });
  EXPECT_TRUE(until_armed(*kicker)) << kicker->status();
  EXPECT_EQ(kicks_told(), 0u);
}

TEST_F(ReKickKickerTest, TellsTheVoltageAgainToABoardThatWasReset) {
  const auto kicker = open();
  ASSERT_TRUE(until_armed(*kicker));
  emulator_.with_board([](EmulatedBoard& board) { board.say(from_board({0xF4, 3})); });
  EXPECT_TRUE(emulator_.wait(kTimeout, [](const EmulatedBoard& board) { return board.voltages_told() == 2; }));
  EXPECT_TRUE(tests::until_status_says(*kicker, "the board was reset: watchdog"));
}

}  // namespace
}  // namespace trivela::hal::rekick
