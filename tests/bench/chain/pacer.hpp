#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "tests/bench/chain/track.hpp"

namespace trivela::bench {

/// The sensor at the start of a chain: samples at the rate that the parent ordered.
class Pacer {
 public:
  /// `rehearse`, where there is one, is called 0.5 ms before each sample; with `busy_wait` the thread does not sleep in
  /// the last millisecond.
  explicit Pacer(Track& track, std::function<void()> rehearse = {}, bool busy_wait = false)
      : track_(track), rehearse_(std::move(rehearse)), busy_wait_(busy_wait) {}

  struct Tick {
    std::int64_t seq;
    std::int64_t t_ns;  // the instant of the sample
  };

  /// The next sample, when its time has come; none if nothing was ordered within the timeout.
  std::optional<Tick> next(std::chrono::nanoseconds timeout);

 private:
  void wait_until(std::int64_t t_ns) const;

  Track& track_;
  std::function<void()> rehearse_;
  bool busy_wait_;
  Track::Batch batch_{};
  std::int64_t sent_ = 0;
  std::int64_t next_t_ns_ = 0;
};

}  // namespace trivela::bench
