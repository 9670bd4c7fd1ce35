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

/// Whether the second of a robot's two decision nodes is in charge. The first one is heard by its drive command, which
/// it writes every cycle while it lives. The second takes over when nothing was heard for kSilence_ns, from its start
/// on for kStart_ns, and gives back after it has heard the first for kOverlap_ns without such a silence: everybody
/// finds a node that returns by itself, and until all have, both speak. Instants by the steady clock. Any thread.
class StandbyWatch {
 public:
  static constexpr std::int64_t kSilence_ns = 100'000'000;    // five cycles; with the next one, 0.12 s
  static constexpr std::int64_t kStart_ns = 1'000'000'000;    // for nodes that are started together
  static constexpr std::int64_t kOverlap_ns = 2'000'000'000;  // discovery takes up to a second or so

  /// The first one has spoken.
  void received(std::int64_t now_ns) {
    const std::lock_guard lock{mutex_};
    if (!received_ns_ || now_ns - *received_ns_ > kSilence_ns) since_ns_ = now_ns;
    received_ns_ = now_ns;
  }

  /// To be asked each cycle.
  bool in_charge(std::int64_t now_ns) {
    const std::lock_guard lock{mutex_};
    if (!started_ns_) started_ns_ = now_ns;
    const bool silent = received_ns_ ? now_ns - *received_ns_ > kSilence_ns : now_ns - *started_ns_ > kStart_ns;
    if (silent) {
      in_charge_ = true;
    } else if (received_ns_ && *received_ns_ - since_ns_ >= kOverlap_ns) {
      in_charge_ = false;
    }
    return in_charge_;
  }

 private:
  std::mutex mutex_;
  std::optional<std::int64_t> started_ns_, received_ns_;
  std::int64_t since_ns_ = 0;  // heard without a silence since then
  bool in_charge_ = false;
};

}  // namespace trivela::robot
