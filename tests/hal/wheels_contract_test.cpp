// What every backend of Wheels promises, run over each of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hal/board/board_kicker.hpp"
#include "hal/bus/bridge.hpp"
#include "hal/bus/sim_range_finder.hpp"
#include "hal/gyro.hpp"
#include "hal/open.hpp"
#include "tests/hal/bus_world.hpp"
#include "tests/hal/cia402_rig.hpp"

namespace trivela::hal {
namespace {

using std::chrono::milliseconds;

/// The samples that each rig's device has to say, in this order.
const std::vector<WheelSample> kSaid{{20'000'000, 3, {1.5, -2.5, 3.5, 0.0}, 0.25},
                                     {40'000'000, 3, {1.75, -2.0, 3.0, 0.0}, std::nullopt},
                                     {60'000'000, 4, {1.0, 2.0, 3.0, 4.0}, -0.5}};

/// A device that says what it is told to, and nothing by itself.
class ToldWheels {
 public:
  static constexpr bool kSpeaksByItself = false;
  static void expect_said(std::size_t i, const WheelSample& sample) {
    EXPECT_EQ(sample.t_ns, kSaid[i].t_ns);
    EXPECT_EQ(sample.wheel_count, kSaid[i].wheel_count);
    EXPECT_EQ(sample.wheel_radps, kSaid[i].wheel_radps);
    EXPECT_EQ(sample.gyro_radps, kSaid[i].gyro_radps);
  }
  static void fall_silent() {}
};

class BusRig : public ToldWheels {
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

/// Motors that turn at a speed of their own choice, and say so in each cycle.
class Cia402Rig {
 public:
  static constexpr bool kSpeaksByItself = true;

  Cia402Rig() {
    device->drive({0.0, 0.0, kTurn_radps}, 1);
    EXPECT_TRUE(line.emulator.wait(kPlenty, [](const cia402::EmulatedDrives& drives) {
      return std::ranges::all_of(drives.drives(),
                                 [](const auto& drive) { return drive.rpm(tests::steady_ns()) > 1.0; });
    }));
    line.wait_for_cycles(10);  // their ramps take a millisecond
  }
  void say(std::size_t) { said_t_ns_ = tests::steady_ns(); }
  void expect_said(std::size_t, WheelSample sample) {
    while (sample.t_ns < said_t_ns_) {
      const std::int64_t before_ns = sample.t_ns;
      sample = device->read(kPlenty).value();
      EXPECT_GT(sample.t_ns, before_ns);
    }
    EXPECT_LE(sample.t_ns, tests::steady_ns());
    EXPECT_EQ(sample.wheel_count, 3);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(sample.wheel_radps[i], kTurn_radps * 0.22 / 0.05, 0.01);
    EXPECT_EQ(sample.wheel_radps[3], 0.0);
    EXPECT_FALSE(sample.gyro_radps);
  }
  void fall_silent() {
    line.emulator.line().hold(true);
    while (device->read(milliseconds(50))) continue;
  }
  kicking::Twist followed(std::size_t) {
    line.wait_for_cycles(2);
    return line.told();
  }
  kicking::Twist after_destruction() {
    device.reset();
    EXPECT_TRUE(line.emulator.wait(kPlenty, [](const cia402::EmulatedDrives& drives) {
      return std::ranges::none_of(drives.drives(), [](const auto& drive) { return drive.target_rpm() != 0; });
    }));
    return line.told();
  }

  tests::DrivesOnALine line;
  std::unique_ptr<Wheels>& device = line.device;

