#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiment/factorial/analysis.hpp"
#include "experiment/factorial/pair.hpp"

namespace trivela::experiment {

/// What a run of the factorial found, and under which assumptions.
struct FactorialReport {
  std::string scenario;               ///< name of its file
  std::vector<std::string> robots{};  ///< names
  std::uint64_t seed = 1;
  std::uint32_t matches = 0;
  std::uint32_t possessions = 0;   ///< opportunities a match
  double hand_eye_sd_m = 0.0;      ///< of the old table: error of a height judged by eye
  double hand_day_sd_ratio = 0.0;  ///< and of the kicker from day to day
  double opponent_median_m = 0.0;
  Law sweep_law = Law::kReleased;
  Measure efficiency = Measure::kEfficiency;  ///< kUnblocked: blocked kicks stand apart
  bool keeper = false;                        ///< goals mean something
  std::vector<PlayedCell> cells{};
  std::vector<SweepPoint> sweep{};  ///< empty: not asked for
  std::vector<BiasPoint> biases{};  ///< empty: not asked for
};

std::string to_text(const FactorialReport& report);
nlohmann::ordered_json to_json(const FactorialReport& report);

/// A row a cell and a row a point of the sweep and side: kind, table, policy, law, opponent_median_m, opportunities,
/// kicks, on_target and both measures with their intervals, which are empty where there are too few kicks; blocked and
/// bounced kicks, goals; and, of rows of kind "bias", the common error of the eye.
std::string to_csv(const FactorialReport& report);

/// Shots on target per opportunity over the table, a line a policy and law, with 95 % intervals.
std::string to_svg(const FactorialReport& report);

}  // namespace trivela::experiment
