#pragma once

#include <string>
#include <vector>

#include "experiment/study/factorial.hpp"
#include "experiment/study/report.hpp"

namespace trivela::experiment {

/// What a run of the factorial found, and under which assumptions.
struct FactorialReport {
  StudyPlayed played{};
  std::vector<std::string> robots{};  ///< names
  double hand_eye_sd_m = 0.0;         ///< of the old table: error of a height judged by eye
  double hand_day_sd_ratio = 0.0;     ///< and of the kicker from day to day
  double opponent_median_m = 0.0;
  Law sweep_law = Law::kReleased;
  std::vector<PlayedCell> cells{};
  std::vector<SweepPoint> sweep{};   ///< by the opponents' median distance; empty: not asked for
  std::vector<SweepPoint> biases{};  ///< by the common error of the old table's maker; empty: not asked for
};

/// Of kind "cell", and of each side of the sweeps' points: "sweep", "bias".
std::vector<StudyRow> rows_of(const FactorialReport& report);

std::string to_text(const FactorialReport& report);
Json to_json(const FactorialReport& report);

/// Shots on target per opportunity over the table, a line a policy and law, with 95 % intervals.
std::string to_svg(const FactorialReport& report);

}  // namespace trivela::experiment
