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
  void sent(std::size_t bytes, Instant at) {
    sent_bytes_ += bytes;
    writes_.push_back({sent_bytes_, at});
  }

  /// The age of the oldest of them at `now`, when `waiting_bytes` are not acknowledged; 0: all are.
  std::chrono::nanoseconds age(std::size_t waiting_bytes, Instant now) {
    const std::uint64_t acknowledged_bytes = sent_bytes_ - std::min<std::uint64_t>(waiting_bytes, sent_bytes_);
    while (!writes_.empty() && writes_.front().end_bytes <= acknowledged_bytes) writes_.pop_front();
    return writes_.empty() ? std::chrono::nanoseconds{0} : now - writes_.front().at;
  }

 private:
  struct Written {
    std::uint64_t end_bytes;
    Instant at;
  };
  std::uint64_t sent_bytes_ = 0;
  std::deque<Written> writes_;
};

}  // namespace trivela::hal::refbox
