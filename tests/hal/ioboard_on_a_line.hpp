#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "hal/board/board_kicker.hpp"
#include "hal/ioboard/emulator.hpp"
#include "hal/ioboard/io_board.hpp"

namespace trivela::tests {

inline std::int64_t steady_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// A busy machine wakes a thread late: here no shot is dropped for that.
inline constexpr std::chrono::seconds kAnyLateness{20};

/// An emulated ioBoard and what a contract asks of it. Two of the pulse's units for a set-point of 1, so that 22.5 is
/// one.
class IoBoardOnALine {
 public:
  std::unique_ptr<hal::Kicker> open() {
    const config::IoBoardDevice settings{.port = emulator_.address(), .pulse_us_per_power = kScale_us};
    return std::make_unique<hal::BoardKicker>(
        std::make_unique<hal::ioboard::IoBoard>(hal::serial_line(settings.port), settings), kAnyLateness);
  }
  void be_well(bool well) {
    emulator_.with_board([=](hal::ioboard::EmulatedBoard& board) { board.in_play = well; });
  }
  static bool well(const hal::KickerSample& sample) { return sample.armed; }
  std::int64_t last_look_ns() {
    std::int64_t last_ns = 0;
    emulator_.with_board([&](const hal::ioboard::EmulatedBoard& board) { last_ns = board.last_look_ns(); });
    return last_ns;
  }
  /// Set-points and instants of the pulses so far, once one of no length has come, or the board was looked at so often.
  std::vector<std::pair<double, std::int64_t>> energised(std::uint64_t looks) {
    using hal::ioboard::EmulatedBoard;
    std::uint64_t before = 0;
    std::size_t known = 0;
    emulator_.with_board([&](const EmulatedBoard& board) {
      before = board.looks();
      known = marks(board);
    });
    const auto over = [=](const EmulatedBoard& board) {
      return marks(board) > known || board.looks() >= before + looks;
    };
    EXPECT_TRUE(emulator_.wait(std::chrono::seconds(20), over));
    std::vector<std::pair<double, std::int64_t>> pulses;
    emulator_.with_board([&](const EmulatedBoard& board) {
      for (const auto& pulse : board.pulses()) {
        if (pulse.units > 0) pulses.emplace_back(pulse.units * hal::ioboard::kPulseUnit_us / kScale_us, pulse.t_ns);
      }
    });
    return pulses;
  }

 private:
  static std::size_t marks(const hal::ioboard::EmulatedBoard& board) {
    return static_cast<std::size_t>(std::ranges::count(board.pulses(), 0, &hal::ioboard::EmulatedBoard::Pulse::units));
  }

  static constexpr double kScale_us = 2 * hal::ioboard::kPulseUnit_us;
  hal::ioboard::Emulator emulator_;
};

}  // namespace trivela::tests
