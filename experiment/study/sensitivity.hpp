#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiment/study/report.hpp"
#include "kicking/policy/policy_config.hpp"
#include "sim/scenario.hpp"

namespace trivela::experiment {

/// An input of the world that nobody measured, or few did, or a setting of the policies that somebody chose, and how
/// far it may be off. Values in the unit of its key; a law's is its place among those that the key may name, from 0.
struct UncertainInput {
  std::string key;  ///< as in a scenario file, "kicker.delay_s", or in default.toml, "policy.settle_s"
  double low;
  double high;
  std::string why;  ///< these two
};

/// A table of columns key, low, high and why, such as config/studies/sensitivity.csv. Throws config::Error naming file,
/// line and key for a key or a value that is none, and for an empty table.
std::vector<UncertainInput> load_inputs(const std::string& path);

/// Whether it can change anything: a keeper's where there is one, defenders' where there are some, all others always.
bool in_force(const sim::Scenario& scenario, const UncertainInput& input);

/// Is it a setting of the policies?
bool is_setting(std::string_view key);

/// The value of `key` in the unit of its name. Throws std::invalid_argument for a key that is no number there.
double value_of(const sim::Scenario& scenario, const std::string& key);
double value_of(const kicking::PolicyConfig& policy, const std::string& key);

/// The scenario, or the settings, with another value there. Throws std::invalid_argument as value_of(), and for a
/// value that is refused there.
sim::Scenario with(const sim::Scenario& scenario, const std::string& key, double value);
kicking::PolicyConfig with(const kicking::PolicyConfig& policy, const std::string& key, double value);

/// The value for people: a law by its name.
std::string value_text(const std::string& key, double value);

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
  StudyPlayed played{};
  std::vector<std::string> arms{};  ///< names, at least two
  std::vector<ArmTally> base{};     ///< the scenario as it is
  std::vector<PlayedInput> inputs{};
  Measure measure = Measure::kPerOpportunity;  ///< or kGoals
};

/// Headline i: shots on target per opportunity, or goals, arm i + 1 minus arm i. There is one less than there are arms.
Effect headline(const std::vector<ArmTally>& arms, std::size_t i, Measure measure = Measure::kPerOpportunity);

/// Headline i at an end minus headline i of the scenario, on the same opportunities.
Effect change(const SensitivityReport& report, const PlayedEnd& end, std::size_t i);

/// The largest change of any headline at any end, without its sign: what the inputs are sorted by.
double largest_change(const SensitivityReport& report, const PlayedInput& input);

/// Largest first.
void sort_by_change(SensitivityReport& report);

/// A row an arm of the scenario as it is, and an arm of each input at each end, with the change of its headline.
std::vector<StudyRow> rows_of(const SensitivityReport& report);
std::string to_text(const SensitivityReport& report);
Json to_json(const SensitivityReport& report);

/// A bar for each end of each input, a panel a headline (tornado.cpp).
std::string to_svg(const SensitivityReport& report);

}  // namespace trivela::experiment
