#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "tests/bench/chain/track.hpp"

namespace trivela::bench {

/// The sensor at the start of a chain: samples at the rate that the parent ordered.
class Pacer {
 public:
  explicit Pacer(Track& track) : track_(track) {}

  struct Tick {
    std::int64_t seq;
    std::int64_t t_ns;  // the instant of the sample
  };

  /// The next sample, when its time has come; none if nothing was ordered within the timeout.
  std::optional<Tick> next(std::chrono::nanoseconds timeout);

 private:
  Track& track_;
  Track::Batch batch_{};
  std::int64_t sent_ = 0;
  std::int64_t next_t_ns_ = 0;
};

}  // namespace trivela::bench
