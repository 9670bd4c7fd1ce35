#pragma once

#include <span>
#include <vector>

#include "evaluator/report/gate.hpp"
#include "evaluator/report/table2.hpp"

namespace trivela::evaluator {

/// What a gate on a report may ask; docs/evaluation.md says what each is.
const GateMetrics& report_gate_metrics();

/// Asks the report. Arms of an experiment are not added up: a gate that would need it has no data.
std::vector<GateResult> judge_gates(const Report& report, std::span<const Gate> gates);

}  // namespace trivela::evaluator
