#include "emulators/cia402/emulated_wheels.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numbers>
#include <utility>

namespace trivela::hal::cia402 {
namespace {

std::vector<std::string> encoded(const EmulatedDrive::Frames& frames) {
  std::vector<std::string> said;
  for (const can::Frame& frame : frames) said.push_back(can::encode(frame));
  return said;
}

}  // namespace

EmulatedDrives::EmulatedDrives(std::uint8_t count) {
  for (std::uint8_t node = 1; node <= count; ++node) drives_.emplace_back(node);
}

std::vector<std::string> EmulatedDrives::take(std::string_view bytes, std::int64_t now_ns) {
  EmulatedDrive::Frames out;
  for (const can::Frame& frame : can::decode(bytes)) {
    if (recording) taken_.push_back(frame);
    for (EmulatedDrive& drive : drives_) drive.take(frame, now_ns, out);
  }
  return encoded(out);
}

std::vector<std::string> EmulatedDrives::tick(std::int64_t now_ns) {
  EmulatedDrive::Frames out = std::exchange(to_say_, {});
  for (EmulatedDrive& drive : drives_) drive.tick(now_ns, out);
  return encoded(out);
}

std::int64_t EmulatedDrives::next_ns() const {
  if (!to_say_.empty()) return 0;
  std::int64_t next_ns = kNever_ns;
  for (const EmulatedDrive& drive : drives_) next_ns = std::min(next_ns, drive.next_ns());
  return next_ns;
}

}  // namespace trivela::hal::cia402

namespace trivela::hal {
namespace {

constexpr cia402::Object kGearMotor{0x6091, 1}, kGearShaft{0x6091, 2};

/// Drives with nodes from 1 to the highest that the host names.
std::uint8_t drives_for(const config::Cia402Device& host) {
  return host.nodes.empty() ? std::uint8_t{0} : *std::ranges::max_element(host.nodes);
}

}  // namespace

EmulatedWheels::EmulatedWheels(const config::Cia402Device& host, const kicking::WheelBase& base)
    : host_(host), kinematics_(base), gear_(host.gear.value_or(kGear)), emulator_(drives_for(host)) {
  emulator_.with_board([&](cia402::EmulatedDrives& drives) {
    for (const std::uint8_t node : host_.nodes) {
      cia402::EmulatedDrive& drive = drives.drive(node);
      drive.factory[cia402::EmulatedDrive::key(kGearMotor)] = {kGear, 4};
      drive.factory[cia402::EmulatedDrive::key(kGearShaft)] = {1, 4};
      drive.measured_rpm = 0.0;
    }
  });
}

std::string EmulatedWheels::setting() const {
  return fmt::format("hal.{}.port=\"{}\"", config::Cia402Device::kName, emulator_.address());
}

bool EmulatedWheels::wait_for_host(std::chrono::nanoseconds timeout) {
  return emulator_.wait(timeout, [this](const cia402::EmulatedDrives& drives) {
    return std::ranges::all_of(host_.nodes, [&](std::uint8_t node) {
      return drives.drives().at(node - 1U).state() == cia402::DriveState::kEnabled;
    });
  });
}

/// Of the drive's velocity, for one rad/s of its wheel counter-clockwise.
double EmulatedWheels::units_per_radps(std::uint8_t node) const {
  const double sign = std::ranges::count(host_.reversed, node) > 0 ? -1.0 : 1.0;
  return sign * gear_ * 60.0 / (2.0 * std::numbers::pi) / host_.rpm_per_unit.value_or(1.0);
}

void EmulatedWheels::show(const std::array<double, 4>& wheel_radps) {
  emulator_.with_board([&](cia402::EmulatedDrives& drives) {
    for (std::size_t i = 0; i < std::min(host_.nodes.size(), wheel_radps.size()); ++i)
      drives.drive(host_.nodes[i]).measured_rpm = wheel_radps[i] * units_per_radps(host_.nodes[i]);
  });
}

kicking::Twist EmulatedWheels::set_point() {
  std::array<double, 4> wheel_radps{};
  emulator_.with_board([&](cia402::EmulatedDrives& drives) {
    for (std::size_t i = 0; i < std::min(host_.nodes.size(), wheel_radps.size()); ++i) {
      const cia402::EmulatedDrive& drive = drives.drive(host_.nodes[i]);
      if (drive.state() == cia402::DriveState::kEnabled)
        wheel_radps[i] = drive.target_rpm() / units_per_radps(host_.nodes[i]);
    }
  });
  return kinematics_.twist(wheel_radps);
}

std::unique_ptr<EmulatedWheels> emulated_wheels(const config::WheelsDevice& host, const kicking::WheelBase& base) {
  const auto* const drives = std::get_if<config::Cia402Device>(&host);
  return drives == nullptr ? nullptr : std::make_unique<EmulatedWheels>(*drives, base);
}

}  // namespace trivela::hal
