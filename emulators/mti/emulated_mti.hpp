#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

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
