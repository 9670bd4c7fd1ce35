#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "hal/ioboard/emulated_board.hpp"
#include "hal/line/emulated_line.hpp"

namespace trivela::hal::ioboard {

/// An ioBoard that is not there, on a pseudo-terminal.
class Emulator {
 public:
  /// Throws std::runtime_error naming what the system refuses.
  Emulator() : line_(emulated_terminal("ioboard", "kicker"), board_) {}

  /// For IoBoardDevice::port.
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

}  // namespace trivela::hal::ioboard
