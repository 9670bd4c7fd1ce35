#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "config/devices.hpp"

namespace trivela::hal {

/// A pulse that a board has made of its host's order.
struct CoilPulse {
  std::int64_t t_ns = 0;  ///< of the steady clock: its order was read
  double length_us = 0.0;
  double power = 0.0;  ///< length_us / the host's pulse_us_per_power: the set-point, to the board's resolution
};

/// The board of a world's kicker at its end of a line: what the world says of the kicker is what the board answers, and
/// the board's pulses are what the world's coil does. For one thread beside those of the line.
class EmulatedKicker {
 public:
  virtual ~EmulatedKicker() = default;

  /// The setting by which a host finds it: `hal.ioboard.port="/tmp/..."`.
  virtual std::string setting() const = 0;

  /// Waits until a host has asked how it stands; false: not within `timeout`.
  [[nodiscard]] virtual bool wait_for_host(std::chrono::nanoseconds timeout) = 0;

  /// How the kicker stands: energy of the capacitor, 0 to 1, which a board that measures none does not tell, and the
  /// arm switch.
  virtual void show(double charge, bool armed) = 0;

  /// Kind of kick for which the lever was told to stand: of the host's heights. 0 for a board without a lever.
  virtual std::uint8_t lever_kind() = 0;

  /// The pulses since the last call, in their order.
  virtual std::vector<CoilPulse> take_pulses() = 0;
};

/// The board that a host of these settings speaks to; none: it speaks to no board. Throws std::runtime_error naming
/// what the system refuses.
std::unique_ptr<EmulatedKicker> emulated_kicker(const config::KickerDevice& host);

}  // namespace trivela::hal
