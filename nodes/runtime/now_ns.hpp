#pragma once

#include <chrono>
#include <cstdint>

namespace trivela::nodes {

/// A reading of a std::chrono clock in nanoseconds since that clock's epoch.
std::int64_t now_ns(auto clock_now) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(clock_now.time_since_epoch()).count();
}

}  // namespace trivela::nodes
