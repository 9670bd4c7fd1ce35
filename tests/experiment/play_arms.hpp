// What a study plays of some arms, without a file.
#pragma once

#include "experiment/study/study.hpp"

namespace trivela::experiment {

inline std::vector<ArmTally> tallies_of(const std::vector<StudyRow>& rows) {
  std::vector<ArmTally> arms;
  for (const StudyRow& row : rows) arms.push_back(row.matches);
  return arms;
}

inline std::vector<ArmTally> play_arms(
    const sim::Scenario& scenario, const std::vector<Arm>& arms, const PlayPlan& plan,
    const std::function<void(std::size_t, std::size_t)>& progress = [](std::size_t, std::size_t) {}) {
  log::StudyResults results{"", "a test\n"};
  const auto told = [&](std::size_t done, std::size_t all, const std::string&) { progress(done, all); };
  return tallies_of(play_missing({{"test", scenario, arms}}, plan, results, told).rows);
}

}  // namespace trivela::experiment
