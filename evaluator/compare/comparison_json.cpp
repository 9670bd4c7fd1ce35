#include "evaluator/compare/comparison.hpp"
#include "evaluator/compare/comparison_lines.hpp"
#include "evaluator/render/json_values.hpp"

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
