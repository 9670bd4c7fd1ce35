#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace trivela::nodes {

/// Who started this process and waits for word of it: systemd, or whoever else speaks its notification protocol
/// (sd_notify(3)): a line in a datagram to the Unix socket that the environment names. For one thread.
class Supervisor {
 public:
  using Clock = std::chrono::steady_clock;

  /// `socket`: a path, or "@" and an abstract name. `watchdog`: the manager ends a process that has said nothing for as
  /// long; none: it does not watch. Throws std::runtime_error naming what cannot be such a socket.
  Supervisor(const std::string& socket, std::optional<std::chrono::microseconds> watchdog);
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;
  ~Supervisor();

  /// That of NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID; null where there is none.
  static std::shared_ptr<Supervisor> of_environment();

  /// To be called as often as the process turns: "READY=1" the first time, then "WATCHDOG=1" four times in the
  /// watchdog's time and no more. Never waits: what nobody takes now is said again at the next call.
  void alive(Clock::time_point now = Clock::now());

  /// "STOPPING=1": this process ends of its own accord, in the time that it has after a SIGTERM.
  void stopping() const { say("STOPPING=1"); }

 private:
  bool say(const char* line) const;

  std::string socket_;
  std::optional<std::chrono::microseconds> watchdog_;
  int descriptor_;
  bool ready_ = false;
  Clock::time_point said_{};
};

}  // namespace trivela::nodes
