// What a set-point and a reading are in the units of the drives, and the settings that say so.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/hal/drives_on_a_bus.hpp"

namespace trivela::hal::cia402 {
namespace {

using tests::DrivesOnABus;

constexpr double kTurn_radps = 2.0;
/// Each motor's speed when the base of the default robot turns on the spot, gear 12.
constexpr double kTurning_rpm = kTurn_radps * 0.22 / 0.05 * 12.0 * 60.0 / (2.0 * std::numbers::pi);

TEST(Cia402Scale, ASetPointThatIsTooFastKeepsItsDirection) {
  DrivesOnABus bus;
  bus.bring_up();
  bus.client->drive({0.0, 0.0, 1e3});
  bus.run(0.1);
  EXPECT_EQ(bus.drive(1).target_rpm(), 10000);
  bus.client->drive({0.0, 100.0, 0.0});
  bus.run(0.1);
  EXPECT_EQ(bus.drive(1).target_rpm(), 10000);
  EXPECT_EQ(bus.drive(2).target_rpm(), -10000);
  EXPECT_EQ(bus.drive(3).target_rpm(), 0);
  bus.client->drive({0.0, std::nan(""), 1.0});
  bus.run(0.1);
  EXPECT_EQ(bus.drive(1).target_rpm(), 0);
  bus.client->drive({1e308, 1e308, 1e308});
  bus.run(0.1);
  EXPECT_EQ(bus.drive(1).target_rpm(), 0);
}

TEST(Cia402Scale, AReversedMotorAndAnotherUnitCountTheOtherWay) {
  DrivesOnABus bus{{.reversed = {2}, .gear = 12.0, .rpm_per_unit = 0.1}};
  bus.bring_up();
  bus.client->drive({0.0, 0.0, kTurn_radps});
  bus.run(0.1);
  EXPECT_EQ(bus.drive(1).target_rpm(), std::lround(kTurning_rpm * 10.0));
  EXPECT_EQ(bus.drive(2).target_rpm(), -std::lround(kTurning_rpm * 10.0));
  bus.run(1.0);
  bus.client->take_sample();
  bus.run(0.02);
  EXPECT_NEAR(bus.client->take_sample().value().wheel_radps[1], 8.8, 0.01);
}

TEST(Cia402Scale, UnitAndGearAreReadWhereTheyAreNotSet) {
  DrivesOnABus bus{{}};
  for (const std::uint8_t node : {1, 2, 3}) {
    bus.drive(node).factory[EmulatedDrive::key({0x60A9, 0})] = {0xFDB44700, 4};
    bus.drive(node).factory[EmulatedDrive::key({0x6091, 1})] = {46, 4};
    bus.drive(node).factory[EmulatedDrive::key({0x6091, 2})] = {2, 4};
  }
  bus.bring_up();
  EXPECT_EQ(bus.client->status(), "can0: 3 drives in operation, 0.001 rpm a unit, gear 23");
}

TEST(Cia402Scale, UnitAndGearThatNobodyKnowsAreRefused) {
  DrivesOnABus bus{{}};
  bus.drive(1).factory[EmulatedDrive::key({0x60A9, 0})] = {0x00B50300, 4};
  bus.drive(2).factory[EmulatedDrive::key({0x1018, 1})] = {0x9A, 4};
  bus.run(1.0);
  EXPECT_EQ(bus.client->status(),
            "can0: drive 1: its unit of velocity (object 60A9) is 00B50300, not rpm: set hal.cia402.rpm_per_unit; "
            "drive 2: it does not say its unit of velocity (object 60A9): set hal.cia402.rpm_per_unit; "
            "drive 3: it does not know its gear (object 6091): set hal.cia402.gear");
}

std::string refusal(const config::Cia402Device& settings) try {
  DrivesOnABus bus{settings};
  return "accepted";
} catch (const std::runtime_error& error) {
  return error.what();
}

TEST(Cia402Settings, ThatDoNotGoTogetherAreRefused) {
  EXPECT_EQ(refusal({.nodes = {1, 2}}), "hal.cia402.nodes: 2 drives for a base of 3 wheels (base.wheel_angles_rad)");
  EXPECT_EQ(refusal({.nodes = {1, 2, 2}}), "hal.cia402: node 2 is there twice (nodes and master)");
  EXPECT_EQ(refusal({.nodes = {1, 2, 127}}), "hal.cia402: node 127 is there twice (nodes and master)");
  EXPECT_EQ(refusal({.reversed = {4}}), "hal.cia402.reversed: node 4 is none of hal.cia402.nodes");
}

}  // namespace
}  // namespace trivela::hal::cia402
