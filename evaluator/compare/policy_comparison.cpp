#include "evaluator/compare/policy_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "evaluator/stats/test_plan.hpp"

namespace trivela::evaluator {
namespace {

/// The ending where goals count: a ball inside of which nobody knows whether it was saved is unknown.
Ending past_keeper(const Opportunity& o) {
  if (o.ending == Ending::kBlocked) return Ending::kOutside;
  if (o.ending != Ending::kInside) return o.ending;
  return !o.saved ? Ending::kUnknown : *o.saved ? Ending::kOutside : Ending::kInside;
}

GroupResult group_result(const KickDataset& dataset, std::uint32_t group) {
  GroupResult result;
  result.name = dataset.groups[group];
  result.blocked_apart = dataset.blocked_apart;
  result.by_truth = dataset.outcome == "truth";
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<stats::ClusterCounts, 3>> cells;  // match, calibration
  for (const Opportunity& o : dataset.opportunities) {
    if (o.group != group) continue;
    result.opportunities += dataset.has_opportunities ? 1 : 0;
    result.add(o);
    if (!dataset.has_matches) continue;
    const stats::ClusterCounts empty{o.match, o.calibration, {}};
    auto& [all, known, past] =
        cells.try_emplace({o.match, o.calibration}, std::array{empty, empty, empty}).first->second;
    add(all.counts, o.ending);
    add(past.counts, past_keeper(o));
    if (o.ending == Ending::kInside || o.ending == Ending::kOutside) add(known.counts, o.ending);
  }
  std::vector<stats::ClusterCounts> opportunities, kicks, goals;
  std::set<std::uint32_t> matches;
  for (const auto& [key, cell] : cells) {
    matches.insert(key.first);
    opportunities.push_back(cell[0]);
    kicks.push_back(cell[1]);
    goals.push_back(cell[2]);
  }
  result.matches = matches.size();
  const auto by_match = stats::clustered_wilson(kicks);
  result.efficiency_ci = by_match.value_or(stats::wilson_or_exact(result.counts()));
  result.per_opportunity_ci =
      stats::clustered_wilson(opportunities).value_or(stats::wilson_or_exact(result.per_opportunity()));
  result.goals_ci =
      stats::clustered_wilson(goals).value_or(stats::wilson_or_exact({result.goals(), result.opportunities}));
  result.by_match = by_match.has_value();
  std::set<std::uint32_t> timed;
  for (const auto& [key, minutes] : dataset.minutes) {
    timed.insert(key.second);
    if (key.first == group) result.played_min = result.played_min.value_or(0.0) + minutes;
  }
  const auto has_no_minutes = [&](const Opportunity& o) {
    return o.group == group && o.ending != Ending::kNoKick && !timed.contains(o.match);
  };
  if (std::ranges::any_of(dataset.opportunities, has_no_minutes)) result.played_min.reset();
  return result;
}

/// The cells, by match and calibration as cells_of() has them, of all strata together.
std::vector<stats::MatchCounts> without_strata(const std::vector<stats::MatchCounts>& cells) {
  std::vector<stats::MatchCounts> result;
  for (const stats::MatchCounts& cell : cells) {
    if (result.empty() || result.back().match != cell.match || result.back().calibration != cell.calibration)
      result.push_back({cell.match, 0, {}, {}, cell.calibration});
    add(result.back().older, cell.older);
    add(result.back().newer, cell.newer);
  }
  return result;
}

// The crude difference: over all strata together.
std::optional<Effect> effect(const std::vector<stats::MatchCounts>& cells, bool has_matches) {
  Effect result;
  for (const stats::MatchCounts& cell : cells) {
    add(result.older, cell.older);
    add(result.newer, cell.newer);
  }
  if (result.older.n == 0 || result.newer.n == 0) return std::nullopt;
  result.difference = *stats::efficiency(result.newer) - *stats::efficiency(result.older);
  result.independent = stats::newcombe_or_exact(result.older, result.newer);
  if (has_matches) result.clustered = stats::clustered_difference(without_strata(cells));
  return result;
}

// The same dataset with goals as what is inside.
KickDataset goals_of(KickDataset dataset) {
  for (Opportunity& o : dataset.opportunities) o.ending = past_keeper(o);
  return dataset;
}

std::optional<Effect> goals_effect(const KickDataset& goals, std::uint32_t place, bool paired) {
  if (!paired) return effect(cells_of(goals, 0, place, true), goals.has_matches);
  const auto played = paired_opportunities(goals, 0, place);
  auto result = effect(played.cells, goals.has_matches);
  if (result) result->independent = stats::paired_newcombe(played.counts);
  return result;
}

Stratified stratified(const KickDataset& dataset, const std::vector<stats::MatchCounts>& cells, bool of_opportunities) {
  Stratified result;
  result.column = dataset.stratified_by;
  result.of_opportunities = of_opportunities;
  std::vector<stats::Stratum> all(dataset.strata.size() + 1);
  std::vector<stats::MatchCounts> known;
  stats::Stratum crude;
  for (const stats::MatchCounts& cell : cells) {
    add(all[cell.stratum].older, cell.older);
    add(all[cell.stratum].newer, cell.newer);
    add(crude.older, cell.older);
    add(crude.newer, cell.newer);
    if (cell.stratum < dataset.strata.size()) known.push_back(cell);
  }
  const double crude_sign =
      crude.older.n > 0 && crude.newer.n > 0 ? *stats::efficiency(crude.newer) - *stats::efficiency(crude.older) : 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool both = all[i].older.n > 0 && all[i].newer.n > 0;
    if (i == dataset.strata.size() || !both) result.left_out += all[i].older.n + all[i].newer.n;
    if (i == dataset.strata.size() || all[i].older.n + all[i].newer.n == 0) continue;
    const double sign = both ? *stats::efficiency(all[i].newer) - *stats::efficiency(all[i].older) : 0.0;
    result.strata.push_back({dataset.strata[i], all[i], sign * crude_sign < 0.0});
  }
  all.pop_back();
  result.odds_ratio = stats::mantel_haenszel_odds_ratio(all);
  result.cmh = stats::cochran_mantel_haenszel(all);
  result.cmh_corrected = stats::cochran_mantel_haenszel(all, true);
  result.risk_difference = stats::mantel_haenszel_risk_difference(all);
  result.standardised = stats::standardised(all);
  if (dataset.has_matches) result.clustered = stats::clustered_difference(known);
  result.homogeneity = stats::breslow_day(all);
  result.simpson = result.standardised && crude_sign * result.standardised->difference.value < 0.0;
  return result;
}

// `place` of the newer one in the dataset; the older one is its first.
std::optional<stats::RateRatio> rate(const KickDataset& dataset, const GroupResult& older, const GroupResult& newer,
                                     std::uint32_t place, bool inside_only) {
  if (!older.kicks_per_min() || !newer.kicks_per_min()) return std::nullopt;
  std::vector<stats::MatchRates> matches(dataset.has_matches ? dataset.matches : 0);
  for (std::uint32_t m = 0; m < matches.size(); ++m) matches[m].match = m;
  for (const auto& [key, minutes] : dataset.minutes) {
    if (key.second < matches.size() && (key.first == 0 || key.first == place))
      (key.first == 0 ? matches[key.second].older : matches[key.second].newer).minutes = minutes;
  }
  for (const Opportunity& o : dataset.opportunities) {
    if (o.match >= matches.size() || (o.group != 0 && o.group != place)) continue;
    const bool counts = inside_only ? o.ending == Ending::kInside : o.ending != Ending::kNoKick;
    (o.group == 0 ? matches[o.match].older : matches[o.match].newer).events += counts ? 1 : 0;
  }
  if (const auto by_match = stats::clustered_rate_ratio(matches)) return by_match;
  const auto events = [&](const GroupResult& group) { return inside_only ? group.inside() : group.kicks(); };
  return stats::rate_ratio({events(older), *older.played_min}, {events(newer), *newer.played_min});
}

PairResult pair_result(const KickDataset& dataset, const GroupResult& older, const GroupResult& newer,
                       std::uint32_t place, double smallest_effect) {
  PairResult pair;
  pair.older = older.name;
  pair.newer = newer.name;
  pair.design = dataset.design;
  if (dataset.design == Design::kPaired) {
    const auto played = paired_opportunities(dataset, 0, place);
    if (played.counts.n() > 0) {
      pair.pairs = played.counts;
      pair.unpaired = played.unpaired;
      pair.mcnemar_p = stats::mcnemar_two_sided(played.counts);
      pair.per_opportunity = effect(played.cells, dataset.has_matches);
      pair.per_opportunity->independent = stats::paired_newcombe(played.counts);
    } else {
      pair.design = Design::kBeforeAfter;
    }
  }
  const auto kicks = cells_of(dataset, 0, place, false);
  pair.efficiency = effect(kicks, dataset.has_matches);
  if (dataset.has_opportunities && !pair.pairs) {
    pair.per_opportunity = effect(cells_of(dataset, 0, place, true), dataset.has_matches);
  }
  if (pair.efficiency)
    pair.kicks = compare({older.name, older.counts()}, {newer.name, newer.counts()}, smallest_effect);
  if (!dataset.strata.empty()) {
    const bool of_opportunities = dataset.has_opportunities && !dataset.strata_of_kicks;
    pair.stratified =
        stratified(dataset, of_opportunities ? cells_of(dataset, 0, place, true) : kicks, of_opportunities);
  }
  pair.on_target_rate = rate(dataset, older, newer, place, true);
  pair.kick_rate = rate(dataset, older, newer, place, false);
  pair.unknown = older.unknown() + newer.unknown();
  pair.expected_wrong = older.doubt.sum() + newer.doubt.sum();
  if (!pair.efficiency && !pair.per_opportunity) {
    const GroupResult& empty = older.counts().n == 0 ? older : newer;
    pair.why_none = fmt::format("{} has no kick whose outcome is known, so there is nothing to compare", empty.name);
    return pair;
  }
  const auto known = [&](const GroupResult& g) {
    const auto counts = pair.per_opportunity ? stats::Counts{g.inside(), g.opportunities - g.unknown()} : g.counts();
    return stats::DoubtfulCounts{counts, g.unknown(), g.doubt};
  };
  pair.bounds = stats::difference_bounds(known(older), known(newer));
  pair.headline = headline_of(pair, smallest_effect);
  return pair;
}

/// An interval clear of 0 is not enough where the p of the test, for as many comparisons as were made, is not small.
void say_holm(Headline& headline, double p_holm) {
  using stats::Verdict;
  headline.p_holm = p_holm;
  const bool differs = headline.verdict == Verdict::kBetter || headline.verdict == Verdict::kBetterMaybeTooSmall ||
                       headline.verdict == Verdict::kWorse;
  if (differs && p_holm > 1.0 - stats::kConfidence) headline.verdict = Verdict::kNotEnoughData;
}

}  // namespace

