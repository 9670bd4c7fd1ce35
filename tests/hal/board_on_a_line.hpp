#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "emulators/ioboard/emulated_board.hpp"
#include "emulators/rekick/emulated_board.hpp"
#include "hal/board/board_kicker.hpp"
#include "hal/can/can_line.hpp"
#include "hal/ioboard/io_board.hpp"
#include "hal/rekick/rekick.hpp"

namespace trivela::tests {

/// For anything to happen at all.
inline constexpr std::chrono::seconds kTimeout{20};

inline std::int64_t steady_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// A kicker on a board's line.
inline std::unique_ptr<hal::Kicker> kicker_on(std::unique_ptr<hal::KickerBoard> board) {
  return std::make_unique<hal::BoardKicker>(std::move(board));
}

/// Reads until `done` of a sample; false: it did not come.
inline bool read_until(hal::Kicker& kicker, const std::function<bool(const hal::KickerSample&)>& done) {
  const auto end = std::chrono::steady_clock::now() + kTimeout;
  while (std::chrono::steady_clock::now() < end) {
    if (const auto sample = kicker.read(std::chrono::milliseconds(100)); sample && done(*sample)) return true;
  }
  return false;
}
inline bool until_armed(hal::Kicker& kicker) {
  return read_until(kicker, [](const hal::KickerSample& sample) { return sample.armed; });
}
inline bool until_link_fault(hal::Kicker& kicker) {
  return read_until(kicker, [](const auto& sample) { return sample.fault == hal::KickerFault::kLink; });
}
inline bool until_status_says(hal::Kicker& kicker, const std::string& text) {
  return read_until(kicker, [&](const auto&) { return kicker.status().find(text) != std::string::npos; });
}

/// Waits until the board was asked `n` more times after `t_ns`: what was to be sent by then was sent before that.
template <class Emulator>
void wait_for_looks(Emulator& emulator, std::uint64_t n, std::int64_t t_ns = 0) {
  EXPECT_TRUE(emulator.wait(kTimeout, [=](const auto& board) { return board.last_look_ns() > t_ns; }));
  std::uint64_t before = 0;
  emulator.with_board([&](const auto& board) { before = board.looks(); });
  EXPECT_TRUE(emulator.wait(kTimeout, [=](const auto& board) { return board.looks() >= before + n; }));
}

/// An emulated ioBoard and what a contract asks of it. Two of the pulse's units for a set-point of 1, so that 22.5 is
/// one.
class IoBoardOnALine {
 public:
  std::unique_ptr<hal::Kicker> open() {
    const config::IoBoardDevice settings{.port = emulator.address(), .pulse_us_per_power = kScale_us};
    return kicker_on(std::make_unique<hal::ioboard::IoBoard>(hal::serial_line(settings.port), settings));
  }
  void be_well(bool well) {
    emulator.with_board([=](auto& board) { board.in_play = well; });
  }
  static double power_of(const hal::ioboard::EmulatedBoard::Pulse& pulse) {
    return pulse.units * hal::ioboard::kPulseUnit_us / kScale_us;
  }

  hal::ioboard::Emulator emulator;

 private:
  static constexpr double kScale_us = 2 * hal::ioboard::kPulseUnit_us;
};

/// The same of a ReKick board.
class ReKickOnALine {
 public:
  std::unique_ptr<hal::Kicker> open() {
    const config::ReKickDevice settings{.port = emulator.address(), .pulse_us_per_power = kScale_us};
    return kicker_on(std::make_unique<hal::rekick::ReKick>(hal::can::can_line(settings.port, "kicker"), settings));
  }
  void be_well(bool well) {
    emulator.with_board([=](auto& board) { board.supply_on = well; });
  }
  static double power_of(const hal::rekick::EmulatedBoard::Pulse& pulse) { return pulse.pulse_us / kScale_us; }

  hal::rekick::Emulator emulator;

 private:
  static constexpr double kScale_us = 10.0;
};

}  // namespace trivela::tests
