#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluator/render/gate.hpp"
#include "evaluator/stats/bayes.hpp"
#include "evaluator/stats/counts/exact.hpp"
#include "evaluator/stats/counts/interval.hpp"

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
  std::optional<double> relative_gain;             ///< p_new / p_old - 1
  std::optional<stats::Ratio> risk_ratio;          ///< Katz
  std::optional<stats::Ratio> odds_ratio;          ///< Woolf
  double fisher_one_sided_p = 1.0;                 ///< that the newer is better
  double fisher_two_sided_p = 1.0;                 ///< sum of the probabilities not above the table's
  std::optional<double> boschloo_one_sided_p;      ///< none: too many kicks
  std::optional<double> boschloo_two_sided_p;      ///< twice the smaller one-sided p
  double p_new_better = 0.5;                       ///< uniform priors
  stats::PosteriorDifference posterior;            ///< of p_new - p_old, uniform priors
  double smallest_effect = 0.05;                   ///< smallest difference of interest
  double p_gain_above_smallest = 0.0;              ///< P(p_new - p_old > smallest_effect)
  double expected_loss_of_newer = 0.0;             ///< efficiency lost on average by choosing the newer one
  std::optional<stats::Interval> agresti_caffo95;  ///< where a cell has fewer than 10 kicks
  std::optional<stats::Fragility> fragility;       ///< none: Fisher's p is 0.05 or above already
  std::optional<double> e_value;                   ///< of the risk ratio
  std::optional<double> e_value_ci;                ///< of the end of its interval next to 1; 1 where it holds 1
  stats::Verdict verdict{};                        ///< of Newcombe's interval
  double needed_for_smallest = 0.0;                ///< kicks of each for the smallest effect, power 80 %
  std::optional<double> needed_for_seen;           ///< the same for the difference seen; none: it is 0

  std::vector<GateResult> gates;  ///< of whoever asked (judge_gates())

  /// The counts are the paper's Table 2: 34 of 65 and 100 of 132.
  bool is_table2() const;
};

/// Compares two groups, each with at least one kick.
Comparison compare(const NamedCounts& older, const NamedCounts& newer, double smallest_effect = stats::kSmallestEffect);

/// "better", "better, maybe too small", "equivalent", "worse", "not enough data".
const char* label(stats::Verdict verdict);

/// What the numbers do and do not say; with the paper's counts also what its prose got wrong.
std::vector<std::string> notes(const Comparison& comparison);

std::string to_text(const Comparison& comparison);

/// One line: who is better, by how much, how sure, how many kicks more are needed.
std::string to_short_text(const Comparison& comparison);

/// Keys: old, new, difference, newcombe95, relative_gain, risk_ratio, risk_ratio_ci95, odds_ratio, odds_ratio_ci95,
/// fisher_one_sided_p, fisher_two_sided_p, boschloo_one_sided_p, boschloo_two_sided_p, two_sided_definition,
/// p_new_better, prior, posterior_median, posterior_ci95, smallest_effect, p_gain_above_smallest,
/// expected_loss_of_new, agresti_caffo95, fragility, e_value, e_value_ci, verdict, needed_kicks_for_smallest,
/// needed_kicks_for_seen, notes. null where there is no such number.
std::string to_json(const Comparison& comparison);

}  // namespace trivela::evaluator
