// What every backend of Wheels promises, run over each of them.
#include <gtest/gtest.h>

#include <cmath>

#include "hal/board/board_kicker.hpp"
#include "hal/bus/bus_kicker.hpp"
#include "hal/bus/bus_wheels.hpp"
#include "hal/open.hpp"
#include "hal/replay/replay_kicker.hpp"
#include "hal/replay/replay_wheels.hpp"
#include "hal/sim/sim_range_finder.hpp"
#include "tests/hal/bus_world.hpp"
#include "tests/hal/recorded_log.hpp"

namespace trivela::hal {
namespace {

using std::chrono::milliseconds;

/// The samples that each rig's device has to say, in this order.
const std::vector<WheelSample> kSaid{{20'000'000, 3, {1.5, -2.5, 3.5, 0.0}, 0.25},
                                     {40'000'000, 3, {1.75, -2.0, 3.0, 0.0}, std::nullopt},
                                     {60'000'000, 4, {1.0, 2.0, 3.0, 4.0}, -0.5}};

class BusRig {
 public:
  BusRig() { EXPECT_TRUE(device->connected(kPlenty)); }

  /// Makes the device say sample i.
  void say(std::size_t i, std::uint8_t robot_id = kRobot) {
    const WheelSample& said = kSaid[i];
    msg::DeviceWheels sample{};
    sample.robot_id = robot_id;
    sample.t_ns = said.t_ns;
    sample.wheel_count = static_cast<std::uint8_t>(said.wheel_count);
    std::copy(said.wheel_radps.begin(), said.wheel_radps.end(), sample.wheel_radps);
    sample.gyro_radps = said.gyro_radps.value_or(std::nan(""));
    world.samples.write(sample);
  }

  /// What the motors follow after n more set-points.
  kicking::Twist followed(std::size_t n) {
    const auto drives = world.received(n);
    EXPECT_EQ(drives.size(), n);
    if (drives.empty()) return {9, 9, 9};
    EXPECT_EQ(drives.back().robot_id, kRobot);
    return {drives.back().vx_mps, drives.back().vy_mps, drives.back().omega_radps};
  }
  kicking::Twist after_destruction() {
    device.reset();
    return followed(1);
  }

  BusWorld<msg::DeviceWheels, msg::DeviceDrive> world;
  std::unique_ptr<Wheels> device = std::make_unique<BusWheels>(world.here, kRobot);
};

class ReplayRig {
 public:
  ReplayRig() {
    for (std::size_t i = 0; i < kSaid.size(); ++i) {
      const auto& s = kSaid[i];
      const auto seq = static_cast<std::int64_t>(i) + 1;
      log.wheels(kRobot + 1, seq, s.t_ns, {7, 7, 7}, 7);  // another robot's
      log.wheels(kRobot, seq, s.t_ns, {s.wheel_radps.begin(), s.wheel_radps.begin() + s.wheel_count},
                 s.gyro_radps.value_or(std::nan("")));
    }
    log.close();
    device = std::make_unique<ReplayWheels>(ReplayLog::open(log.file(), kRobot));
  }
  void say(std::size_t) {}
  kicking::Twist followed(std::size_t n) {
    const auto& drives = dynamic_cast<ReplayWheels&>(*device).drives();
    EXPECT_GE(drives.size(), n);
    return drives.empty() ? kicking::Twist{9, 9, 9} : drives.back().set_point;
  }
  kicking::Twist after_destruction() {
    device.reset();
    return {};  // there never was a motor
  }

  RecordedLog log;
  std::unique_ptr<Wheels> device;
};

template <class Rig>
class WheelsContract : public testing::Test {
 protected:
  Rig rig_;

