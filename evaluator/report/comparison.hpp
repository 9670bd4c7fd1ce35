#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluator/stats/counts.hpp"
#include "evaluator/stats/interval.hpp"

namespace trivela::evaluator {

/// Kicks of one policy, season or team.
struct NamedCounts {
  std::string name;
  stats::Counts counts;
};

/// Everything that two counts say about each other.
struct Comparison {
  NamedCounts older;
  NamedCounts newer;
  double difference = 0.0;  ///< p_new - p_old
  stats::Interval newcombe95;
  std::optional<double> relative_gain;         ///< p_new / p_old - 1
  std::optional<stats::Ratio> risk_ratio;      ///< Katz
  std::optional<stats::Ratio> odds_ratio;      ///< Woolf
  double fisher_one_sided_p = 1.0;             ///< that the newer is better
  double fisher_two_sided_p = 1.0;             ///< sum of the probabilities not above the table's
  std::optional<double> boschloo_one_sided_p;  ///< none: too many kicks
  std::optional<double> boschloo_two_sided_p;  ///< twice the smaller one-sided p
  double p_new_better = 0.5;                   ///< uniform priors

  /// The counts are the paper's Table 2: 34 of 65 and 100 of 132.
  bool is_table2() const;
};

/// Compares two groups, each with at least one kick.
Comparison compare(const NamedCounts& older, const NamedCounts& newer);

/// What the numbers do and do not say; with the paper's counts also what its prose got wrong.
std::vector<std::string> notes(const Comparison& comparison);

std::string to_text(const Comparison& comparison);

/// Keys: old, new, difference, newcombe95, relative_gain, risk_ratio, risk_ratio_ci95, odds_ratio, odds_ratio_ci95,
/// fisher_one_sided_p, fisher_two_sided_p, boschloo_one_sided_p, boschloo_two_sided_p, two_sided_definition,
/// p_new_better, prior, notes. null where there is no such number.
std::string to_json(const Comparison& comparison);

}  // namespace trivela::evaluator
