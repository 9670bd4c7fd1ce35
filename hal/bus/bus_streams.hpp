#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

#include "bus/reader.hpp"
#include "bus/renewal.hpp"
#include "bus/writer.hpp"

namespace trivela::hal {

/// Somebody writes what `reader` reads and somebody reads what `writer` writes; waits up to the timeout for that.
inline bool both_ways(bus::AnyReader& reader, const bus::AnyWriter& writer, std::chrono::nanoseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  if (!reader.wait_for_writers(1, timeout)) return false;
  const auto left = deadline - std::chrono::steady_clock::now();
  return writer.wait_for_readers(1, std::max<std::chrono::nanoseconds>(left, std::chrono::nanoseconds::zero()));
}

/// The robot's latest sample that is newer than `after_t_ns`, waiting up to the timeout for it. Samples of other robots
/// and older ones are passed over, as is one of an instant that cannot be true. `after_t_ns` then is the sample's
/// instant. `see` is given each sample of the robot, also those that are passed over.
template <class T>
std::optional<T> read_newer(bus::Reader<T>& reader, std::uint8_t robot_id, std::optional<std::int64_t>& after_t_ns,
                            std::chrono::nanoseconds timeout,
                            const std::function<void(const bus::SampleInfo&)>& see = {}) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  for (;;) {
    bus::renew_if_silent(reader);
    std::optional<T> newest;
    reader.take([&](const T& sample, const bus::SampleInfo& info) {
      if (sample.robot_id == robot_id && see) see(info);
      if (sample.robot_id != robot_id || (after_t_ns && sample.t_ns <= *after_t_ns)) return;
      if (!reader.participant().believes(sample.t_ns)) return;  // or all that follow would be older
      newest = sample;
      after_t_ns = sample.t_ns;
    });
    if (newest) return newest;
    const auto left = deadline - std::chrono::steady_clock::now();
    if (left <= left.zero() || !reader.wait(left)) return std::nullopt;
  }
}

}  // namespace trivela::hal
