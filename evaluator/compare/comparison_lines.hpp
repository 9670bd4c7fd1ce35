#pragma once

#include <span>
#include <string>

#include "evaluator/compare/comparison.hpp"
#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/render/json_values.hpp"

namespace trivela::evaluator {

/// The numbers of a comparison of counts, a line each, indented by two blanks.
std::string counts_lines(const Comparison& comparison);

/// The same without the kicks needed, which a comparison of matches has for its headline.
std::string efficiency_lines(const Comparison& comparison);

/// The same as JSON; the keys are those of to_json().
Json counts_json(const Comparison& comparison);

/// A line for each under a title; empty where there is none.
std::string gates_text(std::span<const GateResult> gates);

/// A line for each, and what the design allows to be said; empty where there is none.
std::string between_logs_text(std::span<const BetweenLogs> between);

/// Who of a pair is better, by how much, how sure, how many more are needed; p is adjusted for so many comparisons.
std::string short_line_of(const PairResult& pair, const PolicyComparison& comparison, std::size_t comparisons);

/// A line with a name in a column of its own.
std::string named_line(const std::string& name, const std::string& value);

/// "0.00118"; tiny ones "below 1e-280".
std::string p_value(double p);

/// "+23.4 percentage points".
std::string points(double difference);

/// "+9.3 to +37.0".
std::string points(stats::Interval interval);

/// "- " and the sentence, broken before 110 columns; further lines are indented.
std::string bullet(const std::string& sentence);

/// Breaks a sentence before `width` columns; further lines begin with `indent`.
std::string wrapped(const std::string& sentence, const std::string& indent, std::size_t width = 110);

}  // namespace trivela::evaluator
