#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>

namespace trivela::hal::refbox {

/// How long the oldest bytes that were given to a connection have waited for the other side's acknowledgement. A peer
/// that acknowledges a little is as good as its slowest byte.
class Unacknowledged {
 public:
  using Instant = std::chrono::steady_clock::time_point;

  /// So many bytes more were given to the connection.
  void sent(std::size_t bytes_B, Instant at) {
    sent_B_ += bytes_B;
    writes_.push_back({sent_B_, at});
  }

  /// The age of the oldest of them at `now`, when `waiting_B` are not acknowledged; 0: all are.
  std::chrono::nanoseconds age(std::size_t waiting_B, Instant now) {
    const std::uint64_t acknowledged_B = sent_B_ - std::min<std::uint64_t>(waiting_B, sent_B_);
    while (!writes_.empty() && writes_.front().end_B <= acknowledged_B) writes_.pop_front();
    return writes_.empty() ? std::chrono::nanoseconds{0} : now - writes_.front().at;
  }

 private:
  struct Written {
    std::uint64_t end_B;
    Instant at;
  };
  std::uint64_t sent_B_ = 0;
  std::deque<Written> writes_;
};

}  // namespace trivela::hal::refbox
