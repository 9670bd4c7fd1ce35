#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "config/devices.hpp"
#include "emulators/line/emulator.hpp"

namespace trivela::hal::mti {

/// What an emulated gyro is told to do wrong. `every` n: each n-th message.
struct EmulatedFaults {
  bool silent = false;
  bool no_rate = false;  ///< it was set up without the rate of turn
  int garbled_every = 0;
  int wrong_sums_every = 0;
};

/// An MTi that says its packet's number, its sample time and its rate of turn every kPeriod_ns, and hears nothing.
class EmulatedMti final : public EmulatedDevice {
 public:
  static constexpr std::int64_t kPeriod_ns = 10'000'000;

  /// Its end of a line. Throws std::runtime_error naming what the system refuses.
  static std::unique_ptr<EmulatedSocket> open_line() { return emulated_terminal("mti", "gyro"); }

  std::vector<std::string> take(std::string_view, std::int64_t) override { return {}; }
  std::vector<std::string> tick(std::int64_t now_ns) override;
  std::int64_t next_ns() const override { return next_ns_; }

  double rate_radps = 0.0;  ///< about its z axis
  EmulatedFaults faults;

  std::uint64_t said() const { return said_; }

 private:
  bool hits(int every) const { return every > 0 && said_ % static_cast<std::uint64_t>(every) == 0; }

  std::int64_t next_ns_ = 0;
  std::uint64_t said_ = 0;
};

/// An MTi that is not there, on a pseudo-terminal.
using Emulator = hal::Emulator<EmulatedMti>;

}  // namespace trivela::hal::mti

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
