// Drives that are listened to: what they say is heard, and nothing makes them turn.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/hal/drives_on_a_bus.hpp"

namespace trivela::hal::cia402 {
namespace {

using ::testing::HasSubstr;
using tests::DrivesOnABus;

class Cia402Listening : public testing::Test {
 protected:
  Cia402Listening() {
    bus_.drives.recording = true;
    bus_.start(WheelsUse::kListen);
  }

  /// Frames to the drives that began with this identifier, whichever node.
  std::ptrdiff_t told(std::uint32_t function) const {
    return std::ranges::count_if(bus_.drives.taken(),
                                 [&](const can::Frame& frame) { return (frame.id & ~0x7FU) == function; });
  }

  DrivesOnABus bus_;
};

TEST_F(Cia402Listening, NothingIsPoweredResetOrToldAnything) {
  bus_.run(1.0);
  ASSERT_TRUE(bus_.client->up()) << bus_.client->status();
  bus_.client->drive_wheel(1, 2.0);
  bus_.run(0.5);
  bus_.client->drive({1.0, 0.0, 0.0});
  bus_.run(0.5);
  bus_.client->stop();
  for (const EmulatedDrive& drive : bus_.drives.drives()) {
    EXPECT_EQ(drive.state(), DriveState::kSwitchOnDisabled);
    EXPECT_EQ(drive.boots(), 0u);
    EXPECT_EQ(drive.resets(), 0u);
  }
  EXPECT_GT(told(kSync), 0);
  EXPECT_EQ(told(kRxPdo1), 0) << "a controlword";
  EXPECT_EQ(told(kHeartbeat), 0) << "which they would miss afterwards";
}

TEST_F(Cia402Listening, AFaultStaysAndIsSaid) {
  bus_.run(1.0);
  bus_.drives.fail(2, 0x2310, bus_.now_ns);
  bus_.run(4.0);
  EXPECT_EQ(bus_.drive(2).state(), DriveState::kFault);
  EXPECT_EQ(bus_.drive(2).resets(), 0u);
  EXPECT_TRUE(bus_.client->up()) << "it answers";
  EXPECT_EQ(bus_.client->status(),
            "can0: listened to, not driven: drive 1: switch on disabled; drive 2: fault: overcurrent (2310); "
            "drive 3: switch on disabled");
}

TEST_F(Cia402Listening, AWheelThatIsTurnedByHandIsSeen) {
  bus_.drive(2).measured_rpm = 2.0 * 12.0 * 60.0 / (2.0 * std::numbers::pi);
  bus_.run(1.0);
  const auto sample = bus_.client->take_sample();
  ASSERT_TRUE(sample) << bus_.client->status();
  EXPECT_EQ(sample->wheel_radps[0], 0.0);
  EXPECT_NEAR(sample->wheel_radps[1], 2.0, 0.01);
}

TEST_F(Cia402Listening, ASilentDriveIsSaidAndToldNoStop) {
  bus_.run(1.0);
  bus_.drive(3).faults.silent = true;
  bus_.run(1.0);
  EXPECT_FALSE(bus_.client->up());
  EXPECT_THAT(bus_.client->status(), HasSubstr("drive 3: "));
  EXPECT_EQ(told(kRxPdo1), 0);
}

TEST_F(Cia402Listening, WhoDrivesAfterwardsFindsThemAsEver) {
  bus_.run(1.0);
  bus_.client->stop();
  bus_.run(1.0);
  EXPECT_EQ(bus_.drive(1).state(), DriveState::kSwitchOnDisabled) << "nobody's heartbeat is missing";
  bus_.start();
  bus_.bring_up();
  EXPECT_EQ(bus_.drive(1).boots(), 1u);
}

}  // namespace
}  // namespace trivela::hal::cia402
