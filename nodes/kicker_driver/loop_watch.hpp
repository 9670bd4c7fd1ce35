#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

#include "bus/options.hpp"

namespace trivela::nodes {

/// Whether the decision loop has fallen silent. One that waits for its first world state has said nothing yet, and
/// lapses all the same: whoever never spoke cannot fall silent. A loop has spoken when it returns from a lapse, or when
/// it lives for longer than a writer lives by its birth alone. Any thread.
class LoopWatch {
 public:
  /// A change among the order topic's writers; true: a loop that spoke is silent now. Instants by the steady clock.
  bool fell_silent(const bus::Liveliness& writers, std::int64_t now_ns) {
    const std::lock_guard lock{mutex_};
    if (writers.lapsed < lapsed_ && writers.alive > 0) spoke_ = true;
    if (writers.alive > 0 && !alive_since_ns_) alive_since_ns_ = now_ns;
    lapsed_ = writers.lapsed;
    if (writers.alive > 0) return false;
    if (alive_since_ns_ && now_ns - *alive_since_ns_ > kByBirthAlone_ns) spoke_ = true;
    alive_since_ns_.reset();
    const bool silent = writers.lapsed > 0 && spoke_;
    if (writers.lapsed == 0) spoke_ = false;  // it left; the next one begins anew
    return silent;
  }

 private:
  static constexpr std::int64_t kByBirthAlone_ns = 300'000'000;  // three leases of the order topic

  std::mutex mutex_;
  std::uint32_t lapsed_ = 0;
  std::optional<std::int64_t> alive_since_ns_;
  bool spoke_ = false;
};

}  // namespace trivela::nodes
