#pragma once

#include <cmath>
#include <cstdint>

namespace trivela::kicking {

/// Seconds of a span or an instant in nanoseconds: 1e-9 time_ns.
[[nodiscard]] inline double seconds(std::int64_t time_ns) { return static_cast<double>(time_ns) * 1e-9; }

/// Seconds between two instants: 1e-9 (to_ns - from_ns).
[[nodiscard]] inline double seconds(std::int64_t from_ns, std::int64_t to_ns) { return seconds(to_ns - from_ns); }

/// The nearest whole number of nanoseconds; |time_s| < 9e9.
[[nodiscard]] inline std::int64_t nanoseconds(double time_s) { return std::llround(time_s * 1e9); }

}  // namespace trivela::kicking
