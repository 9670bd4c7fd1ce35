#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "emulators/line/emulated_line.hpp"

namespace trivela::hal {

/// A device that is not there, with its line. `Board` is an EmulatedDevice, and its open_line() makes our end of it.
template <class Board>
class Emulator {
 public:
  /// Throws std::runtime_error naming what the system refuses.
  template <class... Of>
  explicit Emulator(Of&&... of) : board_(std::forward<Of>(of)...), line_(board_.open_line(), board_) {}

  /// For the port in the settings.
  const std::string& address() const { return line_.address(); }
  EmulatedLine& line() { return line_; }

  /// Changes or reads the board while nobody else does.
  void with_board(const std::function<void(Board&)>& look) {
    line_.with_device([&] { look(board_); });
  }
  /// Waits until `done`; false: not within `timeout`.
  bool wait(std::chrono::nanoseconds timeout, const std::function<bool(const Board&)>& done) {
    return line_.wait(timeout, [&] { return done(board_); });
  }

 private:
  Board board_;
  EmulatedLine line_;
};

}  // namespace trivela::hal
