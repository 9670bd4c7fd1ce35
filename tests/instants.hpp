#pragma once

#include <cstdint>

namespace trivela {

/// In nanoseconds; the cycle is the default one.
inline constexpr std::int64_t kMs = 1'000'000, kCycle_ns = 20 * kMs, kSecond_ns = 1'000 * kMs;

}  // namespace trivela
