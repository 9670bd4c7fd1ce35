#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

namespace trivela::robot {

/// Whether the decision loop has fallen silent. One that waits for its first world state has said nothing yet, and
/// lapses all the same: whoever never spoke cannot fall silent. A loop has spoken when it returns from a lapse, or when
/// it lives for longer than a writer lives by its birth alone. Any thread.
class LoopWatch {
 public:
  /// The loop has left, or has been silent, for kGrace_ns.
  bool lost(std::int64_t now_ns) {
    const std::lock_guard lock{mutex_};
    return gone_since_ns_ && now_ns - *gone_since_ns_ >= kGrace_ns;
  }

  /// A change among the order topic's writers; true: a loop that spoke is silent now. Instants by the steady clock.
  bool fell_silent(std::uint32_t alive, std::uint32_t lapsed, std::int64_t now_ns) {
    const std::lock_guard lock{mutex_};
    if (lapsed < lapsed_ && alive > 0) spoke_ = true;
    if (alive > 0 && !alive_since_ns_) alive_since_ns_ = now_ns;
    lapsed_ = lapsed;
    if (alive > 0) gone_since_ns_.reset();
    if (alive > 0) return false;
    const bool was_there = alive_since_ns_.has_value();
    if (alive_since_ns_ && now_ns - *alive_since_ns_ > kByBirthAlone_ns) spoke_ = true;
    alive_since_ns_.reset();
    const bool silent = lapsed > 0 && spoke_;
    if (was_there && (silent || lapsed == 0)) gone_since_ns_ = now_ns;
    if (lapsed == 0) spoke_ = false;  // it left; the next one begins anew
    return silent;
  }

 private:
  // A writer lapses 0.1 s after its last sign of life.
  static constexpr std::int64_t kGrace_ns = 100'000'000;
  static constexpr std::int64_t kByBirthAlone_ns = 300'000'000;  // three leases of the order topic

  std::mutex mutex_;
  std::uint32_t lapsed_ = 0;
  std::optional<std::int64_t> alive_since_ns_;
  std::optional<std::int64_t> gone_since_ns_;
  bool spoke_ = false;
};

}  // namespace trivela::robot
