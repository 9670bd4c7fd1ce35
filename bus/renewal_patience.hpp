#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace trivela::bus {

/// Knows when a reader that hears nothing is to be made anew: after its first patience, then each time after twice as
/// long, up to ten seconds. Time in which nobody looked is nobody's silence: this process stood still, and what was
/// sent to it meanwhile is on its way.
class RenewalPatience {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// The first patience with a topic of this period: 25 periods, at least half a second.
  static std::chrono::nanoseconds of_period(std::chrono::nanoseconds period) {
    return std::max<std::chrono::nanoseconds>(std::chrono::milliseconds{500}, 25 * period);
  }

  RenewalPatience(std::chrono::nanoseconds first, Time now)
      : first_(first), patience_(first_), since_(now), heard_(now), looked_(now) {}

  void heard(Time now) {
    heard_ = since_ = now;
    patience_ = first_;
    attempts_ = 0;
  }

  /// True once it is time to make the reader anew; begins the next wait. To be asked several times a second.
  bool due(Time now) {
    since_ += std::max<std::chrono::nanoseconds>(now - looked_ - kLongestLook, std::chrono::nanoseconds::zero());
    looked_ = now;
    if (now - since_ < patience_) return false;
    since_ = now;
    patience_ = std::min<std::chrono::nanoseconds>(2 * patience_, kLongest);
    ++attempts_;
    return true;
  }

  /// How often it was made anew since something was heard.
  std::size_t attempts() const { return attempts_; }
  std::chrono::nanoseconds silent_for(Time now) const { return now - heard_; }

 private:
  static constexpr std::chrono::milliseconds kLongestLook{300};
  static constexpr std::chrono::seconds kLongest{10};
  std::chrono::nanoseconds first_;
  std::chrono::nanoseconds patience_;
  Time since_;
  Time heard_;
  Time looked_;
  std::size_t attempts_ = 0;
};

}  // namespace trivela::bus