  void read_all() {
    for (std::size_t i = 0; i < kSaid.size(); ++i) {
      rig_.say(i);
      ASSERT_TRUE(rig_.device->read(kPlenty));
    }
  }
};
using Rigs = testing::Types<BusRig, ReplayRig>;
TYPED_TEST_SUITE(WheelsContract, Rigs);

TYPED_TEST(WheelsContract, SamplesComeWholeAndInTimeOrder) {
  auto& wheels = *this->rig_.device;
  for (std::size_t i = 0; i < kSaid.size(); ++i) {
    this->rig_.say(i);
    const auto sample = wheels.read(kPlenty);
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->t_ns, kSaid[i].t_ns);
    EXPECT_EQ(sample->wheel_count, kSaid[i].wheel_count);
    EXPECT_EQ(sample->wheel_radps, kSaid[i].wheel_radps);
    EXPECT_EQ(sample->gyro_radps, kSaid[i].gyro_radps);
  }
}

TYPED_TEST(WheelsContract, ReadReturnsWithoutDataWhenTheTimeoutIsOver) {
  this->read_all();
  auto& wheels = *this->rig_.device;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(wheels.read(milliseconds(20)));
  const auto waited = std::chrono::steady_clock::now() - start;
  if (!wheels.ended()) {
    EXPECT_GE(waited, milliseconds(20));
  }
  EXPECT_LT(waited, std::chrono::seconds(2));
  EXPECT_FALSE(wheels.read(milliseconds(0)));
}

TYPED_TEST(WheelsContract, SetPointsAreTakenAtAnyTime) {
  auto& wheels = *this->rig_.device;
  wheels.drive({0.5, -1.5, 2.0}, 5);  // before any sample
  auto followed = this->rig_.followed(1);
  EXPECT_EQ(followed.vx_mps, 0.5);
  EXPECT_EQ(followed.vy_mps, -1.5);
  EXPECT_EQ(followed.omega_radps, 2.0);
  this->read_all();
  wheels.drive({0.25, 0.0, 0.0}, 70'000'000);  // after the last
  EXPECT_EQ(this->rig_.followed(1).vx_mps, 0.25);
}

TYPED_TEST(WheelsContract, ASetPointThatIsNoNumberIsZero) {
  this->rig_.device->drive({1.0, std::nan(""), 1.0}, 5);
  const auto followed = this->rig_.followed(1);
  EXPECT_EQ(followed.vx_mps, 0.0);
  EXPECT_EQ(followed.vy_mps, 0.0);
  EXPECT_EQ(followed.omega_radps, 0.0);
}

TYPED_TEST(WheelsContract, HasNotEndedBeforeItsLastSample) {
  auto& wheels = *this->rig_.device;
  for (std::size_t i = 0; i < kSaid.size(); ++i) {
    EXPECT_FALSE(wheels.ended());
    this->rig_.say(i);
    ASSERT_TRUE(wheels.read(kPlenty));
  }
  const bool ended = wheels.ended();
  EXPECT_FALSE(wheels.read(milliseconds(1)));
  EXPECT_EQ(wheels.ended(), ended);
}

TYPED_TEST(WheelsContract, DestructionLeavesTheBaseAtRest) {
  this->rig_.device->drive({0.5, 1.5, 2.0}, 5);
  this->rig_.followed(1);
  const auto followed = this->rig_.after_destruction();
  EXPECT_EQ(followed.vx_mps, 0.0);
  EXPECT_EQ(followed.vy_mps, 0.0);
  EXPECT_EQ(followed.omega_radps, 0.0);
}

TEST(BusWheels, PassesOverOtherRobotsAndSamplesOfThePast) {
  BusRig rig;
  rig.say(1);
  EXPECT_EQ(rig.device->read(kPlenty)->t_ns, 40'000'000);
  rig.say(0);
  rig.say(1);
  rig.say(2, kRobot + 1);
  rig.say(2);
  EXPECT_EQ(rig.device->read(kPlenty)->t_ns, 60'000'000);
  EXPECT_FALSE(rig.device->read(milliseconds(1)));
}

TEST(BusWheels, AreNotConnectedWithoutASimulator) {
  BusWheels wheels{bus::Participant{bus::fresh_domain()}, kRobot};
  EXPECT_FALSE(wheels.connected(milliseconds(20)));
}

TEST(ReplayWheels, EndWithTheLog) {
  ReplayRig rig;
  for (std::size_t i = 0; i < kSaid.size(); ++i) rig.device->read(kPlenty);
  EXPECT_TRUE(rig.device->ended());
}

TEST(ReplayWheels, ReadLogsOfManyPages) {
  RecordedLog log;
  constexpr std::int64_t kRows = 2500;
  for (std::int64_t i = 1; i <= kRows; ++i) log.wheels(kRobot, i, i * 1'000'000, {1, 2, 3}, 0);
  log.close();
  ReplayWheels wheels{ReplayLog::open(log.file(), kRobot)};
  std::int64_t last = 0;
  while (!wheels.ended()) {
    const auto sample = wheels.read(kPlenty);
    ASSERT_TRUE(sample);
    ASSERT_EQ(sample->t_ns, last + 1'000'000);
    last = sample->t_ns;
  }
  EXPECT_EQ(last, kRows * 1'000'000);
}

TEST(Open, GivesTheBackendThatTheSettingsName) {
  RecordedLog log;
  log.close();
  const bus::Participant participant{bus::fresh_domain()};
  const Owner owner{participant, kRobot};
  const config::Hal simulated;
  const config::Hal replayed{config::ReplayDevice{}, config::ReplayDevice{}, log.file()};
  EXPECT_NE(dynamic_cast<BusWheels*>(open_wheels(simulated, owner).get()), nullptr);
  EXPECT_NE(dynamic_cast<ReplayWheels*>(open_wheels(replayed, owner).get()), nullptr);
  EXPECT_NE(dynamic_cast<BusKicker*>(open_kicker(simulated, owner).get()), nullptr);
  EXPECT_NE(dynamic_cast<ReplayKicker*>(open_kicker(replayed, owner).get()), nullptr);
  for (const config::KickerDevice& board : {config::KickerDevice{config::IoBoardDevice{.port = "/nowhere/tty"}},
                                            config::KickerDevice{config::ReKickDevice{.port = "/nowhere/can"}}}) {
    const config::Hal boards{config::BusDevice{}, board, ""};
    EXPECT_NE(dynamic_cast<BoardKicker*>(open_kicker(boards, owner).get()), nullptr);
  }
  EXPECT_NE(dynamic_cast<SimRangeFinder*>(open_range_finder(config::SimDevice{}, owner).get()), nullptr);
}

}  // namespace
}  // namespace trivela::hal
