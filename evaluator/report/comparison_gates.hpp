#pragma once

#include <span>
#include <vector>

#include "evaluator/report/gate.hpp"
#include "evaluator/report/policy_comparison.hpp"

namespace trivela::evaluator {

/// What a gate on a comparison may ask. A subject is a group; of difference, its ends and p the newer one. Without a
/// subject each group, or each pair, has to pass.
const GateMetrics& comparison_gate_metrics();

std::vector<GateResult> judge_gates(const PolicyComparison& comparison, std::span<const Gate> gates);
std::vector<GateResult> judge_gates(const Comparison& comparison, std::span<const Gate> gates);

}  // namespace trivela::evaluator