void adjust_together(std::span<PairResult* const> pairs) {
  std::vector<double> p_values;
  for (const PairResult* const pair : pairs) {
    if (pair->headline) p_values.push_back(pair->headline->p);
  }
  const auto adjusted = stats::holm(p_values);
  std::size_t next = 0;
  for (PairResult* const pair : pairs) {
    if (pair->headline) say_holm(*pair->headline, adjusted[next++]);
  }
}

PolicyComparison compare_policies(KickDataset dataset, const std::string& by, double smallest_effect) {
  PolicyComparison result;
  result.by = by;
  result.smallest_effect = smallest_effect;
  std::int64_t kicks = 0;
  for (std::uint32_t group = 0; group < dataset.groups.size(); ++group) {
    result.groups.push_back(group_result(dataset, group));
    kicks += result.groups.back().kicks();
  }
  if (dataset.opportunities.empty()) throw std::runtime_error("there are no kicks, so there is nothing to compare");
  if (dataset.groups.size() < 2) {
    throw std::runtime_error(fmt::format("the only {} is '{}': a comparison needs two", by, dataset.groups.front()));
  }
  if (kicks == 0) {
    throw std::runtime_error(fmt::format("there are {} opportunities but no kick, so there is nothing to compare",
                                         dataset.opportunities.size()));
  }
  const auto goals = dataset.keeper && dataset.has_opportunities ? std::optional(goals_of(dataset)) : std::nullopt;
  for (std::uint32_t place = 1; place < dataset.groups.size(); ++place) {
    result.pairs.push_back(pair_result(dataset, result.groups[0], result.groups[place], place, smallest_effect));
    PairResult& pair = result.pairs.back();
    if (goals) pair.goals = goals_effect(*goals, place, pair.pairs.has_value());
  }
  std::vector<PairResult*> pairs;
  for (PairResult& pair : result.pairs) pairs.push_back(&pair);
  adjust_together(pairs);
  if (dataset.planned_shares.size() == dataset.groups.size()) {
    std::vector<std::int64_t> counts(dataset.groups.size());
    for (const Opportunity& o : dataset.opportunities) ++counts[o.group];
    result.sample_ratio_p = stats::sample_ratio_p(counts, dataset.planned_shares);
  }
  dataset.opportunities.clear();
  result.dataset = std::move(dataset);
  return result;
}

}  // namespace trivela::evaluator
