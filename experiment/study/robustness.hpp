#pragma once

#include <string>
#include <vector>

#include "experiment/study/report.hpp"

namespace trivela::experiment {

/// A world, played by every arm.
struct PlayedWorld {
  std::string name;
  std::string why;             ///< it is as it is
  std::vector<ArmTally> arms;  ///< in the order of the report's
};

/// How policies stand worlds that are not what the robots believe.
struct RobustnessReport {
  StudyPlayed played{};
  std::vector<std::string> arms{};  ///< names
  std::size_t rival = 0;            ///< place of the arm that the others are compared with
  std::vector<PlayedWorld> worlds{};
};

/// Shots on target per opportunity of an arm less the rival's, on the same opportunities.
Effect against_rival(const RobustnessReport& report, const PlayedWorld& world, std::size_t arm);

/// A row a world and arm; the rival's has no change.
std::vector<StudyRow> rows_of(const RobustnessReport& report);
std::string to_text(const RobustnessReport& report);
Json to_json(const RobustnessReport& report);

/// A heat map: a row a world, a column an arm, dark where more is on target, and the differences from the rival with a
/// frame where the interval lies below 0. Every cell has its number, so that it can be read without colours.
std::string to_svg(const RobustnessReport& report);

}  // namespace trivela::experiment
