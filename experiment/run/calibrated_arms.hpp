#pragma once

#include <cstdint>
#include <vector>

#include "experiment/play/arm.hpp"

namespace trivela::experiment {

/// The robots of one team as a calibration left them, robot n's at n - 1.
using Team = std::vector<config::Robot>;

/// The arms of an experiment in each calibration. Match m is played with calibration m mod K: every calibration has
/// the same number of matches, give or take one, and all arms of a match have the same.
class CalibratedArms {
 public:
  /// `calibrations` empty: the arms as they are, in every match. An arm with own_robots keeps them.
  CalibratedArms(const std::vector<Arm>& arms, const std::vector<Team>& calibrations) {
    arms_.assign(calibrations.empty() ? 1 : calibrations.size(), arms);
    for (std::size_t k = 0; k < calibrations.size(); ++k) {
      for (Arm& arm : arms_[k]) {
        if (!arm.own_robots) arm.robots = calibrations[k];
      }
    }
  }

  std::uint32_t calibrations() const { return static_cast<std::uint32_t>(arms_.size()); }
  std::uint32_t calibration_of(std::uint32_t match) const { return match % calibrations(); }
  const std::vector<Arm>& of(std::uint32_t match) const { return arms_[calibration_of(match)]; }

 private:
  std::vector<std::vector<Arm>> arms_;  // by calibration
};

}  // namespace trivela::experiment
