#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/render/gate.hpp"

namespace trivela::cli {

/// Adds --gate, which may stand several times.
inline void add_gates(CLI::App& verb, std::vector<std::string>& gates, const std::string& examples) {
  verb.add_option("--gate", gates, "Exit with 3 where this does not hold, once the report is written: " + examples)
      ->type_name("GATE")
      ->allow_extra_args(false);
}

/// Throws UsageError where one cannot be read.
inline std::vector<evaluator::Gate> parse_gates(const std::vector<std::string>& texts,
                                                const evaluator::GateMetrics& known) try {
  std::vector<evaluator::Gate> gates;
  gates.reserve(texts.size());
  for (const std::string& text : texts) gates.push_back(evaluator::parse_gate(text, known));
  return gates;
} catch (const evaluator::BadGate& bad) {
  throw UsageError(std::string("--gate ") + bad.what());
}

/// A sentence on each that is missed. Whether all are met.
inline bool warn_of_gates(std::span<const evaluator::GateResult> gates) {
  bool met = true;
  for (const evaluator::GateResult& gate : gates) {
    if (!gate.met) warn(gate.sentence());
    met = met && gate.met;
  }
  return met;
}

}  // namespace trivela::cli
