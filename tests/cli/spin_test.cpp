// One wheel of a robot that is not there: what is asked of it, and what is said of what it did.
#include "cli/hardware/tasks.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <csignal>

#include "cli/verbs.hpp"

namespace trivela::cli {
namespace {

using kicking::Twist;
using testing::HasSubstr;

/// A base whose wheels turn as asked, in the order and with the signs of its cables.
class CabledWheels final : public hal::Wheels {
 public:
  explicit CabledWheels(config::WheelBase base) : base_(std::move(base)) {}

  bool connected(std::chrono::nanoseconds) override { return lost_after < 0 || commands < lost_after; }
  std::string status() const override { return "can0: the bus is cut"; }
  std::optional<hal::WheelSample> read(std::chrono::nanoseconds) override {
    if (silent_after >= 0 && commands >= silent_after) return std::nullopt;
    return std::exchange(sample_, std::nullopt);
  }
  void drive(const Twist& twist, std::int64_t t_ns) override {
    hal::WheelSample sample{
        .t_ns = t_ns, .wheel_count = static_cast<int>(base_.wheel_angles_rad.size()), .gyro_radps = {}};
    for (std::size_t i = 0; i < base_.wheel_angles_rad.size(); ++i) {
      const double angle = base_.wheel_angles_rad[i];
      sample.wheel_radps[i] = sign *
                              (-std::sin(angle) * twist.vx_mps + std::cos(angle) * twist.vy_mps +
                               base_.wheel_distance_m * twist.omega_radps) /
                              base_.wheel_radius_m;
    }
    take(sample);
  }
  bool drive_wheel(int wheel, double radps, std::int64_t t_ns) override {
    if (!by_wheel) return false;
    hal::WheelSample sample{
        .t_ns = t_ns, .wheel_count = static_cast<int>(base_.wheel_angles_rad.size()), .gyro_radps = {}};
    sample.wheel_radps[static_cast<std::size_t>(wheel)] = sign * radps;
    take(sample);
    return true;
  }

  double sign = 1.0;
  bool by_wheel = false;
  int stop_after = -1;    ///< commands, until somebody asks to stop
  int lost_after = -1;    ///< commands, the link
  int silent_after = -1;  ///< commands, no samples
  int commands = 0;
  hal::WheelSample last;

 private:
  void take(const hal::WheelSample& sample) {
    last = sample;
    sample_ = sample;
    if (++commands == stop_after) std::raise(SIGTERM);
  }

  config::WheelBase base_;
  std::optional<hal::WheelSample> sample_;
};

constexpr Spin kSpin{.wheel = 1, .radps = 2.0, .seconds = 0.1};

TEST(Spin, OneWheelTurnsAndTheBaseStandsAfterwards) {
  SignalInbox signals;
  const config::WheelBase base;
  CabledWheels wheels{base};
  testing::internal::CaptureStdout();
  EXPECT_EQ(spin_wheel(kSpin, wheels, base, signals), kDone);
  EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("wheel 1 0.00, wheel 2 2.00, wheel 3 0.00 rad/s"));
  EXPECT_GT(wheels.commands, 2);
  for (const double radps : wheels.last.wheel_radps) EXPECT_EQ(radps, 0.0);
}

TEST(Spin, WhoeverStopsItFindsTheWheelsAtRest) {
  SignalInbox signals;
  const config::WheelBase base;
  CabledWheels wheels{base};
  wheels.stop_after = 2;
  EXPECT_EQ(spin_wheel({.wheel = 0, .radps = 2.0, .seconds = 3600.0}, wheels, base, signals), kFailed);
  EXPECT_EQ(wheels.commands, 3);
  for (const double radps : wheels.last.wheel_radps) EXPECT_EQ(radps, 0.0);
}

/// What is thrown by a spin of wheels that are lost in it, and what was said before.
std::string sentence_of_the_lost(CabledWheels& wheels, double seconds) {
  SignalInbox signals;
  testing::internal::CaptureStdout();
  std::string sentence;
  try {
    spin_wheel({.wheel = 0, .radps = 2.0, .seconds = seconds}, wheels, config::WheelBase{}, signals);
  } catch (const std::runtime_error& error) {
    sentence = error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "") << "a figure of before";
  return sentence;
}

TEST(Spin, ALostLinkEndsItAtOnceAndNobodyKnowsWhetherTheWheelStands) {
  CabledWheels wheels{config::WheelBase{}};
  wheels.lost_after = 2;
  EXPECT_EQ(sentence_of_the_lost(wheels, 3600.0),
            "link to the wheels lost, can0: the bus is cut: whether wheel 1 stands is not known; use the stop button");
  EXPECT_EQ(wheels.commands, 3) << "and they were told to stand, should they hear it";
}

TEST(Spin, WheelsThatFallSilentAreLost) {
  CabledWheels wheels{config::WheelBase{}};
  wheels.silent_after = 2;
  EXPECT_THAT(sentence_of_the_lost(wheels, 0.1), HasSubstr("whether wheel 1 stands is not known"));
}

TEST(Spin, AWheelThatTurnsTheOtherWayFails) {
  SignalInbox signals;
  const config::WheelBase base;
  CabledWheels wheels{base};
  wheels.sign = -1.0;
  testing::internal::CaptureStderr();
  EXPECT_EQ(spin_wheel(kSpin, wheels, base, signals), kFailed);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("wheel 2: it turned the other way"));
}

TEST(Spin, FourWheelsNeedADeviceThatTakesThemOneByOne) {
  SignalInbox signals;
  const config::WheelBase base{.wheel_angles_rad = {0.7, 2.4, 3.9, 5.5}};
  CabledWheels wheels{base};
  EXPECT_THROW(spin_wheel(kSpin, wheels, base, signals), std::runtime_error);
  wheels.by_wheel = true;
  EXPECT_EQ(spin_wheel(kSpin, wheels, base, signals), kDone);
}

TEST(Spin, WhatIsWrongIsSaid) {
  EXPECT_EQ(spin_problem(kSpin, {{0.1, 1.9, -0.1}}), "");
  EXPECT_EQ(spin_problem(kSpin, {{0.0, 0.1, 0.0}}), "it did not turn");
  EXPECT_EQ(spin_problem(kSpin, {{0.0, 0.0, 2.0}}), "wheel 3 turned in its place: their order is another one");
  EXPECT_EQ(spin_problem(kSpin, {{0.0, 46.0, 0.0}}), "it turned 23.00 times as fast: gear or encoder");
  EXPECT_EQ(spin_problem(kSpin, {{0.9, 2.0, 0.0}}), "wheel 1 turned with it");
  EXPECT_EQ(spin_problem(kSpin, {{0.0}}), "its speed was not reported");
}

}  // namespace
}  // namespace trivela::cli
