#pragma once

#include <cstdint>

#include "kicking/random/draws.hpp"

namespace trivela::experiment {

inline constexpr std::uint64_t kEveningSeeds = 1'000'001;  ///< 0 to 1e6, as `trivela calibrate run --seed` takes them

/// The seed of one robot's evening of calibration, a pure function of the experiment's seed.
inline std::uint64_t evening_seed(std::uint64_t seed, std::uint32_t evening, std::uint32_t robot_id) {
  const auto words = kicking::philox4x32({evening, robot_id, 0, 0x4556454e},
                                         {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
  return (std::uint64_t{words[0]} << 32 | words[1]) % kEveningSeeds;
}

}  // namespace trivela::experiment
