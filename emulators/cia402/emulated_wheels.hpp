#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <string>

#include "config/devices.hpp"
#include "emulators/cia402/emulated_drives.hpp"
#include "kicking/geometry/frames.hpp"
#include "kicking/model/omni_kinematics.hpp"

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
