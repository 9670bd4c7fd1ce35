#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiment/effects/effects.hpp"
#include "experiment/sensitivity/inputs.hpp"

namespace trivela::experiment {

/// An input at one of its two values, played.
struct PlayedEnd {
  double value = 0.0;
  std::vector<ArmTally> arms;  ///< in the order of the report's; the same match numbers as without the change
};

/// An input with what it does.
struct PlayedInput {
  UncertainInput input{};
  double value = 0.0;           ///< the scenario's
  std::vector<PlayedEnd> ends;  ///< low and high; without those that are the scenario's own value
};

/// What a run found, and under which assumptions.
struct SensitivityReport {
  std::string scenario;  ///< name of its file
  std::uint64_t seed = 1;
  std::uint32_t matches = 0;
  std::uint32_t possessions = 0;  ///< opportunities a match
  std::vector<std::string> arms;  ///< names, at least two
  std::vector<ArmTally> base;     ///< the scenario as it is
  std::vector<PlayedInput> inputs;
  Measure measure = Measure::kPerOpportunity;  ///< or kGoals
  std::size_t evenings = 0;                    ///< of calibration; 0: robot files
};

/// Headline i: shots on target per opportunity, or goals, arm i + 1 minus arm i. There is one less than there are arms.
Effect headline(const std::vector<ArmTally>& arms, std::size_t i, Measure measure = Measure::kPerOpportunity);

/// Headline i at an end minus headline i of the scenario, on the same opportunities.
Effect change(const SensitivityReport& report, const PlayedEnd& end, std::size_t i);

/// The largest change of any headline at any end, without its sign: what the inputs are sorted by.
double largest_change(const SensitivityReport& report, const PlayedInput& input);

/// Largest first.
void sort_by_change(SensitivityReport& report);

std::string to_text(const SensitivityReport& report);
nlohmann::ordered_json to_json(const SensitivityReport& report);

/// A row an input, end and arm: input, value, arm, opportunities, kicks, on_target; and a headline's change with its
/// interval where the arm has one before it. The scenario's own values are the rows of input "".
std::string to_csv(const SensitivityReport& report);

/// A bar an input and headline, from its change at the low value to that at the high one, the largest on top.
std::string to_svg(const SensitivityReport& report);

}  // namespace trivela::experiment
