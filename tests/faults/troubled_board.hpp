#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "config/devices.hpp"

namespace trivela::faults {

/// What befalls a kicker: its line, its board, or its driver's process.
enum class Trouble { kUnplug, kHold, kSilent, kLost, kGarbled, kWrongSums, kErrorFlag, kFlood, kKill, kStop, kRestart };
std::string_view name(Trouble what);

/// A pulse of the coil, as the board itself recorded it.
struct BoardPulse {
  std::int64_t t_ns = 0;  ///< CLOCK_MONOTONIC: its order was read
  int units = 0;          ///< of power
};

/// An emulated board that is made trouble for, and its record of its pulses.
class TroubledBoard {
 public:
  virtual ~TroubledBoard() = default;

  /// The settings of who speaks to it.
  virtual config::KickerDevice host() const = 0;

  /// What can befall it.
  virtual std::vector<Trouble> troubles() const = 0;

  /// Those of line and board; of a process they are nothing.
  virtual void begin(Trouble what) = 0;
  virtual void end() = 0;
  /// To be called again and again while one lasts.
  virtual void stir() = 0;

  virtual std::vector<BoardPulse> pulses() = 0;

  /// Waits until there are more than `before`; false: not within `timeout`.
  virtual bool wait_for_pulse(std::size_t before, std::chrono::nanoseconds timeout) = 0;
};

/// Over a pseudo-terminal, and over a SOCK_SEQPACKET socket in place of a CAN bus. Both throw std::runtime_error naming
/// what the system refuses.
std::unique_ptr<TroubledBoard> troubled_ioboard();
std::unique_ptr<TroubledBoard> troubled_rekick();

}  // namespace trivela::faults
