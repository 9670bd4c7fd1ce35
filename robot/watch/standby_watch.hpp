#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

namespace trivela::robot {

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
