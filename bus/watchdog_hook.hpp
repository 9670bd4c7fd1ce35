#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>

namespace trivela::bus {

/// By when a loop comes round or a reaction ends; for any thread, without a lock.
class Deadline {
 public:
  using Time = std::chrono::steady_clock::time_point;

  void due(Time at) noexcept { due_ns_.store(ns(at), std::memory_order_relaxed); }
  void idle() noexcept { due_ns_.store(kIdle, std::memory_order_relaxed); }

  /// Whether it should have been over longer than `timeout` before `now`.
  bool late(Time now, std::chrono::nanoseconds timeout) const noexcept {
    const std::int64_t due_ns = due_ns_.load(std::memory_order_relaxed);
    return due_ns != kIdle && ns(now) - due_ns > timeout.count();
  }

 private:
  static constexpr std::int64_t kIdle = std::numeric_limits<std::int64_t>::max();
  static std::int64_t ns(Time at) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(at.time_since_epoch()).count();
  }
  std::atomic<std::int64_t> due_ns_ = kIdle;
};

/// Who wants to know that an executor turns, e.g. for a watchdog.
struct WatchdogHook {
  /// Told by run()'s thread once all readers and threads are there and then about each 100 ms: an empty name, or that
  /// of a device, timer or reaction which is late. Where that thread itself hangs it is told nothing. None: nobody
  /// asks.
  std::function<void(const std::string& late)> notify;
  /// How long a reaction may take, and a device or timer may come too late.
  std::chrono::nanoseconds timeout = std::chrono::seconds{1};
};

}  // namespace trivela::bus
