// The gyro of one device in the samples of another's wheels; the emulated MTi on its pseudo-terminal.
#include <gtest/gtest.h>

#include <thread>

#include "emulators/mti/emulated_mti.hpp"
#include "hal/gyro.hpp"
#include "hal/mti/mti.hpp"
#include "tests/hal/board_on_a_line.hpp"

namespace trivela::hal {
namespace {

using std::chrono::nanoseconds;
using tests::kTimeout;

/// Wheels that say what the test does, at the instant that it names.
class ToldBase final : public Wheels {
 public:
  explicit ToldBase(WheelSample& sample) : sample_(sample) {}
  bool connected(nanoseconds) override { return true; }
  std::optional<WheelSample> read(nanoseconds) override { return sample_; }
  void drive(const kicking::Twist& set_point, std::int64_t t_ns) override {
    sample_.wheel_radps[0] = set_point.omega_radps;
    sample_.t_ns = t_ns;
  }
  std::string status() const override { return "wheels"; }

 private:
  WheelSample& sample_;
};

class ToldGyro final : public Gyro {
 public:
  explicit ToldGyro(const std::optional<GyroSample>& sample) : sample_(sample) {}
  std::optional<GyroSample> newest() const override { return sample_; }
  std::string status() const override { return "gyro"; }

 private:
  const std::optional<GyroSample>& sample_;
};

TEST(GyroWheels, TakeTheGyroOfTheirInstantAndNoOther) {
  WheelSample said{.t_ns = 1'000'000'000, .wheel_count = 3, .wheel_radps = {1, 2, 3}, .gyro_radps = 9.0};
  std::optional<GyroSample> turn;
  GyroWheels wheels{std::make_unique<ToldBase>(said), std::make_unique<ToldGyro>(turn)};
  EXPECT_EQ(wheels.read({})->gyro_radps, std::nullopt) << "not that of the wheels' device either";
  turn = {1'000'000'000 - GyroWheels::kSameInstant_ns, 0.5};
  EXPECT_EQ(wheels.read({})->gyro_radps, 0.5);
  EXPECT_EQ(wheels.read({})->wheel_radps, said.wheel_radps);
  --turn->t_ns;
  EXPECT_EQ(wheels.read({})->gyro_radps, std::nullopt) << "it stands still";
  turn->t_ns = 1'000'000'001 + GyroWheels::kSameInstant_ns;
  EXPECT_EQ(wheels.read({})->gyro_radps, std::nullopt) << "of another clock";
}

TEST(GyroWheels, DriveAndSpeakAsTheWheelsDo) {
  WheelSample said;
  const std::optional<GyroSample> none;
  GyroWheels wheels{std::make_unique<ToldBase>(said), std::make_unique<ToldGyro>(none)};
  wheels.drive({0, 0, 4.0}, 7);
  EXPECT_EQ(said.wheel_radps[0], 4.0);
  EXPECT_EQ(said.t_ns, 7);
  EXPECT_EQ(wheels.status(), "wheels; gyro");
}

class MtiOnALine : public testing::Test {
 protected:
  bool until(const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + kTimeout;
    for (std::uint64_t said = 0; !done(); ++said) {
      if (std::chrono::steady_clock::now() > end) return false;
      emulator_.with_board([&](const auto& mti) { said = mti.said(); });
      if (!emulator_.wait(kTimeout, [=](const auto& mti) { return mti.said() > said; })) return false;
    }
    return true;
  }

  mti::Emulator emulator_;
  mti::MtiGyro gyro_{serial_line(emulator_.address()), {.port = emulator_.address()}};
};

TEST_F(MtiOnALine, ItsRateIsReadAndOfAnInstantThatPassed) {
  emulator_.with_board([](mti::EmulatedMti& mti) { mti.rate_radps = 1.25; });
  ASSERT_TRUE(until([&] { return gyro_.newest() && gyro_.newest()->gyro_radps == 1.25; })) << gyro_.status();
  const std::int64_t sampled_ns = gyro_.newest()->t_ns;  // read first: the two of a comparison come in any order
  EXPECT_LE(sampled_ns, tests::steady_ns());
}

TEST_F(MtiOnALine, BrokenMessagesCostOnlyThemselves) {
  emulator_.with_board([](mti::EmulatedMti& mti) {
    mti.faults = {.garbled_every = 2, .wrong_sums_every = 3};
    mti.rate_radps = -2.5;
  });
  EXPECT_TRUE(until([&] { return gyro_.newest() && gyro_.newest()->gyro_radps == -2.5; })) << gyro_.status();
}

TEST_F(MtiOnALine, ALostOneIsSaidAndHeardAgain) {
  emulator_.with_board([](mti::EmulatedMti& mti) { mti.faults.silent = true; });
  EXPECT_TRUE(until([&] {
    return gyro_.status().ends_with("the gyro is off, in configuration mode, or at another baud rate");
  })) << gyro_.status();
  emulator_.with_board([](mti::EmulatedMti& mti) { mti.faults.silent = false; });
  EXPECT_TRUE(until([&] { return gyro_.status().ends_with(": MTi"); })) << gyro_.status();
  emulator_.line().pull();
  const auto end = std::chrono::steady_clock::now() + kTimeout;
  while (gyro_.status().find("no gyro at") == std::string::npos && std::chrono::steady_clock::now() < end)
    std::this_thread::yield();
  EXPECT_NE(gyro_.status().find("no gyro at"), std::string::npos) << gyro_.status();
  emulator_.line().plug();
  EXPECT_TRUE(until([&] { return gyro_.status().ends_with(": MTi"); })) << gyro_.status();
}

// In the samples of wheels, as odometry takes them.
TEST(EmulatedGyro, TheTurnRateOfTheWorldIsWhatItsHostReadsWhicheverWayUpItIs) {
  for (const bool upside_down : {false, true}) {
    config::MtiDevice host{.upside_down = upside_down};
    const auto world = emulated_gyro(host);
    const std::string setting = world->setting();
    ASSERT_TRUE(setting.starts_with("hal.mti.port=\""));
    host.port = setting.substr(setting.find('"') + 1, setting.size() - setting.find('"') - 2);
    WheelSample said{.wheel_count = 3, .wheel_radps = {1, 2, 3}, .gyro_radps = {}};
    GyroWheels wheels{std::make_unique<ToldBase>(said), std::make_unique<mti::MtiGyro>(serial_line(host.port), host)};
    world->show(-1.75);
    const auto end = std::chrono::steady_clock::now() + kTimeout;
    std::optional<double> read;
    while (read != -1.75 && std::chrono::steady_clock::now() < end) {
      said.t_ns = tests::steady_ns();
      read = wheels.read({})->gyro_radps;
      std::this_thread::yield();
    }
    EXPECT_EQ(read, -1.75) << wheels.status();
  }
  EXPECT_EQ(emulated_gyro(config::WheelsGyro{}), nullptr);
}

}  // namespace
}  // namespace trivela::hal
