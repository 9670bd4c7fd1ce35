#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "config/devices.hpp"
#include "emulators/cia402/emulated_drive.hpp"
#include "emulators/line/emulator.hpp"
#include "kicking/geometry/frames.hpp"
#include "kicking/model/omni_kinematics.hpp"

namespace trivela::hal::cia402 {

/// Drives with the nodes 1, 2, 3 and so on that share a bus.
class EmulatedDrives final : public EmulatedDevice {
 public:
  explicit EmulatedDrives(std::uint8_t count);

  /// Its end of a line. Throws std::runtime_error naming what the system refuses.
  static std::unique_ptr<EmulatedSocket> open_line() { return emulated_bus("cia402", "can"); }

  std::vector<std::string> take(std::string_view bytes, std::int64_t now_ns) override;
  std::vector<std::string> tick(std::int64_t now_ns) override;
  std::int64_t next_ns() const override;

  /// The drive with this node.
  EmulatedDrive& drive(std::uint8_t node) { return drives_.at(node - 1U); }
  const std::vector<EmulatedDrive>& drives() const { return drives_; }

  /// What the bus says by itself: error frames of the interface, other devices.
  void say(const can::Frame& frame) { to_say_.push_back(frame); }
  /// A drive has a fault.
  void fail(std::uint8_t node, std::uint16_t code, std::int64_t now_ns) { drive(node).fail(code, now_ns, to_say_); }

  /// All that was taken, frame by frame, while `recording`.
  bool recording = false;
  const std::vector<can::Frame>& taken() const { return taken_; }

 private:
  std::vector<EmulatedDrive> drives_;
  EmulatedDrive::Frames to_say_;
  std::vector<can::Frame> taken_;
};

/// Drives that are not there, behind a SOCK_SEQPACKET socket in place of a CAN bus. Emulator{4}: four of them.
using Emulator = hal::Emulator<EmulatedDrives>;

}  // namespace trivela::hal::cia402

namespace trivela::hal {

/// The drives of a world's base on their bus: what the world says of the wheels is what the drives measure, and the
/// velocities that the drives are told are where the world's base goes.
class EmulatedWheels {
 public:
  /// Turns of the motor for one of the wheel, where the host's settings leave it to the drives (Hibikino-Musashi,
  /// musashi_movebase_config.yaml).
  static constexpr std::uint32_t kGear = 12;

  /// The drives that a host of these settings speaks to, on a robot with that base. Throws std::runtime_error naming
  /// what the system refuses.
  EmulatedWheels(const config::Cia402Device& host, const kicking::WheelBase& base);

  /// The setting by which a host finds them: `hal.cia402.port="/tmp/..."`.
  std::string setting() const;

  /// Waits until a host has every drive in operation; false: not within `timeout`.
  [[nodiscard]] bool wait_for_host(std::chrono::nanoseconds timeout);

  /// The wheels turn so, in the order of the host's nodes.
  void show(const std::array<double, 4>& wheel_radps);

  /// What the drives are told to do, as a motion in R; a drive that is not in operation, or has lost its host, stands.
  kicking::Twist set_point();

 private:
  double units_per_radps(std::uint8_t node) const;

  config::Cia402Device host_;
  kicking::OmniKinematics kinematics_;
  double gear_;
  cia402::Emulator emulator_;
};

/// None: the host speaks to no drives. Throws as EmulatedWheels.
std::unique_ptr<EmulatedWheels> emulated_wheels(const config::WheelsDevice& host, const kicking::WheelBase& base);

}  // namespace trivela::hal
