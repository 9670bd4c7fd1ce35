// The ReKick board's protocol by itself: a bus that the test holds the other end of, and instants that it names.
#include "hal/rekick/rekick.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can/error.h>

#include <cmath>

#include "tests/hal/scripted_line.hpp"

namespace trivela::hal::rekick {
namespace {

using ::testing::ElementsAre;

constexpr std::int64_t kMs = 1'000'000;

const std::string kAsksState = can::encode(ask(Command::kGetState));

class ReKickTest : public testing::Test {
 protected:
  void step(std::int64_t t_ms) { board_.step(t_ms * kMs); }
  void receive(const can::Frame& frame, std::int64_t t_ms) {
    end_.incoming += can::encode(frame);
    step(t_ms);
  }
  void bring_up() {
    step(0);
    receive(frame_of({.supply_on = true, .capacitor_v = 330.0}), 1);
    ASSERT_TRUE(board_.up()) << board_.status();
    board_.take_sample();
    end_.written.clear();
  }
  KickerSample sample() { return board_.take_sample().value(); }

  tests::ScriptedEnd end_;
  ReKick board_{std::make_unique<tests::ScriptedLine>(end_), {}};
};

TEST_F(ReKickTest, TellsItsVoltagePingsAndAsksWhenTheBusIsOpened) {
  step(0);
  EXPECT_THAT(end_.written, ElementsAre(can::encode(max_voltage(330)), can::encode(ask(Command::kPing)), kAsksState));
  EXPECT_FALSE(board_.up());
  EXPECT_EQ(sample().fault, KickerFault::kLink);
}

TEST_F(ReKickTest, ASampleIsTheStateAtTheInstantOfTheQuestion) {
  bring_up();
  step(20);
  receive(frame_of({.supply_on = true, .capacitor_v = 165.0}), 70);
  const KickerSample said = sample();
  EXPECT_EQ(said.t_ns, 20 * kMs);
  EXPECT_DOUBLE_EQ(said.charge, 0.25);
  EXPECT_EQ(said.voltage_v, 165.0);
  EXPECT_TRUE(said.armed);
  EXPECT_FALSE(said.charge_modelled);
  EXPECT_EQ(said.fault, KickerFault::kNone);
}

TEST_F(ReKickTest, OvervoltageErrorAndMissingSupplyShow) {
  bring_up();
  step(20);
  receive(frame_of({.supply_on = false, .error = true, .capacitor_v = 340.0}), 21);
  const KickerSample said = sample();
  EXPECT_GT(said.charge, 1.05);
  EXPECT_FALSE(said.armed);
  EXPECT_EQ(said.fault, KickerFault::kCharger);
}

TEST_F(ReKickTest, IsEmulatedWhereItsAnswerToAPingSaysSo) {
  bring_up();
  const auto emulated_after = [this](const can::Frame& pong, std::int64_t t_ms) {
    receive(pong, t_ms);
    step(t_ms + 20);
    receive(frame_of({.supply_on = true}), t_ms + 21);
    return sample().emulated;
  };
  EXPECT_FALSE(emulated_after(from_board({0xF1}), 20));
  EXPECT_TRUE(emulated_after(emulated_pong(), 60));
}

TEST_F(ReKickTest, AKickIsOneFrame) {
  bring_up();
  EXPECT_EQ(board_.shoot(30.0, 5 * kMs), "");
  EXPECT_THAT(end_.written, ElementsAre(can::encode(kick(1000))));
  for (std::int64_t t_ms = 6; t_ms < 250; ++t_ms) step(t_ms);
  EXPECT_EQ(std::ranges::count(end_.written, can::encode(kick(1000))), 1);
}

TEST_F(ReKickTest, RefusesAKickThatComesTooSoonOrIsOutOfRange) {
  bring_up();
  EXPECT_EQ(board_.shoot(30.0, 1000 * kMs), "");
  EXPECT_EQ(board_.shoot(30.0, 1099 * kMs), "the last kick was less than 0.1 s before");
  EXPECT_EQ(board_.shoot(30.0, 1100 * kMs), "");
  EXPECT_EQ(board_.shoot(120.0, 1300 * kMs), "set-point 120 is a pulse of 4000 us, the board's are 1 to 3499");
  EXPECT_NE(board_.shoot(std::nan(""), 1300 * kMs), "");
  EXPECT_EQ(end_.written.size(), 2u);
}

TEST_F(ReKickTest, SendsNoKickToABusThatHasNotAnsweredForAWhile) {
  bring_up();
  step(20);  // asks
  end_.written.clear();
  EXPECT_EQ(board_.shoot(30.0, 51 * kMs), "the board has not answered for 31 ms");
  EXPECT_TRUE(end_.written.empty());
  receive(frame_of({.supply_on = true, .capacitor_v = 330.0}), 52);
  EXPECT_EQ(board_.shoot(30.0, 53 * kMs), "");
}

TEST_F(ReKickTest, AsksAgainAndIsLostAfterASilence) {
  bring_up();
  for (std::int64_t t_ms = 20; t_ms < 320; ++t_ms) step(t_ms);
  EXPECT_EQ(std::ranges::count(end_.written, kAsksState), 3);
  EXPECT_TRUE(board_.up());
  step(320);
  EXPECT_FALSE(board_.up());
  EXPECT_EQ(board_.status(), "/dev/ttyTEST: the board does not answer");
  EXPECT_EQ(sample().fault, KickerFault::kLink);
  EXPECT_NE(board_.next_ns(), 0);
}

TEST_F(ReKickTest, SaysWhenItIsToBeCalledAgain) {
  bring_up();
  EXPECT_EQ(board_.next_ns(), 20 * kMs);
  step(20);
  EXPECT_EQ(board_.next_ns(), 120 * kMs) << "an answer is awaited";
  receive(frame_of({.supply_on = true}), 22);
  EXPECT_EQ(board_.next_ns(), 40 * kMs);
}

TEST_F(ReKickTest, ASecondAnswerToAQuestionAskedTwiceIsNoSample) {
  bring_up();
  step(20);
  step(120);
  receive(frame_of({.supply_on = true}), 121);
  EXPECT_EQ(sample().t_ns, 20 * kMs);
  receive(frame_of({.supply_on = true}), 122);
  EXPECT_FALSE(board_.take_sample());
}

TEST_F(ReKickTest, BusOffIsALinkFaultInWords) {
  bring_up();
  receive({.id = CAN_ERR_BUSOFF, .error = true}, 2);
  EXPECT_FALSE(board_.up());
  EXPECT_EQ(board_.status(), "/dev/ttyTEST: bus off");
  step(202);
  EXPECT_EQ(end_.opened, 2);
}

TEST_F(ReKickTest, AResetBoardIsToldItsVoltageAgain) {
  bring_up();
  receive(from_board({0xF4, 2}), 2);
  EXPECT_THAT(end_.written, ElementsAre(can::encode(max_voltage(330))));
  EXPECT_EQ(board_.status(), "/dev/ttyTEST: the board was reset: brown-out");
}

TEST_F(ReKickTest, WhatTheBoardWritesIsReadUpToTheEndOfItsLine) {
  bring_up();
  receive(from_board({0x21, 'c', 'o', 'i', 'l'}), 2);
  EXPECT_EQ(board_.status(), "/dev/ttyTEST: ReKick");
  receive(from_board({0x21, ' ', 'h', 'o', 't', '\n'}), 3);
  EXPECT_EQ(board_.status(), "/dev/ttyTEST: the board says: coil hot");
}

TEST_F(ReKickTest, OthersOfTheBusSayNothing) {
  bring_up();
  step(20);
  receive(can::extended_frame(0x40A000, {0xF2, 0xFF, 0, 0, 1}), 21);
  EXPECT_FALSE(board_.take_sample());
  EXPECT_TRUE(board_.up());
}

TEST_F(ReKickTest, MeasuresItsCapacitorAndCanNothingElse) {
  EXPECT_EQ(board_.capabilities(), (KickerCapabilities{.voltage = true}));
}

}  // namespace
}  // namespace trivela::hal::rekick
