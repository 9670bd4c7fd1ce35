#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <unordered_map>

namespace trivela::evaluator {

/// Play (or session), robot, half, number of the possession.
using PossessionKey = std::tuple<std::uint32_t, int, int, std::int64_t>;

struct PossessionHash {
  std::size_t operator()(const PossessionKey& key) const {
    const auto [play, robot, half, possession] = key;
    std::uint64_t h = (static_cast<std::uint64_t>(play) << 32) ^ static_cast<std::uint64_t>(possession);
    h ^= static_cast<std::uint64_t>(robot * 2 + half) << 56;
    h *= 0x9E3779B97F4A7C15ULL;
    return static_cast<std::size_t>(h ^ (h >> 29));
  }
};

/// Place of a possession in the rows: of all recordings of a play one.
using PossessionPlaces = std::unordered_map<PossessionKey, std::size_t, PossessionHash>;

}  // namespace trivela::evaluator
