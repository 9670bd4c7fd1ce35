// The drives of a world's base and the backend of a robot, over the bus between them.
#include "emulators/cia402/emulated_wheels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "hal/can/can_line.hpp"
#include "hal/cia402/cia402_wheels.hpp"

namespace trivela::hal {
namespace {

constexpr std::chrono::seconds kPlenty{20};
constexpr double kUnit_radps = 2.0 * 3.14159265 / 60.0 / EmulatedWheels::kGear;  // of a wheel: 1 rpm of its motor

class EmulatedWheelsTest : public testing::TestWithParam<config::Cia402Device> {
 protected:
  EmulatedWheelsTest() : world(emulated_wheels(GetParam(), base)) {
    config::Cia402Device host = GetParam();
    const std::string setting = world->setting();
    host.port = setting.substr(setting.find('"') + 1, setting.size() - setting.find('"') - 2);
    wheels = std::make_unique<cia402::Cia402Wheels>(can::can_line(host.port), host, base);
  }

  bool read_until(const std::function<bool(const WheelSample&)>& done) {
    const auto end = std::chrono::steady_clock::now() + kPlenty;
    while (std::chrono::steady_clock::now() < end) {
      if (const auto sample = wheels->read(kPlenty); sample && done(*sample)) return true;
    }
    return false;
  }

  const kicking::WheelBase base{};
  std::unique_ptr<EmulatedWheels> world;
  std::unique_ptr<Wheels> wheels;
};

TEST_P(EmulatedWheelsTest, WhatTheWorldSaysOfTheWheelsIsWhatAHostMeasures) {
  ASSERT_TRUE(world->wait_for_host(kPlenty));
  const std::array<double, 4> turning{3.0, -20.0, 0.7, 0.0};
  world->show(turning);
  EXPECT_TRUE(read_until([&](const WheelSample& sample) {
    bool alike = sample.wheel_count == 3;
    for (std::size_t i = 0; i < 3; ++i) alike = alike && std::abs(sample.wheel_radps[i] - turning[i]) <= kUnit_radps;
    return alike;
  }));
}

TEST_P(EmulatedWheelsTest, TheMotionThatAHostOrdersIsWhereTheWorldsBaseGoes) {
  ASSERT_TRUE(world->wait_for_host(kPlenty));
  const kicking::Twist ordered{0.4, -1.5, 0.9};
  kicking::Twist told{};
  ASSERT_TRUE(read_until([&](const WheelSample&) {
    wheels->drive(ordered, 0);  // each cycle, as odometry does: one from before the drives are up does not count
    told = world->set_point();
    return std::abs(told.vx_mps - ordered.vx_mps) < 0.001;
  }));
  EXPECT_NEAR(told.vy_mps, ordered.vy_mps, 0.001);
  EXPECT_NEAR(told.omega_radps, ordered.omega_radps, 0.005);
}

TEST_P(EmulatedWheelsTest, TheWorldsBaseStandsWhenItsHostIsGone) {
  ASSERT_TRUE(world->wait_for_host(kPlenty));
  ASSERT_TRUE(read_until([&](const WheelSample&) {
    wheels->drive({0.0, 1.0, 0.0}, 0);
    return world->set_point().vy_mps > 0.9;
  }));
  wheels.reset();
  const auto end = std::chrono::steady_clock::now() + kPlenty;
  while (world->set_point().vy_mps != 0.0 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  EXPECT_EQ(world->set_point().vy_mps, 0.0);
}

// A heartbeat that lasts so long that a busy machine stops no wheel.
INSTANTIATE_TEST_SUITE_P(Hosts, EmulatedWheelsTest,
                         testing::Values(config::Cia402Device{.heartbeat_s = 10.0},
                                         config::Cia402Device{.nodes = {3, 1, 4}, .reversed = {1}, .heartbeat_s = 10.0},
                                         config::Cia402Device{.gear = 12.0, .rpm_per_unit = 0.1, .heartbeat_s = 10.0}),
                         [](const auto& of) {
                           const auto& nodes = of.param.nodes;
                           return of.param.gear        ? std::string("gear")
                                  : nodes.front() == 1 ? std::string("in_order")
                                                       : std::string("reversed");
                         });

TEST(EmulatedWheels, WheelsOnTheBusHaveNoDrives) { EXPECT_EQ(emulated_wheels(config::BusDevice{}, {}), nullptr); }

}  // namespace
}  // namespace trivela::hal
