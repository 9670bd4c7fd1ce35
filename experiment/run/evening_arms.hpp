#pragma once

#include <cstdint>
#include <vector>

#include "experiment/play/arm.hpp"

namespace trivela::experiment {

/// The robots of one team as an evening of calibration left them, robot n's at n - 1.
using Team = std::vector<config::Robot>;

/// The arms of an experiment in each evening of calibration. Match m is played with evening m mod K: every evening has
/// the same number of matches, give or take one, and all arms of a match have the same.
class EveningArms {
 public:
  /// `evenings` empty: the arms as they are, in every match. An arm with own_robots keeps them.
  EveningArms(const std::vector<Arm>& arms, const std::vector<Team>& evenings) {
    arms_.assign(evenings.empty() ? 1 : evenings.size(), arms);
    for (std::size_t k = 0; k < evenings.size(); ++k) {
      for (Arm& arm : arms_[k]) {
        if (!arm.own_robots) arm.robots = evenings[k];
      }
    }
  }

  std::uint32_t evenings() const { return static_cast<std::uint32_t>(arms_.size()); }
  std::uint32_t evening_of(std::uint32_t match) const { return match % evenings(); }
  const std::vector<Arm>& of(std::uint32_t match) const { return arms_[evening_of(match)]; }

 private:
  std::vector<std::vector<Arm>> arms_;  // by evening
};

}  // namespace trivela::experiment
