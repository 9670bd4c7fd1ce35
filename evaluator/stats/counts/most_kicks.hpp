#pragma once

#include <cstdint>

namespace trivela::evaluator::stats {

/// Most kicks in a count; far beyond any season, and exact tests still end.
inline constexpr std::int64_t kMaxKicks = 1'000'000'000;

}  // namespace trivela::evaluator::stats
