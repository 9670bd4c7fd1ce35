#include "experiment/study/factorial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "evaluator/render/text_table.hpp"
#include "evaluator/stats/counts/interval.hpp"

namespace trivela::experiment {
namespace {

using kicking::PolicyName;

constexpr std::array kLaws{"paper", "released", "exact"};

using Weight = double (*)(const StudyRow&);

double table_sign(const StudyRow& row) { return row.label("table") == "new" ? 1.0 : -1.0; }

/// +1 moving, -1 stopped, 0 predictive.
double motion_sign(const StudyRow& row) {
  const std::string& policy = row.label("policy");
  return policy == "moving" ? 1.0 : policy == "stopped" ? -1.0 : 0.0;
}

/// +1 the law, -1 the paper's, 0 other laws and predictive.
double law_sign(const StudyRow& row, const char* law) {
  return row.label("law") == law ? 1.0 : row.label("law") == "paper" ? -1.0 : 0.0;
}

/// +1 predictive, -1 moving with the exact law, 0 the others.
double prediction_sign(const StudyRow& row) {
  if (row.label("policy") == "predictive") return 1.0;
  return row.label("policy") == "moving" && row.label("law") == "exact" ? -1.0 : 0.0;
}

Effect weighted(const std::vector<StudyRow>& rows, const Weight& weight, Measure measure) {
  std::vector<Term> terms;
  for (const StudyRow& row : rows) {
    if (row.label("kind") != "cell") continue;
    if (const double w = weight(row); w != 0.0) terms.push_back({&row.matches, w});
  }
  return contrast(terms, measure);
}

struct EffectOfWeights {
  const char* key;
  const char* what;
  Weight weight;
};
constexpr std::array kEffects{
    EffectOfWeights{"calibration", "new - old table, over stopped, moving and laws",
                    [](const StudyRow& row) { return table_sign(row) * std::abs(motion_sign(row)) / 6.0; }},
    EffectOfWeights{"motion", "moving - stopped, over tables and laws",
                    [](const StudyRow& row) { return motion_sign(row) / 6.0; }},
    EffectOfWeights{"released_law", "released - paper law, over tables, stopped and moving",
                    [](const StudyRow& row) { return law_sign(row, "released") / 4.0; }},
    EffectOfWeights{"exact_law", "exact - paper law, over tables, stopped and moving",
                    [](const StudyRow& row) { return law_sign(row, "exact") / 4.0; }},
    EffectOfWeights{"calibration_x_motion", "motion with the new table - motion with the old one, over laws",
                    [](const StudyRow& row) { return table_sign(row) * motion_sign(row) / 3.0; }},
    EffectOfWeights{"exact_law_x_motion", "motion with the exact law - motion with the paper's, over tables",
                    [](const StudyRow& row) { return law_sign(row, "exact") * motion_sign(row) / 2.0; }},
    EffectOfWeights{"prediction", "predictive - moving with the exact law, over tables",
                    [](const StudyRow& row) { return prediction_sign(row) / 2.0; }},
    EffectOfWeights{"calibration_x_prediction", "prediction with the new table - prediction with the old one",
                    [](const StudyRow& row) { return table_sign(row) * prediction_sign(row); }},
    EffectOfWeights{
        "gain", "new table and moving - old one and stopped, over laws: calibration + motion",
        [](const StudyRow& row) { return table_sign(row) == motion_sign(row) ? table_sign(row) / 3.0 : 0.0; }}};

/// Both sides of the paper's comparison under one assumption.
struct SweepPoint {
  const StudyRow* older;
  const StudyRow* newer;
  double value_m;  ///< of the label that is swept

