#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "emulators/line/emulated_socket.hpp"
#include "hal/line/descriptor.hpp"

namespace trivela::hal {

/// What an emulated device does with what it is told. now_ns is the steady clock's; one thread at a time.
class EmulatedDevice {
 public:
  static constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

  virtual ~EmulatedDevice() = default;

  std::size_t unread_B = 0;  ///< of what it said, by its line's count

  /// Takes what came and gives what it says, each to be sent by one write.
  virtual std::vector<std::string> take(std::string_view bytes, std::int64_t now_ns) = 0;

  /// When tick() is due.
  virtual std::int64_t next_ns() const { return kNever_ns; }
  /// What it says by itself.
  virtual std::vector<std::string> tick(std::int64_t /*now_ns*/) { return {}; }

  /// Its host is gone.
  virtual void hang_up() {}
};

/// A device that is not there, at its end of a line, with a thread of its own. One client at a time.
class EmulatedLine {
 public:
  /// Starts the thread; `device` outlives it.
  EmulatedLine(std::unique_ptr<EmulatedSocket> socket, EmulatedDevice& device);
  /// Hangs up and waits for the thread.
  ~EmulatedLine();
  EmulatedLine(const EmulatedLine&) = delete;
  EmulatedLine& operator=(const EmulatedLine&) = delete;

  /// It stays the same over pulled cables.
  const std::string& address() const { return socket_->address(); }

  /// The line is cut, and can be opened again. Each is done when it returns; plug() throws std::runtime_error.
  void pull();
  void plug();

  /// From now on what the host sends stays in the line, or it is taken again.
  void hold(bool held);

  /// Calls `look` while the thread does not touch the device.
  void with_device(const std::function<void()>& look);

  /// Waits until `done`, which is asked whenever the device took or said something. False: not within `timeout`.
  bool wait(std::chrono::nanoseconds timeout, const std::function<bool()>& done);

 private:
  void run();
  void change_cable();
  void receive();
  void say(std::vector<std::string> messages);
  void send();
  void forget_unread();
  void wait_for_events(std::unique_lock<std::mutex>& lock);
  void client_gone();
  void wake() const;

  const std::unique_ptr<EmulatedSocket> socket_;
  EmulatedDevice& device_;
  const Descriptor wake_;

  std::mutex mutex_;  // of all but the constants; the thread lets go of it while it waits
  std::condition_variable changed_;
  bool stopping_ = false;
  bool cable_wanted_ = true;
  bool cable_ = true;
  bool held_ = false;
  std::exception_ptr cable_error_;
  std::deque<std::string> out_;

  std::thread thread_;
};

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
