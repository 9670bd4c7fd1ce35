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
  /// A change among the order topic's writers; true: a loop that spoke is silent now. Instants by the steady clock.
  bool fell_silent(std::uint32_t alive, std::uint32_t lapsed, std::int64_t now_ns) {
    const std::lock_guard lock{mutex_};
    if (lapsed < lapsed_ && alive > 0) spoke_ = true;
    if (alive > 0 && !alive_since_ns_) alive_since_ns_ = now_ns;
    lapsed_ = lapsed;
    if (alive > 0) return false;
    if (alive_since_ns_ && now_ns - *alive_since_ns_ > kByBirthAlone_ns) spoke_ = true;
    alive_since_ns_.reset();
    const bool silent = lapsed > 0 && spoke_;
    if (lapsed == 0) spoke_ = false;  // it left; the next one begins again
    return silent;
  }

 private:
  static constexpr std::int64_t kByBirthAlone_ns = 300'000'000;  // three leases of the order topic

  std::mutex mutex_;
  std::uint32_t lapsed_ = 0;
  std::optional<std::int64_t> alive_since_ns_;
  bool spoke_ = false;
};

}  // namespace trivela::robot