  Effect kick_ratio() const { return experiment::kick_ratio(older->matches, newer->matches); }
};

/// Of pairs of rows of a kind, by a label.
std::vector<SweepPoint> sweep_of(const std::vector<StudyRow>& rows, const std::string& kind, const std::string& label) {
  std::vector<SweepPoint> sweep;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    if (rows[i].label("kind") == kind && rows[i].label("table") == kOldTable && kind != "cell")
      sweep.push_back({&rows[i], &rows[i + 1], std::stod(rows[i].label(label))});
  return sweep;
}

/// Where the number of an effect first meets the paper's kick ratio; none: nowhere.
std::optional<double> meets(const std::vector<SweepPoint>& sweep, double (*number)(const Effect&)) {
  for (std::size_t i = 1; i < sweep.size(); ++i) {
    const double before = number(sweep[i - 1].kick_ratio()) - kPaperKickRatio;
    const double after = number(sweep[i].kick_ratio()) - kPaperKickRatio;
    if (!(before * after <= 0.0) || before == after) continue;
    return std::lerp(sweep[i - 1].value_m, sweep[i].value_m, before / (before - after));
  }
  return std::nullopt;
}

bool within_paper(const Effect& share, evaluator::stats::Counts paper) {
  const auto ci = evaluator::stats::wilson(paper);
  return share.value >= ci.lo && share.value <= ci.hi;
}

void add_effects(StudyAnswer& answer, const std::vector<NamedEffect>& effects) {
  std::vector<std::vector<std::string>> table{{"effect [points]", "efficiency", "on target/opp."}};
  std::string legend;
  for (const NamedEffect& effect : effects) {
    table.push_back({effect.key, points_text(effect.efficiency), points_text(effect.per_opportunity)});
    legend += fmt::format("  {}: {}\n", effect.key, effect.what);
    answer.more["effects"].push_back({{"effect", effect.key},
                                      {"of", effect.what},
                                      {"efficiency", json_of(effect.efficiency)},
                                      {"on_target_per_opportunity", json_of(effect.per_opportunity)}});
  }
  answer.text +=
      '\n' + evaluator::text_table(table) + legend + "It says nothing about why the paper's tournaments differed.\n";
}

/// A line a point and way to count blocked kicks.
void add_pairs(StudyAnswer& answer, const std::vector<SweepPoint>& points) {
  std::vector<std::vector<std::string>> table{{"opponents [m]", "eye's common error [m]", "blocked", "kick ratio",
                                               "old stopped [%]", "new moving [%]", "both within the paper's"}};
  for (const auto& [older, newer, value_m] : points) {
    for (const auto& [blocked, measure] :
         {std::pair{"outside", Measure::kEfficiency}, std::pair{"apart", Measure::kUnblocked}}) {
      const Effect before = share_of(older->matches, measure), after = share_of(newer->matches, measure);
      const Effect ratio = kick_ratio(older->matches, newer->matches);
      const bool within = within_paper(before, kPaperOlder) && within_paper(after, kPaperNewer);
      const std::string &median = older->label("opponent_median_m"), &bias = older->label("eye_bias_m");
      table.push_back({median, bias.empty() ? "-" : bias, blocked,
                       effect_text(ratio, [](double value) { return fmt::format("{:.2f}", value); }),
                       share_text(before), share_text(after), within ? "yes" : "no"});
      answer.more["pair"].push_back({{"opponent_median_m", std::stod(median)},
                                     {"eye_bias_m", bias.empty() ? Json() : Json(std::stod(bias))},
                                     {"blocked", blocked},
                                     {"kick_ratio", json_of(ratio)},
                                     {"old_stopped", json_of(before)},
                                     {"new_moving", json_of(after)},
                                     {"both_within_papers", within}});
    }
  }
  answer.text += fmt::format("\nThe paper: kick ratio {:.2f}, 52.3 and 75.8 %.\n{}", kPaperKickRatio,
                             evaluator::text_table(table));
}

void add_ratio(StudyAnswer& answer, const RatioMet& met) {
  const auto text = [](const std::optional<double>& value_m) {
    return value_m ? fmt::format("{:.2f} m", *value_m) : std::string{"beyond the sweep"};
  };
  answer.text += fmt::format("The paper's kick ratio is met at: {} (95 %: {} to {})\n", text(met.at_m),
                             text(met.from_m), text(met.to_m));
  answer.more["sweep"] = {{"ratio_at_m", evaluator::json_of(met.at_m)},
                          {"ratio_from_m", evaluator::json_of(met.from_m)},
                          {"ratio_to_m", evaluator::json_of(met.to_m)}};
}

StudyAnswer answer_of(const Study&, const std::vector<StudyRow>& rows, const StudyPlayed& played) {
  std::vector<StudyRow> cells;
  std::ranges::copy_if(rows, std::back_inserter(cells), [](const auto& row) { return row.label("kind") == "cell"; });
  StudyAnswer answer{.svg = chart_of(cells, "table", {played.efficiency, Measure::kPerOpportunity}, {})};
  add_effects(answer, effects_of(rows, played.efficiency));
  std::vector<SweepPoint> points = sweep_of(rows, "sweep", "opponent_median_m");
  const bool swept = !points.empty();
  for (const SweepPoint& point : sweep_of(rows, "bias", "eye_bias_m")) points.push_back(point);
  if (!points.empty()) add_pairs(answer, points);
  if (swept) add_ratio(answer, ratio_met(rows));
  return answer;
}

void add_cell(StudyWorld& world, const char* kind, const Arm& like, const std::string& table, PolicyName policy,
              const std::string& law, const std::string& eye_bias_m) {
  const bool predicts = policy == PolicyName::kPredictive;
  Arm& arm = world.arms.emplace_back(like);
  arm.name = fmt::format("{} {}{}", table, kicking::name(policy), predicts ? "" : " " + law);
  arm.policy = policy;
  arm.table = table;
  kicking::PolicyConfig& settings = arm.settings.policy;
  settings.motion_law = law == "exact" ? kicking::MotionLaw::kExact : kicking::MotionLaw::kPaper;
  settings.height_law = law == "paper"      ? kicking::HeightLaw::kPaper
                        : law == "released" ? kicking::HeightLaw::kExtendedRange
                                            : kicking::HeightLaw::kExact;
  settings.alpha_law = kicking::AlphaLaw::kPaperLine;
  world.labels.push_back({{"kind", kind},
                          {"table", table},
                          {"policy", kicking::name(policy)},
                          {"law", predicts ? "" : law},
                          {"opponent_median_m", fmt::format("{:g}", world.scenario.opponent.distance_median_m)},
                          {"eye_bias_m", eye_bias_m}});
}

}  // namespace

std::vector<std::string> factorial_laws() { return {kLaws.begin(), kLaws.end()}; }

std::vector<NamedEffect> effects_of(const std::vector<StudyRow>& rows, Measure efficiency) {
  std::vector<NamedEffect> effects;
  effects.reserve(kEffects.size());
  for (const auto& [key, what, weight] : kEffects)
    effects.push_back(
        {key, what, weighted(rows, weight, efficiency), weighted(rows, weight, Measure::kPerOpportunity)});
  return effects;
}

RatioMet ratio_met(const std::vector<StudyRow>& rows) {
  const auto sweep = sweep_of(rows, "sweep", "opponent_median_m");
  RatioMet met{meets(sweep, [](const Effect& ratio) { return ratio.value; }),
               meets(sweep, [](const Effect& ratio) { return ratio.ci.lo; }),
               meets(sweep, [](const Effect& ratio) { return ratio.ci.hi; })};
  if (met.from_m && met.to_m && *met.from_m > *met.to_m) std::swap(met.from_m, met.to_m);
  return met;
}

Study factorial_study(const sim::Scenario& scenario, const Arm& like, const std::string& law,
                      const std::vector<double>& opponent_medians_m, const std::vector<double>& eye_biases_m) {
  Study study{.name = "factorial",
              .whom = "cell",
              .worlds = {{.what = "the factorial", .scenario = scenario}},
              .answer = answer_of};
  for (const char* table : {kOldTable, kNewTable}) {
    StudyWorld& world = study.worlds.front();
    for (const PolicyName policy : {PolicyName::kStopped, PolicyName::kMoving})
      for (const char* each : kLaws) add_cell(world, "cell", like, table, policy, each, "");
    add_cell(world, "cell", like, table, PolicyName::kPredictive, "exact", "");
  }
  const auto add = [&](const char* kind, const std::string& what, const sim::Scenario& played,
                       const std::string& eye_bias_m) {
    StudyWorld& world = study.worlds.emplace_back(StudyWorld{what, played});
    add_cell(world, kind, like, kOldTable, PolicyName::kStopped, law, eye_bias_m);
    add_cell(world, kind, like, kNewTable, PolicyName::kMoving, law, eye_bias_m);
  };
  for (const double median_m : opponent_medians_m) {
    sim::Scenario world = scenario;
    world.opponent.distance_median_m = median_m;
    add("sweep", fmt::format("opponents at {:g} m", median_m), world, "");
  }
  for (const double bias_m : eye_biases_m) {
    sim::Scenario world = scenario;
    world.hand_table.target_height_m += bias_m;  // what seems right lies so much too high
    add("bias", fmt::format("an eye off by {:g} m", bias_m), world, fmt::format("{:g}", bias_m));
  }
  return study;
}

}  // namespace trivela::experiment
