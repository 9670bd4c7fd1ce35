#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "evaluator/compare/comparison.hpp"
#include "evaluator/compare/log_differences.hpp"
#include "evaluator/counting/kick_counts.hpp"
#include "evaluator/counting/kick_dataset.hpp"
#include "evaluator/counting/log_kicks.hpp"
#include "evaluator/render/gate.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/stats/clustered.hpp"
#include "evaluator/stats/counts/interval.hpp"
#include "evaluator/stats/counts/strata.hpp"
#include "evaluator/stats/paired.hpp"
#include "evaluator/stats/poisson.hpp"

namespace trivela::evaluator {

/// One policy (table, robot, arm) of a comparison.
struct GroupResult : KickCounts {
  std::string name;
  std::int64_t opportunities = 0;      ///< 0: not known
  std::size_t matches = 0;             ///< 0: not known
  stats::Interval efficiency_ci;       ///< of inside / (inside + outside)
  stats::Interval per_opportunity_ci;  ///< of inside / opportunities
  stats::Interval goals_ci;            ///< of goals / opportunities
  bool by_match = false;               ///< the intervals allow for kicks of one match being alike

  stats::Counts per_opportunity() const { return {inside(), opportunities}; }
  /// There are unknown kicks, or doubt of the labels.
  bool is_bounded() const { return unknown() > 0 || doubt.sum() > 0.0; }
};

/// A difference newer - older of proportions, with everything that can be said for its interval.
struct Effect {
  stats::Counts older;
  stats::Counts newer;
  double difference = 0.0;
  stats::Interval independent;                ///< newcombe_or_exact(); Newcombe's of pairs where there are any
  std::optional<stats::Clustered> clustered;  ///< from matches; none: too few
  const stats::Interval& best() const { return clustered ? clustered->ci : independent; }
};

/// A situation and both policies in it.
struct StratumResult {
  std::string name;
  stats::Stratum counts;
  bool reversed = false;  ///< its difference has another sign than the crude one
};

/// A comparison within strata.
struct Stratified {
  std::string column;
  bool of_opportunities = false;  ///< on target an opportunity; otherwise of kicks
  std::vector<StratumResult> strata;
  std::int64_t left_out = 0;  ///< kicks or opportunities of strata that one policy alone has, or of no known stratum
  std::optional<stats::Ratio> odds_ratio;
  std::optional<stats::ChiSquare> cmh;
  std::optional<stats::ChiSquare> cmh_corrected;
  std::optional<stats::Difference> risk_difference;
  std::optional<stats::Standardised> standardised;
  std::optional<stats::Clustered> clustered;  ///< of the standardised difference
  std::optional<stats::ChiSquare> homogeneity;
  bool simpson = false;  ///< the crude difference and the standardised one have opposite signs
};

/// What the verdict rests on.
struct Headline {
  bool of_opportunities = false;  ///< on target an opportunity; otherwise efficiency of kicks
  bool adjusted = false;          ///< standardised to the pooled mix of situations
  bool by_match = false;
  double difference = 0.0;
  stats::Interval ci;
  std::string method;  ///< of the interval
  double p = 1.0;
  std::string p_method;
  double p_holm = 1.0;
  stats::Verdict verdict = stats::Verdict::kNotEnoughData;
  double needed_for_smallest = 0.0;       ///< kicks or opportunities of each policy for the smallest effect, power 80 %
  std::optional<double> needed_for_seen;  ///< the same if the difference seen is the true one; none: it is 0
};

/// The second policy against the first.
struct PairResult {
  std::string older;
  std::string newer;
  Design design = Design::kBeforeAfter;
  std::optional<Comparison> kicks;           ///< efficiency, kicks taken as independent; none: one has no kick
  std::optional<Effect> efficiency;          ///< of kicks
  std::optional<Effect> per_opportunity;     ///< of opportunities
  std::optional<Effect> goals;               ///< of opportunities; none: no keeper saved anything
  std::optional<stats::PairedCounts> pairs;  ///< opportunities that both had
  std::int64_t unpaired = 0;                 ///< opportunities without a partner
  double mcnemar_p = 1.0;
  std::optional<Stratified> stratified;
  std::optional<stats::RateRatio> on_target_rate;  ///< on target a minute
  std::optional<stats::RateRatio> kick_rate;       ///< kicks a minute
  stats::Interval bounds{-1.0, 1.0};               ///< of the headline's crude difference, if the unknown were known
  std::int64_t unknown = 0;
  double expected_wrong = 0.0;       ///< labels of both
  std::optional<Headline> headline;  ///< none: nothing to compare
  std::string why_none;              ///< why there is no headline
};

struct PolicyComparison;

/// One policy or arm in two logs: the later against the first.
struct BetweenLogs {
  std::string group;
  std::shared_ptr<PolicyComparison> comparison;  ///< by log; none: `why_none` says why
  std::string why_none;
};

/// Policies, tables, robots or arms side by side: the first is the baseline of all others.
struct PolicyComparison {
  std::string by = "policy";
  std::vector<GroupResult> groups;
  std::vector<PairResult> pairs;
  std::optional<double> sample_ratio_p;  ///< that the groups came in their planned shares; none: no plan
  KickDataset dataset;                   ///< what it was made from, without its opportunities
  double smallest_effect = stats::kSmallestEffect;
  std::vector<std::string> logs;           ///< that were compared or taken together; empty: it is of no logs
  std::vector<LogDifference> differences;  ///< between them
  std::vector<BetweenLogs> between;        ///< each group of two logs, the logs compared; empty: nobody asked
  std::vector<GateResult> gates;           ///< of whoever asked (judge_gates())
};

/// Compares every group with the first. Throws std::runtime_error with a sentence where there are fewer than two groups
/// or no kick at all.
PolicyComparison compare_policies(KickDataset dataset, const std::string& by,
                                  double smallest_effect = stats::kSmallestEffect);

/// Adjusts p and verdict of comparisons that are read together, by Holm's method.
void adjust_together(std::span<PairResult* const> pairs);

/// The verdict as a sentence, worded by the design: before and after, a policy "differs".
std::string verdict_sentence(const PairResult& pair, const PolicyComparison& comparison);
/// What the design allows to be said, and what not.
std::string design_sentence(const PairResult& pair, const PolicyComparison& comparison);
/// How many more are needed; empty where there are enough.
std::string needed_sentence(const PairResult& pair, const PolicyComparison& comparison);

/// All of it.
std::string to_text(const PolicyComparison& comparison);

/// What differs between the logs, then a line a pair: who is better, by how much, how sure, how many more are needed.
std::string to_short_text(const PolicyComparison& comparison);

/// How both begin.
std::string head_text(const PolicyComparison& comparison, std::size_t most_differences);

/// Its keys are explained in docs/evaluation.md; null where there is no such number.
std::string to_json(const PolicyComparison& comparison);

/// What the verdict on a pair rests on: shots on target an opportunity where opportunities are known, else efficiency;
/// within strata where that measure has them and the pair is not one of same opportunities; by match where there are
/// enough. `smallest_effect` is a proportion. p is not adjusted for other pairs.
Headline headline_of(const PairResult& pair, double smallest_effect);

/// The numbers of a comparison of counts, a line each, indented by two blanks, without the kicks needed, which a
/// comparison of matches has for its headline.
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

/// An option says what makes no sense for this comparison; the message begins with the option.
struct BadChoice : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// What somebody wants to know of kicks.
struct ComparisonQuestion {
  LogKicks kicks{};                                 ///< how logs are read
  std::string baseline{};                           ///< group that the others are compared with; empty: the first
  std::string design{};                             ///< label of a Design; empty: what the data say
  double smallest_effect = stats::kSmallestEffect;  ///< smallest difference of interest, 0 to 1
};

/// Throws BadChoice where the question makes no sense whatever the kicks are: an unknown design, a smallest effect that
/// is not between 0 and 1.
void check(const ComparisonQuestion& question);

/// compare_policies() with that baseline and design. `by` is what the groups are. Throws BadChoice for a baseline that
/// is no group and for strata that are the groups; std::runtime_error as compare_policies().
PolicyComparison compare_dataset(KickDataset dataset, const std::string& by, const ComparisonQuestion& question);

/// The sessions of all logs together, with what differs between the logs, and of two logs each group between them.
/// Throws BadChoice and BadOption, whose messages begin with the option, and std::runtime_error naming a log that
/// cannot be read.
PolicyComparison compare_logs(const std::vector<std::filesystem::path>& logs, const ComparisonQuestion& question);

/// Each of `groups`, policies or arms as `by` says, in the later logs against the first: yesterday against today. Their
/// p are adjusted together. `options` are those of the comparison of the groups.
std::vector<BetweenLogs> between_logs(const LoggedOpportunities& logged, std::span<const std::string> groups,
                                      const std::string& by, LogKicks options, double smallest_effect);

}  // namespace trivela::evaluator
