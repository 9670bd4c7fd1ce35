#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "evaluator/render/json_values.hpp"

namespace trivela::evaluator {

struct Comparison;
struct PolicyComparison;
struct Report;

/// A gate that cannot be read; the message names the position, from 1, and what may stand there.
struct BadGate : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

enum class Relation { kAtLeast, kAtMost, kAbove, kBelow, kEqual };

/// A condition for teams and CI:
///   METRIC[(SUBJECT[, robot N])] RELATION NUMBER[%]
/// such as efficiency(moving)>=0.7, kicks(robot 2)>=10, missing_rows==0. SUBJECT: a policy, arm or group, in double
/// quotes where it has , ) or " in it (\" and \\ within); none, or "all": everything together. RELATION: >= <= > < ==.
struct Gate {
  std::string text;  ///< as it was written
  std::string metric;
  std::string subject;          ///< empty: all
  std::optional<int> robot_id;  ///< none: all
  Relation relation = Relation::kAtLeast;
  double bound = 0.0;

  /// NaN never passes.
  bool passes(double value) const;
};

/// The metrics that there are.
struct GateMetrics {
  std::vector<std::string> of_subject;
  std::vector<std::string> of_whole;  ///< that take no subject
  bool robots = false;                ///< a subject may be a robot
};

/// Throws BadGate.
Gate parse_gate(const std::string& text, const GateMetrics& known);

/// A value that a gate asks for.
struct Measured {
  std::string name;             ///< whose; empty: of all
  std::optional<double> value;  ///< none: there is no such number
  std::string why{};            ///< there is none
};

struct GateResult {
  std::string gate;
  bool met = false;
  std::vector<Measured> measured;

  /// "gate met: efficiency(moving)>=0.7: 0.758", "gate MISSED: ...: no data: why".
  std::string sentence() const;
};

/// [{gate, met, measured: [{name, value, why}]}]; null where there is no such value.
Json gates_json(std::span<const GateResult> gates);

/// A gate is met where there is a value and each passes.
GateResult judged(const Gate& gate, std::vector<Measured> measured);

/// What a gate on a report may ask; docs/evaluation.md says what each is.
const GateMetrics& report_gate_metrics();

/// Asks the report. Arms of an experiment are not added up: a gate that would need it has no data.
std::vector<GateResult> judge_gates(const Report& report, std::span<const Gate> gates);

/// What a gate on a comparison may ask. A subject is a group; of difference, its ends and p the newer one. Without a
/// subject each group, or each pair, has to pass.
const GateMetrics& comparison_gate_metrics();

std::vector<GateResult> judge_gates(const PolicyComparison& comparison, std::span<const Gate> gates);
std::vector<GateResult> judge_gates(const Comparison& comparison, std::span<const Gate> gates);

}  // namespace trivela::evaluator
