#include "hal/rekick/messages.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trivela::hal::rekick {
namespace {

std::vector<int> bytes(const can::Frame& frame) { return {frame.payload().begin(), frame.payload().end()}; }

TEST(ReKickMessage, IsToTheBoardAndHasItsLowByteFirst) {
  EXPECT_EQ(kick(1000).id, 0x60u);
  EXPECT_TRUE(kick(1000).extended);
  EXPECT_EQ(bytes(kick(1000)), (std::vector{0x03, 0xE8, 0x03}));
  EXPECT_EQ(bytes(max_voltage(200)), (std::vector{0x31, 200}));
  EXPECT_EQ(bytes(max_voltage(330)), (std::vector{0x31, 0x4A, 0x01}));
  EXPECT_EQ(bytes(ask(Command::kGetState)), std::vector{0x40});
  EXPECT_EQ(bytes(ask(Command::kPing)), std::vector{0x01});
}

TEST(ReKickMessage, StateHasFlagsAndVoltages) {
  const auto state = state_of(from_board({0xF2, 0x91, 0x60, 0x02, 0x4A, 0x01}));
  ASSERT_TRUE(state);
  EXPECT_TRUE(state->supply_on);
  EXPECT_FALSE(state->booster_on);
  EXPECT_FALSE(state->release_on);
  EXPECT_TRUE(state->error);
  EXPECT_DOUBLE_EQ(state->supply_v, 608 * 0.0394629);
  EXPECT_EQ(state->capacitor_v, 330.0);
  EXPECT_EQ(state_of(from_board({0xF2, 0x60, 0, 0, 0xC8}))->capacitor_v, 200.0) << "a short one has a byte";
  EXPECT_TRUE(state_of(from_board({0xF2, 0x60, 0, 0, 0xC8}))->booster_on);
  EXPECT_TRUE(state_of(from_board({0xF2, 0x60, 0, 0, 0xC8}))->release_on);
}

TEST(ReKickMessage, OfAnotherSenderOrLengthIsNoState) {
  EXPECT_FALSE(state_of(can::extended_frame(0x40A000, {0xF2, 0x80, 0, 0, 100})));  // a ball handler
  EXPECT_FALSE(state_of(can::extended_frame(0x60, {0xF2, 0x80, 0, 0, 100})));      // to the board
  EXPECT_FALSE(state_of(from_board({0xF2, 0x80, 0, 0})));
  EXPECT_FALSE(state_of(from_board({0xF2, 0x80, 0, 0, 1, 2, 3})));
  EXPECT_FALSE(state_of(from_board({0xF1, 0x80, 0, 0, 100})));
  can::Frame error = from_board({0xF2, 0x80, 0, 0, 100});
  error.error = true;
  EXPECT_FALSE(state_of(error));
  EXPECT_FALSE(answer_of(from_board({})));
}

TEST(ReKickMessage, StateComesBack) {
  const State said{.supply_on = true, .booster_on = true, .supply_v = 24.0, .capacitor_v = 301.0};
  const auto state = state_of(frame_of(said));
  ASSERT_TRUE(state);
  EXPECT_TRUE(state->supply_on && state->booster_on && !state->release_on && !state->error);
  EXPECT_NEAR(state->supply_v, 24.0, 0.02);
  EXPECT_EQ(state->capacitor_v, 301.0);
}

TEST(ReKickPulse, IsTheSetPointInMicroseconds) {
  EXPECT_EQ(pulse_of(50.0, 100.0 / 3.0), 1667);
  EXPECT_EQ(pulse_of(100.0, 100.0 / 3.0), 3333);
  EXPECT_EQ(pulse_of(3499.0, 1.0), 3499);
  EXPECT_EQ(pulse_of(1.0, 1.0), 1);
  for (const double power : {0.0, 0.4, -1.0, 3499.6, std::nan("")})
    EXPECT_EQ(pulse_of(power, 1.0), std::nullopt) << power;
}

TEST(ReKickMessage, NamesTheCauseOfAReset) {
  EXPECT_EQ(reset_cause(from_board({0xF4, 2})), "brown-out");
  EXPECT_EQ(reset_cause(from_board({0xF4, 5})), "unknown cause");
  EXPECT_EQ(reset_cause(from_board({0xF4})), "unknown cause");
}

}  // namespace
}  // namespace trivela::hal::rekick
