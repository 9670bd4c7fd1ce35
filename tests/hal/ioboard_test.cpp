// The protocol of an ioBoard by itself: a line that the test holds the other end of, and instants that it names.
#include "hal/ioboard/io_board.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kicking/model/robot_model.hpp"
#include "tests/hal/scripted_line.hpp"

namespace trivela::hal::ioboard {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kMs = 1'000'000;

std::string version() { return encode({Command::kVersion, {'0', '0', '0', '0', '0', '0', '0', '3'}}); }
std::string switches(int in_play, int software_on) {
  return encode({Command::kStatus, {static_cast<std::uint8_t>(in_play), static_cast<std::uint8_t>(software_on)}});
}

class IoBoardTest : public testing::Test {
 protected:
  void make(const config::IoBoardDevice& settings = {}) {
    board_.emplace(std::make_unique<tests::ScriptedLine>(end_), settings);
  }
  /// Opens it and answers until it asks for its switches.
  void bring_up(const config::IoBoardDevice& settings = {}) {
    make(settings);
    step(0);
    answer(version(), 1);
    ASSERT_TRUE(board_->up()) << board_->status();
    ASSERT_THAT(end_.written, ElementsAre(encode(frame_of(Command::kVersion)), encode(frame_of(Command::kStatus))));
    end_.written.clear();
    board_->take_sample();
  }
  void step(std::int64_t t_ms) { board_->step(t_ms * kMs); }
  void answer(const std::string& bytes, std::int64_t t_ms) {
    end_.incoming += bytes;
    step(t_ms);
  }
  /// The last sample; throws where none was said.
  KickerSample sample() { return board_->take_sample().value(); }
  std::string shot(std::uint8_t units) { return encode(frame_of(Command::kShoot, units)); }

