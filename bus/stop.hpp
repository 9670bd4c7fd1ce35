#pragma once

#include <atomic>
#include <chrono>

namespace trivela::bus {

/// A request to stop, made once, from any thread or from a signal handler.
class Stop {
 public:
  Stop();
  Stop(const Stop&) = delete;
  Stop& operator=(const Stop&) = delete;
  ~Stop();

  /// Async-signal-safe.
  void request() noexcept;
  bool requested() const noexcept { return requested_.load(std::memory_order_acquire); }

  /// Blocks until it is requested.
  void wait() const;

  /// Blocks until it is requested, no longer than until `end`. True: it is requested.
  bool wait_until(std::chrono::steady_clock::time_point end) const;

  /// Readable once it is requested, for poll().
  int file_descriptor() const noexcept { return event_; }

 private:
  int event_;
  std::atomic<bool> requested_ = false;
};

/// While it lives, SIGTERM, SIGINT and SIGHUP (the terminal is gone; not under nohup) request the stop. A process that
/// still runs `limit` after that hangs, e.g. in a policy of a team's own: SIGALRM ends it. One at a time in a process;
/// restores what was there before.
class StopOnSignals {
 public:
  explicit StopOnSignals(Stop& stop, std::chrono::seconds limit = std::chrono::seconds{60});
  StopOnSignals(const StopOnSignals&) = delete;
  StopOnSignals& operator=(const StopOnSignals&) = delete;
  ~StopOnSignals();

  /// All reactions have returned: nothing hangs. What follows, such as closing a long log, has no limit.
  static void lift_limit() noexcept;
};

}  // namespace trivela::bus
