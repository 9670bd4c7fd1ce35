#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "hal/can/can_line.hpp"
#include "hal/line/emulated_line.hpp"
#include "hal/rekick/emulated_board.hpp"

namespace trivela::hal::rekick {

/// A ReKick board that is not there, behind a SOCK_SEQPACKET socket in place of a CAN bus.
class Emulator {
 public:
  /// Throws std::runtime_error naming what the system refuses.
  Emulator() : line_(can::emulated_bus("rekick", "can"), board_) {}

  /// For ReKickDevice::port.
  const std::string& address() const { return line_.address(); }
  EmulatedLine& line() { return line_; }

  /// Changes or reads the board while nobody else does.
  void with_board(const std::function<void(EmulatedBoard&)>& look) {
    line_.with_device([&] { look(board_); });
  }
  /// Waits until `done`; false: not within `timeout`.
  bool wait(std::chrono::nanoseconds timeout, const std::function<bool(const EmulatedBoard&)>& done) {
    return line_.wait(timeout, [&] { return done(board_); });
  }

 private:
  EmulatedBoard board_;
  EmulatedLine line_;
};

}  // namespace trivela::hal::rekick
