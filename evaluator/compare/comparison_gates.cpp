#include "evaluator/render/gate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "evaluator/compare/policy_comparison.hpp"

namespace trivela::evaluator {
namespace {

using Numbers = std::map<std::string, std::optional<double>>;  // by metric; none: there is no such number

/// A group or a pair, which is called like its newer group.
struct NumbersOf {
  std::string name;
  Numbers numbers;
};

std::optional<double> counted(std::int64_t n) { return static_cast<double>(n); }

Numbers of_counts(stats::Counts efficiency, stats::Interval ci) {
  const bool any = efficiency.n > 0;
  return {{"efficiency", stats::efficiency(efficiency)},
          {"efficiency_lo", any ? std::optional(ci.lo) : std::nullopt},
          {"efficiency_hi", any ? std::optional(ci.hi) : std::nullopt},
          {"inside", counted(efficiency.inside)}};
}

NumbersOf of_group(const GroupResult& group) {
  NumbersOf of{group.name, of_counts(group.counts(), group.efficiency_ci)};
  of.numbers["kicks"] = counted(group.kicks());
  of.numbers["unknown_share"] = stats::efficiency({group.unknown(), group.kicks()});
  of.numbers["on_target_per_opportunity"] = stats::efficiency(group.per_opportunity());
  of.numbers["goals_per_opportunity"] = stats::efficiency({group.goals(), group.opportunities});
  of.numbers["kicks_per_min"] = group.kicks_per_min();
  of.numbers["on_target_per_min"] = group.per_min(group.inside());
  return of;
}

NumbersOf of_pair(const PairResult& pair) {
  NumbersOf of{pair.newer, {{"difference", {}}, {"difference_lo", {}}, {"difference_hi", {}}, {"p", {}}}};
  if (!pair.headline) return of;
  of.numbers = {{"difference", pair.headline->difference},
                {"difference_lo", pair.headline->ci.lo},
                {"difference_hi", pair.headline->ci.hi},
                {"p", pair.headline->p_holm}};
  return of;
}

GateResult judged_among(const Gate& gate, const std::vector<NumbersOf>& all) {
  std::vector<Measured> measured;
  std::vector<std::string> names;
  for (const NumbersOf& of : all) {
    const auto number = of.numbers.find(gate.metric);
    if (number == of.numbers.end()) continue;
    names.push_back(of.name);
    if (gate.subject.empty() || gate.subject == of.name)
      measured.push_back({of.name, number->second, "the data do not say it"});
  }
  if (measured.empty())
    measured.push_back({gate.subject, std::nullopt,
                        names.empty() ? "the data do not say it" : fmt::format("it is of {}", fmt::join(names, ", "))});
  return judged(gate, std::move(measured));
}

std::vector<GateResult> judge_all(std::span<const Gate> gates, const std::vector<NumbersOf>& all) {
  std::vector<GateResult> results;
  for (const Gate& gate : gates) results.push_back(judged_among(gate, all));
  return results;
}

}  // namespace

const GateMetrics& comparison_gate_metrics() {
  static const GateMetrics metrics{{"difference", "difference_lo", "difference_hi", "p", "efficiency", "efficiency_lo",
                                    "efficiency_hi", "kicks", "inside", "unknown_share", "on_target_per_opportunity",
                                    "goals_per_opportunity", "kicks_per_min", "on_target_per_min"},
                                   {},
                                   false};
  return metrics;
}

std::vector<GateResult> judge_gates(const PolicyComparison& comparison, std::span<const Gate> gates) {
  std::vector<NumbersOf> all;
  for (const GroupResult& group : comparison.groups) all.push_back(of_group(group));
  for (const PairResult& pair : comparison.pairs) all.push_back(of_pair(pair));
  return judge_all(gates, all);
}

std::vector<GateResult> judge_gates(const Comparison& c, std::span<const Gate> gates) {
  std::vector<NumbersOf> all;
  for (const NamedCounts& group : {c.older, c.newer}) {
    all.push_back({group.name, of_counts(group.counts, stats::wilson(group.counts))});
    all.back().numbers["kicks"] = counted(group.counts.n);
  }
  all.push_back({c.newer.name,
                 {{"difference", c.difference},
                  {"difference_lo", c.newcombe95.lo},
                  {"difference_hi", c.newcombe95.hi},
                  {"p", c.boschloo_two_sided_p.value_or(c.fisher_two_sided_p)}}});
  return judge_all(gates, all);
}

}  // namespace trivela::evaluator
