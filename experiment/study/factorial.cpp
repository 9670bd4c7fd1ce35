#include "experiment/study/studies.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "evaluator/render/table.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/stats/counts/interval.hpp"

namespace trivela::experiment {
namespace {

using kicking::PolicyName;

// What the paper observed: Table 2 (34 of 65 and 100 of 132 kicks on target).
constexpr evaluator::stats::Counts kPaperOlder{34, 65}, kPaperNewer{100, 132};
constexpr double kPaperKickRatio = 132.0 / 65.0;
constexpr std::size_t kCells = 14;

/// A main effect or an interaction: a sum of the cells with these signs, divided by `of`.
struct CellEffect {
  const char* key;
  double of;
  std::string_view signs;  ///< + - 0; old table: stopped with each law, moving with each, predictive; new one the same
  const char* what;        ///< is subtracted from what, averaged over what
};
constexpr CellEffect kEffects[]{
    {"calibration", 6.0, "------0++++++0", "new - old table, over stopped, moving and laws"},
    {"motion", 6.0, "---+++0---+++0", "moving - stopped, over tables and laws"},
    {"released_law", 4.0, "-+0-+00-+0-+00", "released - paper law, over tables, stopped and moving"},
    {"exact_law", 4.0, "-0+-0+0-0+-0+0", "exact - paper law, over tables, stopped and moving"},
    {"calibration_x_motion", 3.0, "+++---0---+++0", "motion with the new table - motion with the old one, over laws"},
    {"exact_law_x_motion", 2.0, "+0--0+0+0--0+0", "motion with the exact law - motion with the paper's, over tables"},
    {"prediction", 2.0, "00000-+00000-+", "predictive - moving with the exact law, over tables"},
    {"calibration_x_prediction", 1.0, "00000+-00000-+", "prediction with the new table - prediction with the old one"},
    {"gain", 3.0, "---0000000+++0", "new table and moving - old one and stopped, over laws: calibration + motion"}};

/// Both sides of the paper's comparison under one assumption.
struct Pair {
  const StudyRow& older;
  const StudyRow& newer;
  Effect kick_ratio;
};

/// Where in the sweep the number of a kick ratio first meets the paper's [m]; none: nowhere.
std::optional<double> meets(const std::vector<Pair>& pairs, double (*number)(const Effect&)) {
  const auto is_swept = [](const Pair& pair) { return pair.older.label("kind") == "sweep"; };
  const auto median_m = [](const Pair& pair) { return std::stod(pair.older.label("opponent_median_m")); };
  for (std::size_t i = 1; i < pairs.size() && is_swept(pairs[i]); ++i) {
    const double before = number(pairs[i - 1].kick_ratio) - kPaperKickRatio;
    const double after = number(pairs[i].kick_ratio) - kPaperKickRatio;
    if (!(before * after <= 0.0) || before == after) continue;
    return std::lerp(median_m(pairs[i - 1]), median_m(pairs[i]), before / (before - after));
  }
  return std::nullopt;
}

void add_effects(StudyReport& answer, const std::vector<StudyRow>& rows, Measure efficiency) {
  evaluator::Table table{{{"effect", "effect [points]"},
                          {"of", "", ""},
                          {"efficiency", "efficiency", "{:+.1f}", 100.0},
                          {"on_target_per_opportunity", "on target/opp.", "{:+.1f}", 100.0}}};
  std::string legend;
  for (const CellEffect& effect : kEffects) {
    std::vector<Term> terms;
    for (std::size_t i = 0; i < kCells; ++i)
      if (effect.signs[i] != '0')
        terms.push_back({&rows[i].matches, (effect.signs[i] == '+' ? 1.0 : -1.0) / effect.of});
    table.rows.push_back({effect.key, effect.what, json_of(contrast(terms, efficiency)),
                          json_of(contrast(terms, Measure::kPerOpportunity))});
    legend += fmt::format("  {}: {}\n", effect.key, effect.what);
  }
  answer.json["effects"] = rows_json(table);
  answer.text += '\n' + evaluator::text_table(texts_of(table)) + legend +
                 "It says nothing about why the paper's tournaments differed.\n";
}

/// A line a point and way to count blocked kicks.
void add_pairs(StudyReport& answer, const std::vector<Pair>& pairs) {
  evaluator::Table table{{{"opponent_median_m", "opponents [m]", "{:g}"},
                          {"eye_bias_m", "eye's common error [m]", "{:g}"},
                          {"blocked", "blocked"},
                          {"kick_ratio", "kick ratio", "{:.2f}"},
                          {"old_stopped", "old stopped [%]", "{:.1f}", 100.0},
                          {"new_moving", "new moving [%]", "{:.1f}", 100.0},
                          {"both_within_papers", "", ""},
                          {"", "both within the paper's"}}};
  const auto is_within = [](const Effect& share, evaluator::stats::Counts paper) {
    const auto ci = evaluator::stats::wilson(paper);
    return share.value >= ci.lo && share.value <= ci.hi;
  };
  for (const auto& [older, newer, ratio] : pairs) {
    for (const auto& [blocked, measure] :
         {std::pair{"outside", Measure::kEfficiency}, std::pair{"apart", Measure::kUnblocked}}) {
      const Effect before = share_of(older.matches, measure), after = share_of(newer.matches, measure);
      const bool within = is_within(before, kPaperOlder) && is_within(after, kPaperNewer);
      const std::string& bias = older.label("eye_bias_m");
      table.rows.push_back({std::stod(older.label("opponent_median_m")), bias.empty() ? Json() : Json(std::stod(bias)),
                            blocked, json_of(ratio), json_of(before), json_of(after), within, within ? "yes" : "no"});
    }
  }
  answer.json["pair"] = rows_json(table);
  answer.text += fmt::format("\nThe paper: kick ratio {:.2f}, 52.3 and 75.8 %.\n{}", kPaperKickRatio,
                             evaluator::text_table(texts_of(table)));
}

void add_ratio(StudyReport& answer, const std::vector<Pair>& pairs) {
  const auto at_m = meets(pairs, [](const Effect& ratio) { return ratio.value; });
  auto from_m = meets(pairs, [](const Effect& ratio) { return ratio.ci.lo; });
  auto to_m = meets(pairs, [](const Effect& ratio) { return ratio.ci.hi; });
  if (from_m && to_m && *from_m > *to_m) std::swap(from_m, to_m);
  const auto text = [](const std::optional<double>& value_m) {
    return value_m ? fmt::format("{:.2f} m", *value_m) : std::string{"beyond the sweep"};
  };
  answer.text +=
      fmt::format("The paper's kick ratio is met at: {} (95 %: {} to {})\n", text(at_m), text(from_m), text(to_m));
  answer.json["sweep"] = {{"ratio_at_m", evaluator::json_of(at_m)},
                          {"ratio_from_m", evaluator::json_of(from_m)},
                          {"ratio_to_m", evaluator::json_of(to_m)}};
}

StudyReport answer_of(const Study&, const std::vector<StudyRow>& rows, const StudyPlayed& played) {
  const std::vector<StudyRow> cells(rows.begin(), rows.begin() + kCells);
  StudyReport answer{.svg = chart_of(cells, "table", {played.efficiency, Measure::kPerOpportunity}, {})};
  add_effects(answer, rows, played.efficiency);
  std::vector<Pair> pairs;
  for (std::size_t i = kCells; i + 1 < rows.size(); i += 2)
    pairs.push_back({rows[i], rows[i + 1], kick_ratio(rows[i].matches, rows[i + 1].matches)});
  if (pairs.empty()) return answer;
  add_pairs(answer, pairs);
  if (pairs.front().older.label("kind") == "sweep") add_ratio(answer, pairs);
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

Study factorial_study(const sim::Scenario& scenario, const Arm& like, const std::string& law,
                      const std::set<double>& opponent_medians_m, const std::set<double>& eye_biases_m) {
  Study study{.name = "factorial",
              .whom = "cell",
              .worlds = {{.what = "the factorial", .scenario = scenario}},
              .answer = answer_of};
  for (const char* table : {kOldTable, kNewTable}) {
    StudyWorld& world = study.worlds.front();
    for (const PolicyName policy : {PolicyName::kStopped, PolicyName::kMoving})
      for (const char* each : kFactorialLaws) add_cell(world, "cell", like, table, policy, each, "");
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
