#pragma once

#include <string>
#include <vector>

#include "experiment/study/report.hpp"

namespace trivela::experiment {

/// Arms on the same matches, each compared with the first.
struct ArmsReport {
  struct PlayedArm {
    std::string name;
    ArmTally matches;
  };
  StudyPlayed played{};
  std::vector<PlayedArm> arms{};
};

std::vector<StudyRow> rows_of(const ArmsReport& report);
std::string to_text(const ArmsReport& report);

/// With "minus_first" in each row but the first.
Json to_json(const ArmsReport& report);

}  // namespace trivela::experiment
