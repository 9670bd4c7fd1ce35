#include <cmath>

#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/render/json_values.hpp"

namespace trivela::evaluator {
namespace {

Json inside_of_n(stats::Counts counts) { return {{"inside", counts.inside}, {"n", counts.n}}; }

// Infinity, which JSON does not have, as null.
Json finite(double x) { return std::isfinite(x) ? Json(x) : Json(); }

Json group_json(const GroupResult& g, bool keeper, bool blocked_apart) {
  return {{"name", g.name},
          {"opportunities", g.opportunities > 0 ? Json(g.opportunities) : Json()},
          {"kicks", g.kicks()},
          {"inside", g.inside()},
          {"outside", g.outside()},
          {"unknown", g.unknown()},
          {"expected_wrong", {{"inside", g.doubt.inside}, {"outside", g.doubt.outside}}},
          {"blocked", blocked_apart ? Json(g.blocked()) : Json()},
          {"bounced", said_json(g.inside_kicks.bounced, "bounced")},
          {"saved", said_json(g.inside_kicks.saved, "saved")},
          {"goals", keeper ? Json(g.goals()) : Json()},
          {"goal_not_known", keeper ? Json(g.goal_not_known()) : Json()},
          {"goals_per_opportunity", keeper ? json_of(stats::efficiency({g.goals(), g.opportunities})) : Json()},
          {"goals_per_opportunity_ci95", keeper && g.opportunities > 0 ? json_of(g.goals_ci) : Json()},
          {"matches", g.matches > 0 ? Json(g.matches) : Json()},
          {"efficiency", json_of(stats::efficiency(g.counts()))},
          {"efficiency_ci95", json_of(g.efficiency_ci)},
          {"efficiency_bounds", g.is_bounded() ? json_of(g.efficiency_bounds()) : Json()},
          {"ci_by_match", g.by_match},
          {"kicks_per_opportunity",
           g.opportunities > 0 ? Json(static_cast<double>(g.kicks()) / static_cast<double>(g.opportunities)) : Json()},
          {"on_target_per_opportunity", json_of(stats::efficiency(g.per_opportunity()))},
          {"on_target_per_opportunity_ci95", g.opportunities > 0 ? json_of(g.per_opportunity_ci) : Json()},
          {"minutes", json_of(g.played_min)},
          {"kicks_per_min", json_of(g.kicks_per_min())},
          {"on_target_per_min", json_of(g.per_min(g.inside()))}};
}

Json clustered_json(const std::optional<stats::Clustered>& c) {
  if (!c) return {};
  return {{"difference", c->value},
          {"ci95", json_of(c->ci)},
          {"standard_error", c->standard_error},
          {"df", c->df},
          {"design_effect", c->design_effect},
          {"old_matches", c->older_matches},
          {"new_matches", c->newer_matches},
          {"calibrations", c->calibrations},
          {"by_calibration", c->by_calibration}};
}

Json effect_json(const std::optional<Effect>& e) {
  if (!e) return {};
  return {{"old", inside_of_n(e->older)},
          {"new", inside_of_n(e->newer)},
          {"difference", e->difference},
          {"independent_ci95", json_of(e->independent)},
          {"clustered", clustered_json(e->clustered)}};
}

Json test_json(const std::optional<stats::ChiSquare>& test) {
  if (!test) return {};
  return {{"chi_square", test->statistic}, {"df", test->df}, {"p", test->p}};
}

Json stratified_json(const std::optional<Stratified>& s) {
  if (!s) return {};
  const auto stratum_json = [](const StratumResult& row) {
    return Json{{"name", row.name},
                {"old", inside_of_n(row.counts.older)},
                {"new", inside_of_n(row.counts.newer)},
                {"reversed", row.reversed}};
  };
  Json json = {{"column", s->column},
               {"unit", s->of_opportunities ? "opportunity" : "kick"},
               {"strata", json_list(s->strata, stratum_json)}};
  json["left_out"] = s->left_out;
  json["mh_odds_ratio"] = s->odds_ratio ? Json(s->odds_ratio->value) : Json();
  json["mh_odds_ratio_ci95"] = s->odds_ratio ? json_of(s->odds_ratio->ci) : Json();
  json["cmh"] = test_json(s->cmh);
  json["cmh_corrected"] = test_json(s->cmh_corrected);
  json["mh_risk_difference"] = s->risk_difference ? Json(s->risk_difference->value) : Json();
  json["mh_risk_difference_ci95"] = s->risk_difference ? json_of(s->risk_difference->ci) : Json();
  json["standardised"] = s->standardised ? Json{{"weights", "pooled share of each stratum that both have"},
                                                {"old", s->standardised->older},
                                                {"new", s->standardised->newer},
                                                {"difference", s->standardised->difference.value},
                                                {"ci95", json_of(s->standardised->difference.ci)},
                                                {"clustered", clustered_json(s->clustered)}}
                                         : Json();
  json["breslow_day"] = test_json(s->homogeneity);
  json["simpson"] = s->simpson;
  return json;
}

Json rate_json(const std::optional<stats::RateRatio>& ratio) {
  if (!ratio) return {};
  return {{"ratio", finite(ratio->value)},
          {"ci95", Json::array({finite(ratio->ci.lo), finite(ratio->ci.hi)})},
          {"p", ratio->p},
          {"method", ratio->by_match ? "clustered by match" : "Poisson, exact"}};
}

Json headline_json(const PairResult& pair) {
  if (!pair.headline) return {};
  const Headline& h = *pair.headline;
  return {{"measure", h.of_opportunities ? "on_target_per_opportunity" : "efficiency"},
          {"adjusted", h.adjusted},
          {"by_match", h.by_match},
          {"difference", h.difference},
          {"ci95", json_of(h.ci)},
          {"method", h.method},
          {"p", h.p},
          {"p_method", h.p_method},
          {"p_holm", h.p_holm},
          {"verdict", label(h.verdict)},
          {"needed_of_each_for_smallest", h.needed_for_smallest},
          {"needed_of_each_for_seen", json_of(h.needed_for_seen)}};
}

Json pair_json(const PairResult& pair, const PolicyComparison& c) {
  Json json = {{"old", pair.older},
               {"new", pair.newer},
               {"design", label(pair.design)},
               {"verdict", verdict_sentence(pair, c)},
               {"more_needed", needed_sentence(pair, c)},
               {"headline", headline_json(pair)},
               {"on_target_per_opportunity", effect_json(pair.per_opportunity)},
               {"goals_per_opportunity", effect_json(pair.goals)},
               {"efficiency", effect_json(pair.efficiency)}};
  json["pairs"] = pair.pairs ? Json{{"both", pair.pairs->both},           {"new_only", pair.pairs->newer_only},
                                    {"old_only", pair.pairs->older_only}, {"neither", pair.pairs->neither},
                                    {"without_partner", pair.unpaired},   {"mcnemar_p", pair.mcnemar_p}}
                             : Json();
  json["stratified"] = stratified_json(pair.stratified);
  json["on_target_per_min"] = rate_json(pair.on_target_rate);
  json["kicks_per_min"] = rate_json(pair.kick_rate);
  json["unknown"] = pair.unknown;
  json["expected_wrong"] = pair.expected_wrong;
  json["difference_bounds"] = json_of(pair.bounds);
  json["independent_kicks"] = pair.kicks ? counts_json(*pair.kicks) : Json();
  return json;
}

Json pairs_json(const PolicyComparison& c) {
  return json_list(c.pairs, [&](const PairResult& pair) { return pair_json(pair, c); });
}

Json between_json(const std::vector<BetweenLogs>& between) {
  return json_list(between, [](const BetweenLogs& group) {
    return Json{{"group", group.group},
                {"why_none", group.comparison ? Json() : Json(group.why_none)},
                {"comparisons", group.comparison ? pairs_json(*group.comparison) : Json::array()}};
  });
}

}  // namespace

std::string to_json(const PolicyComparison& c) {
  const auto group = [&](const GroupResult& of) { return group_json(of, c.dataset.keeper, c.dataset.blocked_apart); };
  Json json = {{"by", c.by},
               {"simulated", c.dataset.simulated},
               {"outcome", c.dataset.outcome},
               {"design", label(c.dataset.design)},
               {"design_reason", c.dataset.design_reason},
               {"smallest_effect", c.smallest_effect},
               {"sample_ratio_p", json_of(c.sample_ratio_p)},
               {"groups", json_list(c.groups, group)},
               {"comparisons", pairs_json(c)},
               {"remarks", c.dataset.remarks},
               {"logs", c.logs},
               {"differences", differences_json(c.differences, c.logs)}};
  if (!c.between.empty()) json["between_logs"] = between_json(c.between);
  if (!c.gates.empty()) json["gates"] = gates_json(c.gates);
  return json_text(json);
}

}  // namespace trivela::evaluator
