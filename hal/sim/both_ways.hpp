#pragma once

#include <algorithm>
#include <chrono>

#include "bus/reader.hpp"
#include "bus/writer.hpp"

namespace trivela::hal {

/// Somebody writes what `reader` reads and somebody reads what `writer` writes; waits up to the timeout for that.
inline bool both_ways(bus::AnyReader& reader, const bus::AnyWriter& writer, std::chrono::nanoseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  if (!reader.wait_for_writers(1, timeout)) return false;
  const auto left = deadline - std::chrono::steady_clock::now();
  return writer.wait_for_readers(1, std::max<std::chrono::nanoseconds>(left, std::chrono::nanoseconds::zero()));
}

}  // namespace trivela::hal
