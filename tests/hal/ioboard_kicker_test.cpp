// The ioBoard's backend with its thread, on a pseudo-terminal, against an emulated board: its clock is the witness.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "kicking/model/robot_model.hpp"
#include "tests/hal/board_on_a_line.hpp"

namespace trivela::hal::ioboard {
namespace {

using std::chrono::milliseconds;
using tests::kTimeout;
using tests::steady_ns;
using tests::until_armed;
using tests::until_link_fault;

constexpr std::int64_t kMs = 1'000'000;

class IoBoardKickerTest : public testing::Test {
 protected:
  std::unique_ptr<Kicker> open(config::IoBoardDevice settings = {}) {
    settings.port = emulator_.address();
    return tests::kicker_on(std::make_unique<IoBoard>(serial_line(settings.port), settings));
  }
  bool wait_for_pulses(std::size_t n) {
    return emulator_.wait(kTimeout, [=](const EmulatedBoard& board) { return board.pulses().size() >= n; });
  }
  void wait_for_looks(std::uint64_t n) { tests::wait_for_looks(emulator_, n); }
  EmulatedBoard board() {
    EmulatedBoard copy;
    emulator_.with_board([&](const EmulatedBoard& board) { copy = board; });
    return copy;
  }

  Emulator emulator_;
};

TEST_F(IoBoardKickerTest, FiresOnceAtItsInstantAndNotBefore) {
  const auto kicker = open();
  ASSERT_TRUE(kicker->connected(kTimeout)) << kicker->status();
  const std::int64_t t_ns = steady_ns() + 60 * kMs;
  kicker->fire({1, 100.0, t_ns});
  ASSERT_TRUE(wait_for_pulses(1));
  wait_for_looks(3);
  const EmulatedBoard seen = board();
  ASSERT_EQ(seen.shots_told(), 1u);
  EXPECT_EQ(seen.pulses()[0].units, 100);
  EXPECT_GE(seen.pulses()[0].t_ns, t_ns);
}

TEST_F(IoBoardKickerTest, SamplesAreOfTheBoardsInstants) {
  const auto kicker = open();
  ASSERT_TRUE(until_armed(*kicker));
  std::int64_t last_ns = 0;
  for (int i = 0; i < 10; ++i) {
    const auto sample = kicker->read(kTimeout);
    ASSERT_TRUE(sample);
    EXPECT_GT(sample->t_ns, last_ns);
    EXPECT_LE(sample->t_ns, board().last_look_ns());
    EXPECT_TRUE(sample->charge_modelled);
    EXPECT_TRUE(sample->emulated);
    last_ns = sample->t_ns;
  }
}

TEST_F(IoBoardKickerTest, SwitchesDisarm) {
  const auto kicker = open();
  ASSERT_TRUE(until_armed(*kicker));
  emulator_.with_board([](EmulatedBoard& board) { board.in_play = false; });
  EXPECT_TRUE(tests::read_until(*kicker, [](const KickerSample& sample) { return !sample.armed; }));
  emulator_.with_board([](EmulatedBoard& board) { board.in_play = true; });
  EXPECT_TRUE(until_armed(*kicker));
  emulator_.with_board([](EmulatedBoard& board) { board.software_on = false; });
  EXPECT_TRUE(tests::read_until(*kicker, [](const KickerSample& sample) { return !sample.armed; }));
}

TEST_F(IoBoardKickerTest, AShotWhoseAnswerIsLostGarbledOrWrongIsNotSentAgain) {
  const auto kicker = open();
  ASSERT_TRUE(kicker->connected(kTimeout));
  constexpr int EmulatedFaults::*kFaults[] = {&EmulatedFaults::lost_every, &EmulatedFaults::garbled_every,
                                              &EmulatedFaults::wrong_sums_every};
  std::size_t shots = 0;
  for (const auto fault : kFaults) {
    emulator_.with_board([=](EmulatedBoard& board) { board.faults.*fault = 1; });  // every answer
    kicker->fire({static_cast<std::int64_t>(++shots), 20.0, steady_ns()});
    ASSERT_TRUE(wait_for_pulses(shots)) << kicker->status();
    EXPECT_TRUE(until_link_fault(*kicker)) << "no answer comes any more";
    emulator_.with_board([](EmulatedBoard& board) { board.faults = {}; });
    EXPECT_TRUE(until_armed(*kicker)) << kicker->status();
    EXPECT_EQ(board().shots_told(), shots);
  }
}

TEST_F(IoBoardKickerTest, SomeLostAnswersCostSamplesAndNotTheLine) {
  const auto kicker = open();
  ASSERT_TRUE(until_armed(*kicker));
  emulator_.with_board([](EmulatedBoard& board) { board.faults.lost_every = 3; });
  for (int i = 0; i < 20; ++i) {
    const auto sample = kicker->read(kTimeout);
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->fault, KickerFault::kNone);
  }
}

TEST_F(IoBoardKickerTest, NothingLeavesAfterItIsSafe) {
  const auto kicker = open();
  ASSERT_TRUE(kicker->connected(kTimeout));
  kicker->fire({1, 100.0, steady_ns() + 30 * kMs});
  kicker->make_safe();
  kicker->fire({2, 100.0, steady_ns()});
  wait_for_looks(10);
  EXPECT_EQ(board().shots_told(), 0u);
  EXPECT_TRUE(until_armed(*kicker)) << "it still speaks";
}

TEST_F(IoBoardKickerTest, DestructionFiresNothing) {
  auto kicker = open();
  ASSERT_TRUE(kicker->connected(kTimeout));
  kicker->fire({1, 100.0, steady_ns() + 500 * kMs});
  kicker.reset();
  kicker = open();
  ASSERT_TRUE(kicker->connected(kTimeout));
  wait_for_looks(30);
  EXPECT_EQ(board().shots_told(), 0u);
}

TEST_F(IoBoardKickerTest, TheLeverStandsForTheKindOfKickThatIsWantedAlsoOnANewLine) {
  const auto kicker = open({.lever = 100, .levers = {100, 20}, .lever_s = 0.1});
  const auto stands_for = [&](std::uint8_t kind) {
    const std::int64_t until_ns = steady_ns() + std::chrono::nanoseconds(kTimeout).count();
    while (steady_ns() < until_ns) {
      const auto sample = kicker->read(kTimeout);
      if (sample && sample->fault == KickerFault::kNone && sample->lever_kind == kind) return true;
    }
    return false;
  };
  EXPECT_TRUE(stands_for(0));
  EXPECT_EQ(board().lever(), 100);
  kicker->lever(1);
  EXPECT_TRUE(stands_for(kicking::kLeverMoves));
  EXPECT_TRUE(stands_for(1));
  EXPECT_EQ(board().lever(), 20);
  kicker->fire({.kick_id = 1, .power = 100.0, .t_ns = steady_ns()});
  EXPECT_TRUE(tests::until_status_says(*kicker, "kick 1 was not fired: the lever does not stand for its kind of kick"));
  EXPECT_EQ(board().shots_told(), 0u) << "judged for the other kind";
  EXPECT_EQ(kicker->take_result().value_or(ShotResult{}).what, ShotResult::What::kDevice);
  kicker->fire({.kick_id = 2, .power = 100.0, .t_ns = steady_ns(), .kick_kind = 1});
  EXPECT_TRUE(wait_for_pulses(1));
  emulator_.line().pull();
  EXPECT_TRUE(until_link_fault(*kicker));
  emulator_.line().plug();
  EXPECT_TRUE(stands_for(1));
  EXPECT_EQ(board().lever(), 20);
}

TEST_F(IoBoardKickerTest, APulledCableIsALinkFaultAndIsOpenedAgainByItself) {
  const auto kicker = open({.lever = 120});
  ASSERT_TRUE(until_armed(*kicker));
  EXPECT_EQ(board().lever(), 120);
  emulator_.line().pull();
  EXPECT_TRUE(until_link_fault(*kicker));
  kicker->fire({1, 100.0, steady_ns()});             // nobody is there
  kicker->fire({2, 100.0, steady_ns() + 10 * kMs});  // nor then
  EXPECT_TRUE(tests::until_status_says(*kicker, "kick 2"));
  emulator_.line().plug();
  EXPECT_TRUE(until_armed(*kicker)) << kicker->status();
  wait_for_looks(5);
  const EmulatedBoard seen = board();
  EXPECT_EQ(seen.shots_told(), 0u) << "nothing fires late";
  EXPECT_EQ(seen.heights_told(), 2u) << "once on each line";
  kicker->fire({3, 100.0, steady_ns()});
  EXPECT_TRUE(wait_for_pulses(1));
}

TEST_F(IoBoardKickerTest, AShotThatStoodInTheCableDoesNotFireWhenItIsPluggedInAgain) {
  const auto kicker = open();
  ASSERT_TRUE(until_armed(*kicker));
  emulator_.line().hold(true);
  kicker->fire({1, 100.0, steady_ns()});
  EXPECT_TRUE(until_link_fault(*kicker));
  emulator_.line().pull();
  emulator_.line().hold(false);
  emulator_.line().plug();
  EXPECT_TRUE(until_armed(*kicker)) << kicker->status();
  wait_for_looks(5);
  EXPECT_EQ(board().shots_told(), 0u);
}

TEST_F(IoBoardKickerTest, ABoardThatIsNotThereYetIsWaitedFor) {
  emulator_.line().pull();
  const auto kicker = open();
  EXPECT_FALSE(kicker->connected(milliseconds(10)));
  EXPECT_TRUE(until_link_fault(*kicker));
  EXPECT_EQ(kicker->status(), "no device " + emulator_.address() + ": no such file or directory");
  emulator_.line().plug();
  EXPECT_TRUE(kicker->connected(kTimeout));
}

TEST_F(IoBoardKickerTest, ASetPointOutsideOfThePulseIsNotFiredAndSaid) {
  const auto kicker = open();
  ASSERT_TRUE(kicker->connected(kTimeout));
  kicker->fire({7, 300.0, steady_ns()});
  EXPECT_TRUE(tests::until_status_says(*kicker, "kick 7"));
  EXPECT_EQ(board().shots_told(), 0u);
}

TEST_F(IoBoardKickerTest, AShotWhoseDeadlineIsOverIsNotFiredAndSaid) {
  const auto kicker = open();
  ASSERT_TRUE(kicker->connected(kTimeout));
  const std::int64_t now_ns = steady_ns();
  kicker->fire({.kick_id = 1, .power = 100.0, .t_ns = now_ns - 2'000 * kMs, .until_ns = now_ns - 1});
  wait_for_looks(board().looks() + 3);
  EXPECT_EQ(board().shots_told(), 0u);
  EXPECT_NE(kicker->status().find("kick 1 was not fired: it was"), std::string::npos) << kicker->status();
  const auto dropped = kicker->take_result();
  ASSERT_TRUE(dropped);
  EXPECT_EQ(dropped->kick_id, 1);
  EXPECT_EQ(dropped->what, ShotResult::What::kLate);
  EXPECT_FALSE(kicker->take_result());
}

TEST_F(IoBoardKickerTest, AShotThatWasJudgedBeforeTheStopIsNotFired) {
  const auto kicker = open();
  ASSERT_TRUE(kicker->connected(kTimeout));
  const std::int64_t judged_ns = steady_ns();
  kicker->hold_when([stopped_ns = judged_ns](std::int64_t judged) { return judged <= stopped_ns; });
  // The order of a thread that stood still between the judgement and this call.
  kicker->fire({.kick_id = 1, .power = 100.0, .t_ns = judged_ns, .judged_ns = judged_ns});
  wait_for_looks(board().looks() + 3);
  EXPECT_EQ(board().shots_told(), 0u);
  EXPECT_EQ(kicker->take_result().value_or(ShotResult{}).what, ShotResult::What::kCalledOff);
  kicker->fire({.kick_id = 2, .power = 100.0, .t_ns = steady_ns(), .judged_ns = steady_ns()});
  EXPECT_TRUE(wait_for_pulses(1)) << "what is judged afterwards is fired";
}

TEST_F(IoBoardKickerTest, SaysThatAShotWasWrittenAndNothingOfOneThatWasDropped) {
  const auto kicker = open();
  ASSERT_TRUE(kicker->connected(kTimeout));
  std::atomic<int> written = 0;
  kicker->call_when_written([&] { ++written; });
  kicker->fire({.kick_id = 1, .power = 100.0, .t_ns = steady_ns(), .until_ns = 1});
  wait_for_looks(board().looks() + 3);
  EXPECT_EQ(written, 0);
  kicker->fire({.kick_id = 2, .power = 100.0, .t_ns = steady_ns()});
  EXPECT_TRUE(wait_for_pulses(1));
  const auto until = std::chrono::steady_clock::now() + kTimeout;  // the pulse may come before the word
  while (written == 0 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
  EXPECT_EQ(written, 1);
}

TEST(EmulatedIoBoard, IgnoresAShotWhileAPulseRunsAndAHeightWhileTheLeverMoves) {
  EmulatedBoard board;
  const auto tell = [&](Command command, std::uint8_t value, std::int64_t t_ns) {
    EXPECT_EQ(board.take(encode(frame_of(command, value)), t_ns), std::vector{encode(frame_of(command, value))});
  };
  tell(Command::kShoot, 100, 0);  // 12.8 ms
  tell(Command::kShoot, 50, 12 * kMs);
  tell(Command::kShoot, 60, 13 * kMs);
  ASSERT_EQ(board.pulses().size(), 2u);
  EXPECT_EQ(board.pulses()[1].units, 60);
  EXPECT_EQ(board.shots_told(), 3u);
  tell(Command::kHeight, 100, 0);  // 120 ms
  tell(Command::kHeight, 20, 100 * kMs);
  EXPECT_EQ(board.lever(), 100);
  tell(Command::kHeight, 20, 121 * kMs);
  EXPECT_EQ(board.lever(), 20);
}

TEST(EmulatedIoBoard, SaysThatItDoesNotKnowACommand) {
  EmulatedBoard board;
  const auto said = board.take(encode(frame_of(static_cast<Command>(0x33), 5)), 0);
  EXPECT_EQ(said, std::vector{encode(frame_of(Command::kUnknown, 5))});
}

}  // namespace
}  // namespace trivela::hal::ioboard
