#include "experiment/study/studies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trivela::experiment {
namespace {

StudyReport answer_of_arms(const Study& study, std::vector<StudyRow>& rows, const StudyPlayed& played) {
  StudyReport answer;
  for (StudyRow& row : rows) {
    answer.text += label_warning(row.label("arm"), row.matches);
    if (&row == &rows.front()) continue;
    for (const Measure measure : {played.efficiency, Measure::kPerOpportunity})
      row.changes.push_back(difference(row.matches, rows.front().matches, measure));
  }
  answer.svg = chart_of(rows, "", {played.efficiency, Measure::kPerOpportunity}, study.changes);
  return answer;
}

StudyReport answer_of_worlds(const Study& study, std::vector<StudyRow>& rows, std::size_t rival) {
  const std::size_t arms = study.worlds.front().arms.size();
  std::vector<std::size_t> below(arms);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i % arms == rival) continue;
    const StudyRow& against = rows[i - i % arms + rival];
    const Effect change = difference(rows[i].matches, against.matches, Measure::kPerOpportunity);
    rows[i].changes = {change};
    below[i % arms] += has_interval(change) && change.ci.lo < 0.0 ? 1 : 0;
  }
  const std::string& name = rows[rival].label("arm");
  StudyReport answer{.text = "\nNo robot is calibrated again. Worlds where the interval reaches below 0:\n",
                     .json = {{"rival", name}},
                     .svg = chart_of(rows, "arm", {Measure::kPerOpportunity}, study.changes)};
  for (std::size_t i = 0; i < arms; ++i)
    if (i != rival)
      answer.text += fmt::format("  {} - {}: {} of {}\n", rows[i].label("arm"), name, below[i], rows.size() / arms);
  for (const StudyWorld& world : study.worlds)
    answer.json["worlds"].push_back({{"world", world.what}, {"why", world.why}});
  return answer;
}

bool on_frontier(const StudyRow& row) { return !row.label("threshold").empty(); }

double share(const MatchTally& tally, Measure measure) {
  return evaluator::stats::efficiency(counts_of(tally, measure)).value_or(std::nan(""));
}

StudyReport answer_of_frontier(const Study& study, std::vector<StudyRow>& rows, const StudyPlayed&) {
  for (StudyRow& row : rows)
    if (!on_frontier(row) && &row != &rows.back()) row.changes = {frontier_above(rows, row)};
  const StudyRow& best = *std::ranges::max_element(
      rows, {}, [](const StudyRow& row) { return on_frontier(row) ? total_of(row.matches).on_target : -1; });
  Effect of_oracle = jackknife({&best.matches, &rows.back().matches}, [](const std::vector<MatchTally>& totals) {
    return static_cast<double>(totals[0].on_target) / static_cast<double>(totals[1].on_target);
  });
  of_oracle.ci.lo = has_interval(of_oracle) ? std::max(of_oracle.ci.lo, 0.0) : of_oracle.ci.lo;
  return {.text = fmt::format("At its best threshold, {}, {} has {} % of the oracle's shots on target.\n",
                              best.label("threshold"), best.label("policy"), share_text(of_oracle)),
          .json = {{"policy", best.label("policy")},
                   {"of_oracle", {{"threshold", std::stod(best.label("threshold"))}, {"share", json_of(of_oracle)}}}},
          .svg = chart_of(rows, "", {Measure::kKicks, Measure::kEfficiency}, study.changes)};
}

}  // namespace

Effect frontier_above(const std::vector<StudyRow>& rows, const StudyRow& fixed) {
  const auto kicks_of = [](const StudyRow* row) { return total_of(row->matches).kicks; };
  const std::int64_t kicks = kicks_of(&fixed);
  std::vector<const StudyRow*> points;  // that kick, the most kicks first
  for (const StudyRow& row : rows)
    if (on_frontier(row) && kicks_of(&row) > 0) points.push_back(&row);
  if (kicks == 0 || points.empty()) return {std::nan(""), {}};
  std::ranges::stable_sort(points, std::ranges::greater{}, kicks_of);
  const auto fewer = std::ranges::find_if(points, [&](const StudyRow* point) { return kicks_of(point) < kicks; });
  const bool within = fewer != points.begin() && fewer != points.end();
  const StudyRow& to = within ? **fewer : fewer == points.begin() ? *points.front() : *points.back();
  const StudyRow& from = within ? **std::prev(fewer) : to;
  const auto above = [within](const std::vector<MatchTally>& totals) {
    const MatchTally &more = totals[0], &less = totals[1], &own = totals[2];
    const double efficiency = share(own, Measure::kEfficiency);
    if (!within) return share(less, Measure::kEfficiency) - efficiency;
    const double most = share(more, Measure::kKicks), least = share(less, Measure::kKicks);
    const double part = most > least ? (most - share(own, Measure::kKicks)) / (most - least) : 0.0;
    return std::lerp(share(more, Measure::kPerOpportunity), share(less, Measure::kPerOpportunity), part) /
               share(own, Measure::kKicks) -
           efficiency;
  };
  Effect effect = jackknife({&from.matches, &to.matches, &fixed.matches}, above);
  if (has_interval(effect)) effect.ci = {std::max(effect.ci.lo, -1.0), std::min(effect.ci.hi, 1.0)};
  return effect;
}

Study arms_study(const sim::Scenario& scenario, const std::vector<Arm>& arms) {
  StudyWorld world{.what = "the arms", .scenario = scenario};
  for (const Arm& arm : arms) world.add(arm, {{"arm", arm.name}});
  Study study{.name = "arms", .whom = "arm", .worlds = {std::move(world)}, .answer = answer_of_arms};
  const std::string less = " minus " + arms.front().name;
  if (arms.size() > 1)
    study.changes = {{"minus_first/efficiency", "efficiency" + less},
                     {"minus_first/on_target_per_opportunity", "on target/opp." + less}};
  return study;
}

Study robustness_study(const std::vector<Arm>& arms, const std::string& rival,
                       const std::vector<config::NamedWorld>& worlds) {
  Study study{.name = "robustness", .whom = "arm of a world", .changes = {{"change", "minus " + rival}}};
  for (const config::NamedWorld& named : worlds) {
    StudyWorld& world = study.worlds.emplace_back(StudyWorld{named.name, named.scenario, {}, {}, named.why});
    for (const Arm& arm : arms) world.add(arm, {{"world", named.name}, {"arm", arm.name}});
  }
  const auto place = static_cast<std::size_t>(std::ranges::find(arms, rival, &Arm::name) - arms.begin());
  study.answer = [place](const Study& asked, std::vector<StudyRow>& rows, const StudyPlayed&) {
    return answer_of_worlds(asked, rows, place);
  };
  return study;
}

Study frontier_study(const sim::Scenario& scenario, const Arm& policy, const std::set<double>& thresholds,
                     const std::vector<Arm>& beside) {
  StudyWorld world{.what = "the frontier", .scenario = scenario};
  for (const double threshold : thresholds) {
    world.add(policy, {{"policy", policy.name}, {"threshold", fmt::format("{:g}", threshold)}});
    world.arms.back().settings.policy.predictive.threshold = threshold;
  }
  for (const Arm& arm : beside) world.add(arm, {{"policy", arm.name}, {"threshold", ""}});
  return {.name = "frontier",
          .whom = "policy and threshold",
          .changes = {{"frontier_above", "frontier above"}},
          .worlds = {std::move(world)},
          .answer = answer_of_frontier};
}

}  // namespace trivela::experiment
