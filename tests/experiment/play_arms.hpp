// What a study plays of some arms, without a file.
#pragma once

#include "experiment/study/play.hpp"

namespace trivela::experiment {

inline std::vector<ArmTally> play_arms(
    const sim::Scenario& scenario, const std::vector<Arm>& arms, const PlayPlan& plan,
    const std::function<void(std::size_t, std::size_t)>& progress = [](std::size_t, std::size_t) {}) {
  log::StudyResults results{"", "a test", plan.matches};
  return play_missing(scenario, arms, plan, "test", {0, plan.matches}, results, progress).arms;
}

}  // namespace trivela::experiment
