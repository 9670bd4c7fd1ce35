#pragma once

#include <fmt/core.h>

#include <string>

namespace trivela::experiment {

/// What an experiment's 95 % intervals allow for. `evenings` of calibration; 0: robot files.
inline std::string interval_words(std::size_t evenings) {
  if (evenings == 0) return "95 % intervals by match, for these robot files alone (--calibrations)";
  return fmt::format("95 % intervals by match and by {} evenings of calibration", evenings);
}

}  // namespace trivela::experiment