  tests::ScriptedEnd end_;
  std::optional<IoBoard> board_;
};

TEST_F(IoBoardTest, IsArmedOnceBothSwitchesWereClosedTwiceRunning) {
  bring_up();
  answer(switches(1, 1), 2);
  EXPECT_FALSE(sample().armed);
  step(21);
  answer(switches(1, 1), 22);
  EXPECT_TRUE(sample().armed);
  step(41);
  answer(switches(1, 0), 42);
  EXPECT_FALSE(sample().armed) << "an open switch disarms at once";
  step(61);
  answer(switches(1, 1), 62);
  EXPECT_FALSE(sample().armed);
  step(81);
  answer(switches(0, 1), 82);
  EXPECT_FALSE(sample().armed);
}

TEST_F(IoBoardTest, ASampleIsOfTheInstantOfItsQuestion) {
  bring_up();
  answer(switches(1, 1), 2);
  EXPECT_EQ(sample().t_ns, 1 * kMs);
  step(21);
  answer(switches(1, 1), 90);  // this process stood still; the answer waited
  EXPECT_EQ(sample().t_ns, 21 * kMs);
}

TEST_F(IoBoardTest, IsEmulatedWhereItsVersionSaysSo) {
  bring_up();
  answer(switches(1, 1), 2);
  EXPECT_FALSE(sample().emulated);
  make();
  step(0);
  answer(encode({Command::kVersion, {'e', 'm', 'u', 'l', 'a', 't', 'e', 'd'}}), 1);
  answer(switches(1, 1), 2);
  EXPECT_TRUE(sample().emulated);
}

TEST_F(IoBoardTest, ChargesEvenlyFromTheFirstAnswerAndFromEachShot) {
  bring_up({.charge_time_s = 2.0});
  answer(switches(1, 1), 2);
  const KickerSample first = sample();
  EXPECT_EQ(first.charge, 0.0);
  EXPECT_TRUE(first.charge_modelled);
  EXPECT_FALSE(first.voltage_v);
  step(1001);
  answer(switches(1, 1), 1002);
  EXPECT_DOUBLE_EQ(sample().charge, 0.5);
  step(3001);
  answer(switches(1, 1), 3002);
  EXPECT_EQ(sample().charge, 1.0);
  EXPECT_EQ(board_->shoot(100.0, 3010 * kMs), "");
  step(3510);
  answer(switches(1, 1), 3511);
  EXPECT_DOUBLE_EQ(sample().charge, 0.25);
}

TEST_F(IoBoardTest, AShotIsOneWriteOfTheBoardsFrame) {
  bring_up();
  EXPECT_EQ(board_->shoot(100.0, 5 * kMs), "");
  EXPECT_THAT(end_.written, ElementsAre(shot(100)));
}

TEST_F(IoBoardTest, SendsNoShotIntoALineThatHasNotAnsweredForAWhile) {
  bring_up();  // it was asked for its switches after 1 ms
  EXPECT_EQ(board_->shoot(100.0, 31 * kMs), "");
  EXPECT_EQ(board_->shoot(100.0, 32 * kMs), "the board has not answered for 31 ms");
  answer(switches(1, 1), 33);
  EXPECT_EQ(board_->shoot(100.0, 34 * kMs), "");
  EXPECT_EQ(std::ranges::count(end_.written, shot(100)), 2);
}

TEST_F(IoBoardTest, AShotIsNeverSentAgain) {
  bring_up();
  EXPECT_EQ(board_->shoot(100.0, 5 * kMs), "");
  for (std::int64_t t_ms = 6; t_ms < 1000; ++t_ms) answer(switches(1, 1), t_ms);  // and none to the shot
  EXPECT_EQ(std::ranges::count(end_.written, shot(100)), 1);
  EXPECT_TRUE(board_->up());
}

TEST_F(IoBoardTest, WhatHasNotLeftWhenTheAnswerIsDueIsDropped) {
  bring_up();
  answer(switches(1, 1), 2);
  EXPECT_EQ(board_->shoot(100.0, 5 * kMs), "");
  step(104);
  EXPECT_EQ(end_.dropped, 0);
  step(105);
  EXPECT_EQ(end_.dropped, 1);
}

TEST_F(IoBoardTest, AsksForTheSwitchesAgainTwiceAndThenTheLineIsLost) {
  bring_up();  // asked at 1 ms
  step(100);
  EXPECT_THAT(end_.written, IsEmpty());
  for (const std::int64_t t_ms : {101, 201}) step(t_ms);
  EXPECT_THAT(end_.written, ElementsAre(encode(frame_of(Command::kStatus)), encode(frame_of(Command::kStatus))));
  EXPECT_TRUE(board_->up());
  step(301);
  EXPECT_FALSE(board_->up());
  EXPECT_EQ(board_->status(), "/dev/ttyTEST: no answer to command 08");
  EXPECT_EQ(sample().fault, KickerFault::kLink);
}

TEST_F(IoBoardTest, AnAnswerToTheSecondQuestionMayBeToTheFirst) {
  bring_up();
  step(101);
  answer(switches(1, 1), 102);
  EXPECT_EQ(sample().t_ns, 1 * kMs);
}

TEST_F(IoBoardTest, TheLeverIsToldOnceAndItsAnswerIsChecked) {
  make({.lever = 120});
  step(0);
  answer(version(), 1);
  EXPECT_FALSE(board_->up());
  EXPECT_EQ(end_.written.back(), encode(frame_of(Command::kHeight, 120)));
  answer(encode(frame_of(Command::kHeight, 120)), 2);
  EXPECT_TRUE(board_->up());
  EXPECT_EQ(std::ranges::count(end_.written, encode(frame_of(Command::kHeight, 120))), 1);
}

TEST_F(IoBoardTest, TheLeverMovesToAnotherKindOfKickAndStandsThereAfterItsTime) {
  make({.lever = 120, .levers = {120, 20}, .lever_s = 0.1});
  step(0);
  answer(version(), 1);
  answer(encode(frame_of(Command::kHeight, 120)), 2);
  ASSERT_TRUE(board_->up());
  answer(switches(1, 1), 3);
  EXPECT_EQ(sample().lever_kind, kicking::kLeverMoves) << "where it stood before nobody knows";
  board_->lever(1);
  step(50);
  EXPECT_EQ(std::ranges::count(end_.written, encode(frame_of(Command::kHeight, 20))), 0) << "it would be ignored";
  answer(switches(1, 1), 60);
  sample();
  step(110);
  EXPECT_EQ(std::ranges::count(end_.written, encode(frame_of(Command::kHeight, 20))), 1);
  answer(encode(frame_of(Command::kHeight, 20)), 112);
  answer(switches(1, 1), 113);
  EXPECT_EQ(sample().lever_kind, kicking::kLeverMoves);
  step(213);
  answer(switches(1, 1), 214);
  EXPECT_EQ(sample().lever_kind, 1);
  board_->lever(7);
  step(240);
  EXPECT_EQ(std::ranges::count(end_.written, encode(frame_of(Command::kHeight, 20))), 1) << "no such kind";
}

TEST_F(IoBoardTest, ALeverThatAnswersAnotherHeightOrNoneIsALostLine) {
  make({.lever = 120});
  step(0);
  answer(version(), 1);
  answer(encode(frame_of(Command::kHeight, 20)), 2);
  EXPECT_EQ(board_->status(), "/dev/ttyTEST: the lever was set to 120 and answered 20");
  step(202);
  answer(version(), 203);
  step(303);
  EXPECT_EQ(board_->status(), "/dev/ttyTEST: no answer to command 07");
  EXPECT_EQ(std::ranges::count(end_.written, encode(frame_of(Command::kHeight, 120))), 2) << "once on each line";
}

TEST_F(IoBoardTest, ACommandThatTheBoardDoesNotKnowIsNamed) {
  bring_up();
  answer(switches(1, 1), 2);
  EXPECT_EQ(board_->shoot(50.0, 3 * kMs), "");
  answer(encode(frame_of(Command::kUnknown)), 4);
  EXPECT_FALSE(board_->up());
  EXPECT_EQ(board_->status(), "/dev/ttyTEST: the board does not know command 02");
}

TEST_F(IoBoardTest, ALineThatIsNotThereIsOpenedAgainBetweenPausesAndSaidAsAFault) {
  end_.plugged = false;
  make();
  step(0);
  EXPECT_EQ(sample().fault, KickerFault::kLink);
  EXPECT_EQ(board_->status(), "no device /dev/ttyTEST: no such file or directory");
  end_.plugged = true;
  step(100);
  EXPECT_EQ(end_.opened, 0);
  EXPECT_EQ(sample().t_ns, 100 * kMs) << "a fault is of now";
  step(200);
  EXPECT_EQ(end_.opened, 1);
  answer(version(), 201);
  EXPECT_TRUE(board_->up());
}

TEST_F(IoBoardTest, AShotThatTheLineDoesNotTakeIsDroppedWithIt) {
  bring_up();
  end_.takes_bytes = false;
  EXPECT_THAT(board_->shoot(100.0, 5 * kMs), HasSubstr("the line is cut"));
  EXPECT_FALSE(board_->up());
  EXPECT_GE(end_.dropped, 1);
}

TEST_F(IoBoardTest, RefusesSetPointsOutsideOfItsPulse) {
  bring_up();
  EXPECT_EQ(board_->shoot(255.5, 0), "set-point 255.5 is a pulse of 32704 us, the board's are 0 to 32640");
  EXPECT_NE(board_->shoot(-0.5, 0), "");
  EXPECT_NE(board_->shoot(std::nan(""), 0), "");
  EXPECT_THAT(end_.written, IsEmpty());
  EXPECT_TRUE(board_->up());
}

TEST(IoBoardPulse, IsTheSetPointInItsUnits) {
  EXPECT_EQ(pulse_of(100.0, 128.0), 100);
  EXPECT_EQ(pulse_of(22.5, 256.0), 45);
  EXPECT_EQ(pulse_of(255.0, 128.0), 255);
  EXPECT_EQ(pulse_of(0.0, 128.0), 0);
  EXPECT_EQ(pulse_of(256.0, 128.0), std::nullopt);
}

TEST(IoBoardCapabilities, AreNoneButTheLeverOfARobotWithSeveralKindsOfKick) {
  tests::ScriptedEnd end;
  EXPECT_EQ(IoBoard(std::make_unique<tests::ScriptedLine>(end), {}).capabilities(), KickerCapabilities{});
  const config::IoBoardDevice two{.lever = 1, .levers = {1, 2}};
  EXPECT_TRUE(IoBoard(std::make_unique<tests::ScriptedLine>(end), two).capabilities().lever);
}

}  // namespace
}  // namespace trivela::hal::ioboard
