// The master of the drives against emulated ones, at instants that the test names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can/error.h>

#include <numbers>

#include "tests/hal/drives_on_a_bus.hpp"

namespace trivela::hal::cia402 {
namespace {

using ::testing::HasSubstr;
using tests::DrivesOnABus;

constexpr std::int64_t kMs = 1'000'000;
constexpr double kRpm = 60.0 / (2.0 * std::numbers::pi);
constexpr double kTurn_radps = 2.0;
/// Each motor's speed when the base of the default robot turns on the spot, gear 12.
constexpr double kTurning_rpm = kTurn_radps * 0.22 / 0.05 * 12.0 * kRpm;

class Cia402DrivesTest : public testing::Test {
 protected:
  void turn_on_the_spot() {
    bus_.bring_up();
    bus_.client->drive({0.0, 0.0, kTurn_radps});
    bus_.run(0.5);
    for (const std::uint8_t node : {1, 2, 3}) ASSERT_NEAR(bus_.rpm(node), kTurning_rpm, 0.5);
  }
  std::string status() const { return bus_.client->status(); }

  DrivesOnABus bus_;
};

TEST_F(Cia402DrivesTest, BringsEveryDriveIntoOperation) {
  bus_.bring_up();
  for (const EmulatedDrive& drive : bus_.drives.drives()) {
    EXPECT_EQ(drive.state(), DriveState::kEnabled);
    EXPECT_EQ(drive.boots(), 1u) << "it was reset";
  }
  EXPECT_EQ(status(), "can0: 3 drives in operation, 1 rpm a unit, gear 12");
}

TEST_F(Cia402DrivesTest, ASampleIsOfTheInstantOfSync) {
  turn_on_the_spot();
  bus_.client->take_sample();
  std::optional<WheelSample> sample;
  std::int64_t last_ns = bus_.now_ns;
  for (int i = 0; i < 30 && !sample; ++i) {
    last_ns = bus_.now_ns;
    bus_.run(0.001);
    sample = bus_.client->take_sample();
  }
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->t_ns, last_ns - kMs) << "the answers were read a step after the question";
  EXPECT_EQ(sample->wheel_count, 3);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(sample->wheel_radps[static_cast<std::size_t>(i)], 8.8, 0.5 / 12.0 / kRpm);
  EXPECT_FALSE(sample->gyro_radps);
}

TEST_F(Cia402DrivesTest, EachWheelTurnsByItsShareOfTheMotion) {
  bus_.bring_up();
  bus_.client->drive({0.5, -1.5, 2.0});
  bus_.run(1.0);
  const auto wheels = kicking::OmniKinematics{kicking::WheelBase{}}.wheel_speeds_radps({0.5, -1.5, 2.0});
  for (const std::uint8_t node : {1, 2, 3})
    EXPECT_EQ(bus_.drive(node).target_rpm(), std::lround(wheels[node - 1U] * 12.0 * kRpm));
}

TEST_F(Cia402DrivesTest, OneWheelTurnsAlone) {
  bus_.bring_up();
  bus_.client->drive_wheel(1, 3.0);
  bus_.run(1.0);
  for (const std::uint8_t node : {1, 2, 3})
    EXPECT_EQ(bus_.drive(node).target_rpm(), node == 2 ? std::lround(3.0 * 12.0 * kRpm) : 0);
  bus_.client->drive_wheel(1, std::nan(""));
  bus_.run(1.0);
  EXPECT_EQ(bus_.drive(2).target_rpm(), 0);
}

TEST_F(Cia402DrivesTest, StandsStillUntilEveryDriveIsInOperation) {
  bus_.drive(2).faults.deaf = true;
  bus_.client->drive({1.0, 0.0, 0.0});
  bus_.run(1.0);
  EXPECT_EQ(bus_.drive(1).state(), DriveState::kEnabled);
  EXPECT_EQ(bus_.rpm(1), 0.0);
  EXPECT_FALSE(bus_.client->up());
  EXPECT_FALSE(bus_.client->take_sample()) << "one wheel is missing";
  EXPECT_EQ(status(), "can0: drive 2: starting");
  bus_.run(3.0);
  EXPECT_EQ(status(), "can0: drive 2: it does not come up after a reset");
}

TEST_F(Cia402DrivesTest, WithoutOurHeartbeatTheWheelsStandByThemselves) {
  turn_on_the_spot();
  std::int64_t received_ns[3];
  for (std::size_t i = 0; i < 3; ++i) received_ns[i] = bus_.drives.drives()[i].received_ns();
  bus_.stall(2.0);
  const auto ramp_ns = std::llround(kTurning_rpm / 10000.0 * 1e9) + kMs;
  for (std::size_t i = 0; i < 3; ++i) {
    const EmulatedDrive& drive = bus_.drives.drives()[i];
    EXPECT_EQ(drive.state(), DriveState::kFault);
    ASSERT_TRUE(drive.rest_ns());
    EXPECT_LE(*drive.rest_ns(), received_ns[i] + 200 * kMs + ramp_ns);
  }
}

TEST_F(Cia402DrivesTest, ADriveThatCannotWatchOurHeartbeatIsRefusedInWords) {
  bus_.drive(2).faults.refuses_heartbeat = true;
  bus_.run(1.0);
  EXPECT_EQ(status(),
            "can0: drive 2: it refuses object 1016: no such object (06020000): its wheel would turn on when "
            "this program dies");
  EXPECT_NE(bus_.drive(2).state(), DriveState::kEnabled);
}

TEST_F(Cia402DrivesTest, ADriveThatForgetsTheHeartbeatIsRefused) {
  bus_.drive(3).faults.forgets_heartbeat = true;
  bus_.run(1.0);
  EXPECT_THAT(status(),
              HasSubstr("drive 3: it does not keep the heartbeat that it is to watch (object 1016 is 00000000, "
                        "not 007F00C8)"));
}

TEST_F(Cia402DrivesTest, ADriveThatDoesNotStopWithoutUsIsRefused) {
  bus_.drive(1).factory.erase(EmulatedDrive::key({0x6007, 0}));
  bus_.run(1.0);
  EXPECT_THAT(status(), HasSubstr("drive 1: it refuses object 6007: no such object"));
}

TEST_F(Cia402DrivesTest, ASetPointFromBeforeIsNotDoneWhenTheDrivesAreBack) {
  turn_on_the_spot();
  bus_.drive(1).power_cycle(bus_.now_ns);
  bus_.run(0.1);
  bus_.bring_up();
  bus_.run(0.5);
  for (const std::uint8_t node : {1, 2, 3}) EXPECT_EQ(bus_.rpm(node), 0.0);
}

TEST_F(Cia402DrivesTest, AFaultStopsTheBaseIsSaidAndIsNotResetByItself) {
  turn_on_the_spot();
  bus_.drives.fail(2, 0x2310, bus_.now_ns);
  bus_.run(1.0);
  EXPECT_EQ(status(), "can0: drive 2: fault: overcurrent (2310); start this program again to reset it");
  for (const std::uint8_t node : {1, 2, 3}) EXPECT_EQ(bus_.rpm(node), 0.0);
  EXPECT_EQ(bus_.drive(1).state(), DriveState::kEnabled);
  bus_.client->take_sample();
  bus_.run(0.1);
  EXPECT_TRUE(bus_.client->take_sample()) << "a base that is pushed is still seen";
  bus_.run(10.0);
  EXPECT_EQ(bus_.drive(2).resets(), 0u);
  EXPECT_FALSE(bus_.client->up());
}

TEST_F(Cia402DrivesTest, AFaultThatStandsAfterTheResetOfADeliberateStartIsResetOnce) {
  turn_on_the_spot();
  bus_.drives.fail(2, 0x2310, bus_.now_ns);
  bus_.run(1.0);
  bus_.start();
  bus_.bring_up();
  EXPECT_EQ(bus_.drive(2).state(), DriveState::kEnabled);
  bus_.start();
  bus_.run(0.035);  // it has come up
  bus_.drives.fail(1, 0x3220, bus_.now_ns);
  bus_.bring_up();
  EXPECT_EQ(bus_.drive(1).resets(), 1u);
}

TEST_F(Cia402DrivesTest, ASilentDriveIsSaidTheOthersStopAndItComesBack) {
  turn_on_the_spot();
  bus_.drive(3).faults.silent = true;
  bus_.run(0.5);
  EXPECT_THAT(status(), HasSubstr("drive 3: no heartbeat for 0.2 s"));
  for (const std::uint8_t node : {1, 2, 3}) EXPECT_EQ(bus_.rpm(node), 0.0) << int{node};
  EXPECT_NE(bus_.drive(3).state(), DriveState::kEnabled) << "it was told a quick stop";
  bus_.drive(3).faults.silent = false;
  bus_.client->drive({});
  bus_.bring_up();
  EXPECT_EQ(bus_.drive(3).boots(), 1u) << "it was not reset";
}

TEST_F(Cia402DrivesTest, ADriveThatRestartsByItselfIsSetUpAgain) {
  turn_on_the_spot();
  bus_.drive(1).power_cycle(bus_.now_ns);
  bus_.run(0.1);
  EXPECT_EQ(status(), "can0: drive 1: it has restarted by itself");
  bus_.client->drive({});
  bus_.bring_up();
  EXPECT_EQ(bus_.drive(1).boots(), 2u);
}

/// Our heartbeat was gone for so long that every drive has its fault, and is back.
class Cia402HeartbeatLost : public Cia402DrivesTest {
 protected:
  void expect_to_obey_again(double within_s) {
    bus_.run(within_s);
    ASSERT_TRUE(bus_.client->up()) << status();
    for (const std::uint8_t node : {1, 2, 3}) {
      EXPECT_EQ(bus_.drive(node).resets(), 1u);
      EXPECT_EQ(bus_.drive(node).target_rpm(), 0) << "nobody has asked for anything since";
      EXPECT_EQ(bus_.rpm(node), 0.0);
    }
    bus_.client->drive({0.0, 0.0, kTurn_radps});
    bus_.run(0.5);
    for (const std::uint8_t node : {1, 2, 3}) EXPECT_NEAR(bus_.rpm(node), kTurning_rpm, 0.5);
  }
};

TEST_F(Cia402HeartbeatLost, ByACableThatWasOutForASecondTheWheelsObeyAgainWithinTwo) {
  turn_on_the_spot();
  bus_.unplug(1.0);
  for (const std::uint8_t node : {1, 2, 3}) ASSERT_EQ(bus_.drive(node).state(), DriveState::kFault);
  expect_to_obey_again(1.4);
}

TEST_F(Cia402HeartbeatLost, ByAStallTheDrivesComeBackByThemselves) {
  turn_on_the_spot();
  bus_.stall(0.5);
  expect_to_obey_again(1.4);
}

TEST_F(Cia402HeartbeatLost, IsSaidUntilItIsResetAndNotBeforeOurHeartbeatFlows) {
  turn_on_the_spot();
  bus_.stall(0.5);
  bus_.run(0.15);
  EXPECT_EQ(bus_.drive(1).resets(), 0u);
  EXPECT_THAT(status(), HasSubstr("drive 1: fault: heartbeat lost (8130); drive 2: "));
}

TEST_F(Cia402HeartbeatLost, BesideAnotherFaultNothingIsReset) {
  turn_on_the_spot();
  bus_.drives.fail(2, 0x2310, bus_.now_ns);
  bus_.run(0.1);
  bus_.unplug(1.0);
  bus_.run(5.0);
  EXPECT_FALSE(bus_.client->up());
  EXPECT_EQ(bus_.drive(2).resets(), 0u);
  EXPECT_THAT(status(), HasSubstr("start this program again to reset it"));
  EXPECT_EQ(bus_.drive(1).state(), DriveState::kEnabled) << "it had no other";
}

TEST_F(Cia402HeartbeatLost, WhereTheDriveDoesNotSayItsErrorItsFaultStays) {
  for (const std::uint8_t node : {1, 2, 3}) bus_.drive(node).factory.erase(EmulatedDrive::key({0x603F, 0}));
  turn_on_the_spot();
  bus_.unplug(1.0);
  bus_.run(5.0);
  EXPECT_FALSE(bus_.client->up());
  EXPECT_EQ(bus_.drive(1).resets(), 0u);
  EXPECT_THAT(status(), HasSubstr("drive 1: fault: no emergency was received; start this program again to reset it"));
}

TEST_F(Cia402DrivesTest, BusOffIsSaidInWordsAndTheBusOpenedAgain) {
  turn_on_the_spot();
  bus_.drives.say({.id = CAN_ERR_BUSOFF, .error = true});
  bus_.run(0.002);
  EXPECT_EQ(status(), "can0: bus off");
  EXPECT_FALSE(bus_.client->up());
  bus_.client->drive({});
  bus_.run(0.099);
  bus_.bring_up();
}

TEST_F(Cia402DrivesTest, APulledCableStopsTheWheels) {
  turn_on_the_spot();
  bus_.plugged = false;
  bus_.run(1.0);
  EXPECT_EQ(status(), "no bus can0: no such device");
  bus_.stall(0.001);
  for (const std::uint8_t node : {1, 2, 3}) EXPECT_EQ(bus_.rpm(node), 0.0);
}

TEST_F(Cia402DrivesTest, WhatTheInterfaceSaysOfItselfIsSaidForAWhile) {
  bus_.bring_up();
  bus_.drives.say({.id = CAN_ERR_ACK, .error = true});
  bus_.run(0.002);
  EXPECT_THAT(status(), HasSubstr("; the interface says: no acknowledgement"));
  EXPECT_TRUE(bus_.client->up());
  bus_.run(1.1);
  EXPECT_THAT(status(), Not(HasSubstr("interface")));
}

TEST_F(Cia402DrivesTest, StopTellsEveryDriveAQuickStopAndNothingMore) {
  turn_on_the_spot();
  bus_.client->stop();
  for (const EmulatedDrive& drive : bus_.drives.drives()) EXPECT_EQ(drive.state(), DriveState::kQuickStop);
  bus_.drives.recording = true;
  bus_.run(0.2);
  EXPECT_TRUE(bus_.drives.taken().empty());
}

TEST_F(Cia402DrivesTest, SaysWhenItIsToBeCalledAgain) {
  EXPECT_EQ(bus_.client->next_ns(), 0);
  bus_.bring_up();
  for (int i = 0; i < 100; ++i) {
    bus_.run(0.001);
    EXPECT_GT(bus_.client->next_ns(), bus_.now_ns - kMs);
    EXPECT_LE(bus_.client->next_ns(), bus_.now_ns + 10 * kMs);
  }
}

TEST_F(Cia402DrivesTest, AHeartbeatLeavesEvery50ms) {
  bus_.bring_up();
  bus_.drives.recording = true;
  bus_.run(1.0);
  EXPECT_EQ(std::ranges::count(bus_.drives.taken(), heartbeat(127, NodeState::kOperational)), 20);
  EXPECT_EQ(std::ranges::count(bus_.drives.taken(), sync()), 100);
}

}  // namespace
}  // namespace trivela::hal::cia402
