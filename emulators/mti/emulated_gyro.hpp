#pragma once

#include <memory>
#include <string>

#include "config/devices.hpp"
#include "emulators/mti/emulated_mti.hpp"

namespace trivela::hal {

/// The gyro of a world's robot at its end of its line: what the world says of the turn rate is what it says. It hears
/// nothing, so that nobody can wait for its host.
class EmulatedGyro {
 public:
  /// The gyro that a host of these settings listens to. Throws std::runtime_error naming what the system refuses.
  explicit EmulatedGyro(const config::MtiDevice& host) : sign_(host.upside_down ? -1.0 : 1.0) {}

  /// The setting by which a host finds it: `hal.mti.port="/tmp/..."`.
  std::string setting() const;

  /// The robot turns so [rad/s], counter-clockwise.
  void show(double gyro_radps);

 private:
  double sign_;
  mti::Emulator emulator_;
};

/// None: the host listens to no gyro of its own. Throws as EmulatedGyro.
std::unique_ptr<EmulatedGyro> emulated_gyro(const config::GyroDevice& host);

}  // namespace trivela::hal
