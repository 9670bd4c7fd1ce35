#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>

namespace trivela::bus {

/// Knows when a reader that hears nothing is to be made again: after its first timeout, then each time after twice as
/// long, up to ten seconds. Time in which nobody looked is nobody's silence: this process stood still or has not begun,
/// and what was sent to it meanwhile is on its way.
class ReconnectBackoff {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// The first timeout with a topic of this period: 25 periods, at least half a second.
  static std::chrono::nanoseconds of_period(std::chrono::nanoseconds period) {
    return std::max<std::chrono::nanoseconds>(std::chrono::milliseconds{500}, 25 * period);
  }

  explicit ReconnectBackoff(std::chrono::nanoseconds first) : first_(first), timeout_(first) {}

  void received(Time now) {
    received_ = since_ = now;
    timeout_ = first_;
    attempts_ = 0;
  }

  /// True once it is time to make the reader again; begins the next wait. To be asked several times a second.
  bool due(Time now) {
    if (!looked_) received(now);
    since_ += std::max<std::chrono::nanoseconds>(now - looked_.value_or(now) - kLongestLook,
                                                 std::chrono::nanoseconds::zero());
    looked_ = now;
    if (now - since_ < timeout_) return false;
    since_ = now;
    timeout_ = std::min<std::chrono::nanoseconds>(2 * timeout_, kLongest);
    ++attempts_;
    return true;
  }

  /// How often it was made again since something was heard.
  std::size_t attempts() const { return attempts_; }
  std::chrono::nanoseconds silent_for(Time now) const { return now - received_; }

 private:
  static constexpr std::chrono::milliseconds kLongestLook{300};
  static constexpr std::chrono::seconds kLongest{10};
  std::chrono::nanoseconds first_;
  std::chrono::nanoseconds timeout_;
  Time since_;
  Time received_;  // or the first look
  std::optional<Time> looked_;
  std::size_t attempts_ = 0;
};

}  // namespace trivela::bus
