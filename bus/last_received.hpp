#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace trivela::bus {

/// When something came last, for any thread, without a lock.
class LastReceived {
 public:
  void now() noexcept {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    ns_.store(std::chrono::duration_cast<std::chrono::nanoseconds>(since).count(), std::memory_order_relaxed);
  }

  /// Nanoseconds of the steady clock; 0: never.
  std::int64_t ns() const noexcept { return ns_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::int64_t> ns_ = 0;
};

/// Something that a node takes or stores.
struct Input {
  std::string name;       ///< topic, or "device:NAME"
  double period_s = 0.0;  ///< longest time between two samples while all is well; 0: none is known

  /// When it came last, as LastReceived::ns() has it. Where that was before `before_ns`, looks for what has arrived
  /// since and was not taken yet.
  std::function<std::int64_t(std::int64_t before_ns)> received_ns;
};

}  // namespace trivela::bus
