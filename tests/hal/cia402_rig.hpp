#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "emulators/cia402/emulated_wheels.hpp"
#include "hal/can/can_line.hpp"
#include "hal/cia402/cia402_wheels.hpp"
#include "tests/hal/board_on_a_line.hpp"

namespace trivela::tests {

/// Three emulated drives, the backend that speaks to them, and what a contract asks of both. A heartbeat that lasts
/// so long that a busy machine stops no wheel.
class DrivesOnALine {
 public:
  static constexpr double kGear = 12.0;

  DrivesOnALine() { EXPECT_TRUE(device->connected(kTimeout)) << device->status(); }

  static std::unique_ptr<hal::Wheels> open(const std::string& port, double heartbeat_s = 10.0) {
    const config::Cia402Device settings{.port = port, .gear = kGear, .ramp = 1'000'000, .heartbeat_s = heartbeat_s};
    return std::make_unique<hal::cia402::Cia402Wheels>(hal::can::can_line(port), settings, kicking::WheelBase{});
  }

  /// Waits until every drive was told `n` set-points more: what was ordered before is among them.
  void wait_for_cycles(std::uint64_t n) {
    std::uint64_t before = 0;
    const auto answers = [](const hal::cia402::EmulatedDrives& drives) { return drives.drives().back().answers(); };
    emulator.with_board([&](const auto& drives) { before = answers(drives); });
    EXPECT_TRUE(emulator.wait(kTimeout, [&](const auto& drives) { return answers(drives) >= before + n; }));
  }

  /// The motion that the motors are told, to 1/64: they are told whole rpm.
  kicking::Twist told() {
    constexpr double kPerRpm = 2.0 * std::numbers::pi / 60.0 / kGear;
    std::array<double, 4> wheel_radps{};
    emulator.with_board([&](const hal::cia402::EmulatedDrives& drives) {
      for (std::size_t i = 0; i < 3; ++i) wheel_radps[i] = drives.drives()[i].target_rpm() * kPerRpm;
    });
    const kicking::Twist twist = kicking::OmniKinematics{kicking::WheelBase{}}.twist(wheel_radps);
    const auto rounded = [](double value) { return std::round(value * 64.0) / 64.0; };
    return {rounded(twist.vx_mps), rounded(twist.vy_mps), rounded(twist.omega_radps)};
  }

  hal::cia402::Emulator emulator{std::uint8_t{3}};
  std::unique_ptr<hal::Wheels> device = open(emulator.address());
};

}  // namespace trivela::tests
