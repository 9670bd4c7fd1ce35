#include "evaluator/compare/comparison.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/stats/test_plan.hpp"

namespace trivela::evaluator {
namespace {

Json group_json(const NamedCounts& group) {
  return {{"name", group.name},
          {"inside", group.counts.inside},
          {"n", group.counts.n},
          {"efficiency", json_of(stats::efficiency(group.counts))},
          {"wilson95", json_of(stats::wilson(group.counts))}};
}

void add_ratio(Json& json, const std::string& key, const std::optional<stats::Ratio>& ratio) {
  json[key] = ratio ? Json(ratio->value) : Json();
  json[key + "_ci95"] = ratio ? json_of(ratio->ci) : Json();
}

}  // namespace

bool Comparison::is_table2() const {
  return older.counts.inside == 34 && older.counts.n == 65 && newer.counts.inside == 100 && newer.counts.n == 132;
}

const char* label(stats::Verdict verdict) {
  constexpr std::array kLabels{"better", "better, maybe too small", "equivalent", "worse", "not enough data"};
  static_assert(kLabels.size() == static_cast<std::size_t>(stats::Verdict::kNotEnoughData) + 1);
  return kLabels.at(static_cast<std::size_t>(verdict));
}

Comparison compare(const NamedCounts& older, const NamedCounts& newer, double smallest_effect) {
  assert(older.counts.n > 0 && newer.counts.n > 0);
  const auto& k1 = older.counts;
  const auto& k2 = newer.counts;
  const double p1 = *stats::efficiency(k1), p2 = *stats::efficiency(k2);
  Comparison result;
  result.older = older;
  result.newer = newer;
  result.difference = p2 - p1;
  result.newcombe95 = stats::newcombe(k1, k2);
  result.relative_gain = stats::relative_gain(k1, k2);
  result.risk_ratio = stats::risk_ratio(k1, k2);
  result.odds_ratio = stats::odds_ratio(k1, k2);
  result.fisher_one_sided_p = stats::fisher_one_sided(k1, k2);
  result.fisher_two_sided_p = stats::fisher_two_sided(k1, k2);
  result.boschloo_one_sided_p = stats::boschloo_one_sided(k1, k2);
  result.boschloo_two_sided_p = stats::boschloo_two_sided_doubled(k1, k2);
  result.p_new_better = stats::p_new_better(k1, k2);
  result.posterior = stats::posterior_difference(k1, k2);
  result.smallest_effect = smallest_effect;
  result.p_gain_above_smallest = stats::p_new_better(k1, k2, smallest_effect);
  result.expected_loss_of_newer = stats::expected_loss_of_newer(k1, k2);
  if (std::min({k1.inside, k1.n - k1.inside, k2.inside, k2.n - k2.inside}) < 10) {
    result.agresti_caffo95 = stats::agresti_caffo(k1, k2);
  }
  result.fragility = stats::fragility(k1, k2);
  if (result.risk_ratio) {
    const stats::Interval& ci = result.risk_ratio->ci;
    result.e_value = stats::e_value(result.risk_ratio->value);
    result.e_value_ci = ci.lo > 1.0 ? stats::e_value(ci.lo) : ci.hi < 1.0 ? stats::e_value(ci.hi) : 1.0;
  }
  result.verdict = stats::verdict(result.newcombe95, smallest_effect);
  const double other = p1 + smallest_effect <= 1.0 ? p1 + smallest_effect : p1 - smallest_effect;
  result.needed_for_smallest = stats::kicks_per_policy(p1, other).value_or(0.0);
  result.needed_for_seen = stats::kicks_per_policy(p1, p2);
  return result;
}

std::vector<std::string> notes(const Comparison& comparison) {
  std::vector<std::string> notes = {
      "Intervals and tests take every kick as independent; kicks of one match share floor, opponent and calibration, "
      "so the truth is less certain."};
  if (!comparison.is_table2()) return notes;
  const std::vector<std::string> paper = {
      "The paper writes that \"an average of 52% of the kicks would never translate into valid direct goals\": the "
      "wrong way round, 52.3 % went inside; 31 of 65 = 47.7 % went out.",
      "Its \"efficiency improvement of 46%\" comes from the rounded 52 % and 76 %; the counts give 44.8 %, relative. "
      "In percentage points the gain is 23.4.",
      "Its \"overall efficiency\" from 50 % to 83 % and \"increase of over 60%\" is supported by no count, definition "
      "or table: Table 2 has 52.3 % and 75.8 % for the same two tournaments.",
      "Its \"negligible\" difference in kicks out of the goal is 31 against 32 kicks, but 47.7 % against 24.2 % of "
      "them.",
      "Its number of kicks that is \"much higher\" (132 against 65) is no rate: matches and minutes played are not "
      "given.",
      "\"Proving\" is too strong, and nothing is said of the matches' results: before and after are two tournaments "
      "with other opponents and floors, and the calibration of the height changed at the same time as the policy.",
      "\"In goal\" means between the posts and below the bar, saves included; it is not goals scored."};
  notes.insert(notes.end(), paper.begin(), paper.end());
  return notes;
}

Json counts_json(const Comparison& c) {
  Json json = {{"old", group_json(c.older)},
               {"new", group_json(c.newer)},
               {"difference", c.difference},
               {"newcombe95", json_of(c.newcombe95)},
               {"relative_gain", json_of(c.relative_gain)}};
  add_ratio(json, "risk_ratio", c.risk_ratio);
  add_ratio(json, "odds_ratio", c.odds_ratio);
  json["fisher_one_sided_p"] = c.fisher_one_sided_p;
  json["fisher_two_sided_p"] = c.fisher_two_sided_p;
  json["boschloo_one_sided_p"] = json_of(c.boschloo_one_sided_p);
  json["boschloo_two_sided_p"] = json_of(c.boschloo_two_sided_p);
  json["two_sided_definition"] = {{"fisher", "sum of the probabilities not above that of the table seen"},
                                  {"boschloo", "twice the smaller one-sided p, at most 1"}};
  json["p_new_better"] = c.p_new_better;
  json["prior"] = "uniform, Beta(1, 1), for both";
  json["posterior_median"] = c.posterior.median;
  json["posterior_ci95"] = json_of(c.posterior.central);
  json["smallest_effect"] = c.smallest_effect;
  json["p_gain_above_smallest"] = c.p_gain_above_smallest;
  json["expected_loss_of_new"] = c.expected_loss_of_newer;
  json["agresti_caffo95"] = c.agresti_caffo95 ? json_of(*c.agresti_caffo95) : Json();
  json["fragility"] = c.fragility ? Json{{"old", c.fragility->older}, {"new", c.fragility->newer}} : Json();
  json["e_value"] = json_of(c.e_value);
  json["e_value_ci"] = json_of(c.e_value_ci);
  json["verdict"] = label(c.verdict);
  json["notes"] = notes(c);
  return json;
}

std::string to_json(const Comparison& c) {
  Json json = counts_json(c);
  json["needed_kicks_for_smallest"] = c.needed_for_smallest;
  json["needed_kicks_for_seen"] = json_of(c.needed_for_seen);
  if (!c.gates.empty()) json["gates"] = gates_json(c.gates);
  return json_text(json);
}

}  // namespace trivela::evaluator