 private:
  static constexpr double kTurn_radps = 2.0;
  std::int64_t said_t_ns_ = 0;
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
using Rigs = testing::Types<BusRig, Cia402Rig>;
TYPED_TEST_SUITE(WheelsContract, Rigs);

TYPED_TEST(WheelsContract, SamplesComeWholeAndInTimeOrder) {
  auto& wheels = *this->rig_.device;
  for (std::size_t i = 0; i < kSaid.size(); ++i) {
    this->rig_.say(i);
    const auto sample = wheels.read(kPlenty);
    ASSERT_TRUE(sample);
    this->rig_.expect_said(i, *sample);
  }
}

TYPED_TEST(WheelsContract, ReadReturnsWithoutDataWhenTheTimeoutIsOver) {
  this->read_all();
  this->rig_.fall_silent();
  auto& wheels = *this->rig_.device;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(wheels.read(milliseconds(20)));
  const auto waited = std::chrono::steady_clock::now() - start;
  EXPECT_GE(waited, milliseconds(20));
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

/// A gyro that another process reads: its sample is of the wheels' time or it is none.
class GyroBeside : public testing::Test {
 protected:
  void turn(std::int64_t t_ns, double gyro_radps, std::uint8_t robot_id = kRobot, bool emulated = false) {
    msg::DeviceGyro sample{};
    sample.robot_id = robot_id;
    sample.t_ns = t_ns;
    sample.gyro_radps = gyro_radps;
    sample.emulated = emulated;
    gyro_.write(sample);
  }
  /// That wheels of this instant are given, which have none.
  std::optional<double> gyro_at(std::int64_t t_ns) { return sample_at(t_ns).gyro_radps; }
  WheelSample sample_at(std::int64_t t_ns) {
    msg::DeviceWheels sample{};
    sample.robot_id = kRobot;
    sample.t_ns = t_ns;
    sample.wheel_count = 3;
    sample.gyro_radps = std::nan("");
    rig_.world.samples.write(sample);
    const auto read = rig_.device->read(kPlenty);
    EXPECT_TRUE(read);
    return read.value_or(WheelSample{});
  }

  BusRig rig_;
  bus::Writer<msg::DeviceGyro> gyro_{rig_.world.there};

 private:
  /// From the first that arrives on what follows does, too, before what is written after it.
  void SetUp() override {
    turn(1'000'000, 0.5);
    const auto deadline = std::chrono::steady_clock::now() + kPlenty;
    std::int64_t t_ns = 1'000'000;
    while (gyro_at(++t_ns) != 0.5) ASSERT_LT(std::chrono::steady_clock::now(), deadline);
  }
};

TEST_F(GyroBeside, IsGivenToWheelsThatHaveNone) {
  turn(30'000'000, 1.5);
  turn(35'000'000, 2.5);
  EXPECT_EQ(gyro_at(40'000'000), 2.5);
  rig_.say(2);
  EXPECT_EQ(rig_.device->read(kPlenty).value().gyro_radps, -0.5) << "the wheels have their own";
}

TEST_F(GyroBeside, IsNoneOfAnotherRobotsNorOfAnotherTime) {
  turn(80'000'000, 1.5, kRobot + 1);
  EXPECT_EQ(gyro_at(80'000'000), std::nullopt);
  turn(90'000'000, 2.5);
  EXPECT_EQ(gyro_at(141'000'000), std::nullopt) << "it stands still";
  turn(300'000'000, 3.5);
  EXPECT_EQ(gyro_at(249'000'000), std::nullopt) << "it runs ahead";
  EXPECT_EQ(gyro_at(251'000'000), 3.5);
}

TEST_F(GyroBeside, ThatSaysNoNumberIsNone) {
  turn(30'000'000, std::nan(""));
  EXPECT_EQ(gyro_at(40'000'000), std::nullopt);
}

TEST_F(GyroBeside, SaysWhetherItIsEmulated) {
  turn(30'000'000, 1.5, kRobot, true);
  const WheelSample sample = sample_at(40'000'000);
  EXPECT_EQ(sample.gyro_radps, 1.5);
  EXPECT_TRUE(sample.gyro_emulated);
  EXPECT_FALSE(sample.emulated);
}

TEST(BusWheels, SayWhetherTheyAreEmulated) {
  BusRig rig;
  rig.say(0);
  EXPECT_FALSE(rig.device->read(kPlenty).value().emulated);
  msg::DeviceWheels sample{};
  sample.robot_id = kRobot;
  sample.t_ns = kSaid[1].t_ns;
  sample.wheel_count = 3;
  sample.emulated = true;
  rig.world.samples.write(sample);
  EXPECT_TRUE(rig.device->read(kPlenty).value().emulated);
}

TEST(BusWheels, RefuseTheFutureAndAnotherClock) {
  bus::WirePair domains = bus::fresh_wire_pair();
  const bus::Participant there{domains.a, bus::RealTime{}};
  const bus::Participant here{domains.b, bus::RealTime{}};
  bus::Writer<msg::DeviceWheels> bridge{there};
  BusWheels wheels{here, kRobot};
  const std::int64_t now_ns = std::chrono::steady_clock::now().time_since_epoch().count();
  const std::int64_t of_the_day_ns = std::chrono::system_clock::now().time_since_epoch().count();
  for (const std::int64_t t_ns : {now_ns, now_ns + 600'000'000'000, of_the_day_ns, std::int64_t{-1}, now_ns + 1}) {
    msg::DeviceWheels sample{};
    sample.robot_id = kRobot;
    sample.t_ns = t_ns;
    sample.wheel_count = 3;
    bridge.write(sample);
    const bool ours = t_ns - now_ns <= 1 && t_ns >= now_ns;
    const auto read = wheels.read(ours ? kPlenty : std::chrono::nanoseconds{milliseconds(20)});
    EXPECT_EQ(read.has_value(), ours) << t_ns;
  }
}

TEST(BusWheels, AreNotConnectedWithoutABridge) {
  BusWheels wheels{bus::Participant{bus::fresh_domain()}, kRobot};
  EXPECT_FALSE(wheels.connected(milliseconds(20)));
}

TEST(Open, GivesTheBackendThatTheSettingsName) {
  const bus::Participant participant{bus::fresh_domain()};
  const Owner owner{participant, kRobot};
  const config::Hal simulated;
  EXPECT_NE(dynamic_cast<BusWheels*>(open_wheels(simulated, owner).get()), nullptr);
  EXPECT_NE(dynamic_cast<BusKicker*>(open_kicker(simulated, owner).get()), nullptr);
  for (const config::KickerDevice& board : {config::KickerDevice{config::IoBoardDevice{.port = "/nowhere/tty"}},
                                            config::KickerDevice{config::ReKickDevice{.port = "/nowhere/can"}}}) {
    const config::Hal boards{config::BusDevice{}, board};
    EXPECT_NE(dynamic_cast<BoardKicker*>(open_kicker(boards, owner).get()), nullptr);
  }
  const config::Hal drives{config::Cia402Device{.port = "/nowhere/can"}, config::BusDevice{}};
  EXPECT_NE(dynamic_cast<cia402::Cia402Wheels*>(open_wheels(drives, owner).get()), nullptr);
  config::Hal turning;
  turning.gyro = config::MtiDevice{.port = "/nowhere/tty"};
  EXPECT_NE(dynamic_cast<GyroWheels*>(open_wheels(turning, owner).get()), nullptr);
  EXPECT_NE(dynamic_cast<SimRangeFinder*>(open_range_finder(config::SimDevice{}, owner).get()), nullptr);
}

}  // namespace
}  // namespace trivela::hal
