#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <set>

#include "config/text/error.hpp"
#include "experiment/study/frontier.hpp"
#include "experiment/study/robustness.hpp"
#include "experiment/study/sensitivity.hpp"
#include "experiment/study/tune/tune_space.hpp"
#include "sim/scenario_fields.hpp"

namespace trivela::experiment {
namespace {

/// `matches` matches of `opportunities`, with these kicks and shots on target in each.
ArmTally alike(std::size_t matches, std::int64_t opportunities, std::int64_t kicks, std::int64_t on_target) {
  return ArmTally(matches, MatchTally{opportunities, kicks, on_target});
}

/// Matches that differ by chance.
ArmTally random_arm(std::mt19937& random, std::size_t matches, double kick, double on_target) {
  ArmTally arm;
  for (std::size_t m = 0; m < matches; ++m) {
    const std::int64_t kicks = std::binomial_distribution<std::int64_t>{40, kick}(random);
    arm.push_back({40, kicks, std::binomial_distribution<std::int64_t>{kicks, on_target}(random)});
  }
  return arm;
}

/// As it is shipped.
const std::vector<UncertainInput>& uncertain_inputs() {
  static const auto inputs = load_inputs(std::string{TRIVELA_SOURCE_DIR} + "/config/studies/sensitivity.csv");
  return inputs;
}

double default_of(const std::string& key) {
  return is_setting(key) ? value_of(kicking::PolicyConfig{}, key) : value_of(sim::Scenario{}, key);
}

TEST(UncertainInputs, AreNumbersWithPlayableEndsOnBothSidesOrAtTheValue) {
  std::set<std::string> keys;
  for (const UncertainInput& input : uncertain_inputs()) {
    SCOPED_TRACE(input.key);
    EXPECT_TRUE(keys.insert(input.key).second);
    const double value = default_of(input.key);
    EXPECT_LT(input.low, input.high);
    EXPECT_LE(input.low, value);
    EXPECT_GE(input.high, value);
    EXPECT_GT(input.why.size(), 4U);
    for (const double end : {input.low, input.high}) {
      const double read = is_setting(input.key) ? value_of(with(kicking::PolicyConfig{}, input.key, end), input.key)
                                                : value_of(with(sim::Scenario{}, input.key, end), input.key);
      EXPECT_NEAR(read, end, 1e-12);
    }
  }
  EXPECT_GT(keys.size(), 30U);
}

TEST(UncertainInputs, HoldEverySettingThatIsTunedAndTheHandTables) {
  std::set<std::string> keys;
  for (const UncertainInput& input : uncertain_inputs()) keys.insert(input.key);
  for (const auto policy :
       {kicking::PolicyName::kStopped, kicking::PolicyName::kMoving, kicking::PolicyName::kPredictive}) {
    for (const Coordinate& coordinate : tuned_space(policy))
      EXPECT_TRUE(keys.contains(coordinate.name)) << coordinate.name;
  }
  for (const char* key : {"policy.target_height_m", "hand_table.eye_height_sd_m", "hand_table.day_sd_ratio",
                          "hand_table.kicks_per_distance", "hand_table.target_height_m"}) {
    EXPECT_TRUE(keys.contains(key)) << key;
  }
}

TEST(UncertainInputs, NameTheLawsOfThePolicies) {
  const kicking::PolicyConfig changed = with(kicking::PolicyConfig{}, "policy.height_law", 1.0);
  EXPECT_EQ(changed.height_law, kicking::HeightLaw::kExtendedRange);
  EXPECT_EQ(value_text("policy.height_law", 1.0), "extended_range");
  EXPECT_EQ(value_text("policy.alignment.extension", 1.0), "add");
  EXPECT_EQ(value_text("policy.settle_s", 0.25), "0.25");
  EXPECT_NEAR(with(kicking::PolicyConfig{}, "policy.aim_tolerance_deg", 3.0).aim_tolerance_rad, 3.0 * M_PI / 180.0,
              1e-15);
  EXPECT_THROW(with(kicking::PolicyConfig{}, "policy.height_law", 3.0), std::invalid_argument);
  EXPECT_THROW(with(kicking::PolicyConfig{}, "policy.height_law", 0.5), std::invalid_argument);
  EXPECT_THROW(with(kicking::PolicyConfig{}, "policy.settle_s", -1.0), std::invalid_argument);
  EXPECT_THROW(value_of(kicking::PolicyConfig{}, "policy.settle"), std::invalid_argument);
}

TEST(UncertainInputs, ChangeOneNumberAndNothingElse) {
  const sim::Scenario changed = with(sim::Scenario{}, "kicker.direction_sd_deg", 3.0);
  EXPECT_NEAR(changed.kicker.direction_sd_rad, 3.0 * M_PI / 180.0, 1e-15);
  for (const UncertainInput& input : uncertain_inputs()) {
    if (input.key != "kicker.direction_sd_deg" && !is_setting(input.key)) {
      EXPECT_EQ(value_of(changed, input.key), default_of(input.key)) << input.key;
    }
  }
}

TEST(UncertainInputs, OfAKeeperOrDefendersPlayWhereThereAreSome) {
  const auto in_force_now = [](const sim::Scenario& scenario, const std::string& part) {
    return std::ranges::count_if(uncertain_inputs(), [&](const UncertainInput& input) {
      return input.key.starts_with(part) && in_force(scenario, input);
    });
  };
  sim::Scenario scenario;
  EXPECT_EQ(in_force_now(scenario, "keeper."), 0);
  EXPECT_EQ(in_force_now(scenario, "policy.keeper."), 0);
  EXPECT_EQ(in_force_now(scenario, "defenders."), 0);
  EXPECT_GT(in_force_now(scenario, "kicker."), 5);
  scenario.keeper.enabled = true;
  scenario.defenders.count = 1.0;
  EXPECT_GT(in_force_now(scenario, "keeper."), 5);
  EXPECT_GT(in_force_now(scenario, "policy.keeper."), 5);
  EXPECT_GT(in_force_now(scenario, "defenders."), 5);
}

TEST(Sensitivity, ComparesGoalsWhereAsked) {
  SensitivityReport report;
  report.arms = {"stopped", "moving"};
  report.measure = Measure::kGoals;
  ArmTally few(4, {10, 10, 8}), many(4, {10, 10, 8});
  for (std::size_t i = 0; i < 4; ++i) {
    few[i].goals = 1 + static_cast<std::int64_t>(i % 2);
    many[i].goals = 5;
  }
  report.base = {few, many};
  EXPECT_NEAR(headline(report.base, 0).value, 0.0, 1e-12);
  EXPECT_NEAR(headline(report.base, 0, report.measure).value, 0.35, 1e-12);
  EXPECT_NE(to_text(report).find("Goals past the keeper"), std::string::npos);
}

TEST(UncertainInputs, OfATableThatIsWrongAreRefusedWithTheLine) {
  const std::string path = ::testing::TempDir() + "inputs.csv";
  for (const auto& [row, said] : {std::pair{"kicker.delay,0.05,0.08,x", "inputs.csv:2: \"kicker.delay\""},
                                  {"kicker.delay_s,0.08,0.05,x", "inputs.csv:2: low is not below high"},
                                  {"kicker.delay_s,soon,0.05,x", "inputs.csv:2: column low"},
                                  {"policy.height_law,0,7,x", "inputs.csv:2: policy.height_law = 7"},
                                  {"", "inputs.csv: names no input"}}) {
    std::ofstream{path} << "key,low,high,why\n" << row << '\n';
    try {
      load_inputs(path);
      ADD_FAILURE() << row;
    } catch (const config::Error& error) {
      EXPECT_NE(std::string{error.what()}.find(said), std::string::npos) << error.what();
    }
  }
}

TEST(UncertainInputs, RefuseKeysAndValuesThatAreNone) {
  EXPECT_THROW(value_of(sim::Scenario{}, "kicker.delay"), std::invalid_argument);
  EXPECT_THROW(value_of(sim::Scenario{}, "delay_s"), std::invalid_argument);
  EXPECT_THROW(value_of(sim::Scenario{}, "kicker.powers"), std::invalid_argument);
  EXPECT_THROW(with(sim::Scenario{}, "opponent.count", 2.5), std::invalid_argument);
}

SensitivityReport hand_case() {
  SensitivityReport report{.played = {.scenario = "hand.toml", .matches = 10, .possessions = 100},
                           .arms = {"stopped", "moving"},
                           .base = {alike(10, 100, 50, 20), alike(10, 100, 80, 50)}};
  const UncertainInput small{"kicker.delay_s", 0.05, 0.08, "said"}, large{"vision.latency_s", 0.03, 0.1, "said"};
  report.inputs.push_back({small, 0.06, {{0.05, {alike(10, 100, 50, 21), alike(10, 100, 80, 50)}}}});
  report.inputs.push_back({large, 0.06, {{0.1, {alike(10, 100, 50, 20), alike(10, 100, 80, 35)}}}});
  return report;
}

TEST(Sensitivity, AChangeIsTheDifferenceOfDifferences) {
  SensitivityReport report = hand_case();
  EXPECT_NEAR(headline(report.base, 0).value, 0.30, 1e-12);
  EXPECT_NEAR(change(report, report.inputs[0].ends[0], 0).value, -0.01, 1e-12);
  EXPECT_NEAR(change(report, report.inputs[1].ends[0], 0).value, -0.15, 1e-12);
  sort_by_change(report);
  EXPECT_EQ(report.inputs[0].input.key, "vision.latency_s");
  EXPECT_NEAR(largest_change(report, report.inputs[0]), 0.15, 1e-12);
}

TEST(Sensitivity, PairingTakesOutWhatAMatchDoesToAll) {
  // Hard and easy matches, the same for all arms: the change is certain although each arm is not.
  SensitivityReport report = hand_case();
  for (std::size_t m = 0; m < 10; ++m) {
    const auto shift = static_cast<std::int64_t>(m) - 4;
    for (ArmTally* arm :
         {&report.base[0], &report.base[1], &report.inputs[0].ends[0].arms[0], &report.inputs[0].ends[0].arms[1]})
      (*arm)[m].on_target += shift;
  }
  const Effect moved = change(report, report.inputs[0].ends[0], 0);
  EXPECT_NEAR(moved.ci.hi - moved.ci.lo, 0.0, 1e-12);
}

TEST(Sensitivity, TablesAndChartNameEveryInput) {
  SensitivityReport report = hand_case();
  sort_by_change(report);
  const std::string text = to_text(report), csv = csv_of(rows_of(report), report.played), svg = to_svg(report);
  EXPECT_LT(text.find("vision.latency_s"), text.find("kicker.delay_s"));
  EXPECT_NE(text.find("-15.0 (-15.0 to -15.0)"), std::string::npos) << text;
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 2 + 4);
  EXPECT_NE(
      csv.find("vision.latency_s,0.1,moving,1000,800,350,0,0,0,0.437500,0.437500,0.437500,0.350000,0.350000,0.350000,"
               "-0.150000,-0.150000,-0.150000,1\n"),
      std::string::npos);
  for (const char* key : {"vision.latency_s", "kicker.delay_s"}) EXPECT_NE(svg.find(key), std::string::npos);
  EXPECT_EQ(to_json(report)["inputs"].size(), 2U);
}

TEST(Sensitivity, WithoutShotsOnTargetItHasNoIntervals) {
  const ArmTally none = alike(2, 1, 0, 0);
  SensitivityReport report{.arms = {"stopped", "moving"}, .base = {none, none}};
  report.inputs.push_back({{"kicker.delay_s", 0.05, 0.08, "said"}, 0.06, {{0.05, {none, none}}}});
  const std::string outputs =
      to_text(report) + csv_of(rows_of(report), report.played) + to_svg(report) + to_json(report).dump();
  EXPECT_EQ(outputs.find("nan"), std::string::npos) << outputs;
  EXPECT_NE(to_text(report).find("moving - stopped: +0.0 (-)"), std::string::npos) << to_text(report);
  EXPECT_NE(csv_of(rows_of(report), report.played).find("kicker.delay_s,0.05,moving,2,0,0,"), std::string::npos);
}

FrontierReport frontier_case() {
  return {"predictive",
          {.scenario = "hand.toml", .matches = 20, .possessions = 100},
          {{0.2, alike(20, 100, 80, 56)}, {0.5, alike(20, 100, 60, 48)}, {0.8, alike(20, 100, 0, 0)}},
          {{"moving", alike(20, 100, 70, 42)}, {"stopped", alike(20, 100, 20, 15)}},
          FixedPoint{"oracle", alike(20, 100, 80, 70)}};
}

TEST(Frontier, IsMixedBetweenThresholdsAtThePolicysOwnKicks) {
  const FrontierReport report = frontier_case();
  const auto moving = standing_of(report, report.fixed[0]);
  ASSERT_TRUE(moving && moving->within);
  EXPECT_EQ(moving->from_threshold, 0.2);
  EXPECT_EQ(moving->to_threshold, 0.5);
  EXPECT_NEAR(moving->above.value, 52.0 / 70.0 - 42.0 / 70.0, 1e-12);  // half of each: 70 kicks, 52 on target
  EXPECT_NEAR(share_of_oracle(report).value, 0.8, 1e-12);
  EXPECT_EQ(best_of(report).threshold, 0.2);
}

TEST(Frontier, BeyondItsEndsIsComparedWithTheEnd) {
  FrontierReport report = frontier_case();
  const auto stopped = standing_of(report, report.fixed[1]);
  ASSERT_TRUE(stopped);
  EXPECT_FALSE(stopped->within);
  EXPECT_EQ(stopped->to_threshold, 0.5);  // at 0.8 it never kicks
  EXPECT_NEAR(stopped->above.value, 0.8 - 0.75, 1e-12);
  report.fixed[1].matches = alike(20, 100, 90, 45);
  EXPECT_EQ(standing_of(report, report.fixed[1])->to_threshold, 0.2);
  report.fixed[1].matches = alike(20, 100, 0, 0);
  EXPECT_FALSE(standing_of(report, report.fixed[1]));
}

TEST(Frontier, WithoutKicksItSaysSoAndPrintsNoNan) {
  const ArmTally none = alike(2, 1, 0, 0), one{{1, 1, 1}, {1, 0, 0}};
  FrontierReport report{"predictive", {}, {{0.2, none}}, {{"moving", none}}, FixedPoint{"oracle", none}};
  const auto outputs = [&] {
    return to_text(report) + csv_of(rows_of(report), report.played) + to_svg(report) + to_json(report).dump();
  };
  const auto expect_no_nan = [&] {
    EXPECT_EQ(outputs().find("nan"), std::string::npos) << outputs();
    EXPECT_EQ(outputs().find("inf"), std::string::npos) << outputs();
  };
  expect_no_nan();
  EXPECT_NE(to_text(report).find("moving never kicked"), std::string::npos) << to_text(report);
  EXPECT_NE(to_text(report).find("too few shots on target"), std::string::npos) << to_text(report);
  EXPECT_NE(to_svg(report).find("nothing to draw"), std::string::npos);
  report.fixed[0].matches = one;
  expect_no_nan();
  EXPECT_NE(to_text(report).find("moving has no frontier beside it: predictive never kicked"), std::string::npos);
  EXPECT_NE(to_text(report).find("100.0 (-)"), std::string::npos) << "one kick has no interval: " << to_text(report);
  report.points[0].matches = one;
  report.oracle->matches = one;
  expect_no_nan();
  EXPECT_NE(to_text(report).find("too few kicks to tell it from the frontier"), std::string::npos) << to_text(report);
}

TEST(Frontier, TheJackknifeOfAShareIsTheIntervalOfItsMatches) {
  // Of a mean over matches of equal size it is the classic one: t s / sqrt(n).
  std::mt19937 random{5};
  const ArmTally arm = random_arm(random, 60, 0.7, 0.6);
  const Effect jack = jackknife({&arm}, [](const auto& totals) { return on_target_per_opportunity(totals[0]); });
  const Term alone[] = {{&arm, 1.0}};
  const Effect linear = contrast(alone, Measure::kPerOpportunity);
  EXPECT_NEAR(jack.value, linear.value, 1e-12);
  EXPECT_NEAR(jack.ci.lo, linear.ci.lo, 1e-9);
  EXPECT_NEAR(jack.ci.hi, linear.ci.hi, 1e-9);
}

TEST(Frontier, ItsIntervalCoversTheTruthAsOftenAsItSays) {
  std::mt19937 random{7};
  const double truth = (0.5 * (0.8 * 0.7 + 0.6 * 0.8)) / 0.7 - 0.6;  // kicks .8, .6 with .7, .8; moving .7 with .6
  int covered = 0;
  constexpr int kTimes = 400;
  for (int i = 0; i < kTimes; ++i) {
    FrontierReport report{.policy = "predictive"};
    report.points = {{0.2, random_arm(random, 50, 0.8, 0.7)}, {0.5, random_arm(random, 50, 0.6, 0.8)}};
    report.fixed = {{"moving", random_arm(random, 50, 0.7, 0.6)}};
    const auto standing = standing_of(report, report.fixed[0]);
    covered += standing->above.ci.lo <= truth && truth <= standing->above.ci.hi;
  }
  EXPECT_NEAR(covered, 0.95 * kTimes, 4 * std::sqrt(0.95 * 0.05 * kTimes));
}

TEST(Frontier, TablesAndChartSayWhereAPolicyStands) {
  const FrontierReport report = frontier_case();
  const std::string text = to_text(report), csv = csv_of(rows_of(report), report.played), svg = to_svg(report);
  EXPECT_NE(
      text.find("moving lies below the frontier: with as many kicks (thresholds 0.2 and 0.5 mixed) predictive has "
                "+14.3 points more"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("80.0 (80.0 to 80.0) % of the oracle's"), std::string::npos) << text;
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 3 + 3);
  EXPECT_NE(csv.find("predictive,0.8,2000,0,0,0,0,0,,,,0.000000"), std::string::npos) << csv;
  for (const char* name : {"predictive", "moving", "stopped", "oracle"}) EXPECT_NE(svg.find(name), std::string::npos);
  EXPECT_TRUE(to_json(report)["rows"][3]["threshold"].is_null());
  EXPECT_EQ(to_json(report)["standings"].size(), 2U);
}

RobustnessReport two_worlds() {
  RobustnessReport report{.played = {.scenario = "default", .seed = 1, .matches = 40, .possessions = 40},
                          .arms = {"moving", "predictive"},
                          .rival = 0};
  std::mt19937 random{5};
  report.worlds.push_back({"as it is", "", {random_arm(random, 40, 0.6, 0.8), random_arm(random, 40, 0.9, 0.9)}});
  report.worlds.push_back({"worse <&>", "why", {random_arm(random, 40, 0.9, 0.9), random_arm(random, 40, 0.6, 0.5)}});
  return report;
}

TEST(Robustness, ComparesEachArmWithTheRivalInEachWorld) {
  const RobustnessReport report = two_worlds();
  const auto rows = rows_of(report);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[1].label("world"), "as it is");
  EXPECT_EQ(rows[1].label("arm"), "predictive");
  EXPECT_FALSE(rows[0].change) << "the rival itself";
  ASSERT_TRUE(rows[1].change);
  const Effect better = against_rival(report, report.worlds[0], 1);
  EXPECT_EQ(rows[1].change->value, better.value);
  EXPECT_NEAR(better.value, 0.81 - 0.48, 0.04);
  EXPECT_GT(better.ci.lo, 0.0);
  EXPECT_LT(against_rival(report, report.worlds[1], 1).ci.hi, 0.0);
}

TEST(Robustness, SaysWhereTheIntervalReachesBelowNothing) {
  const std::string text = to_text(two_worlds());
  EXPECT_NE(text.find("predictive - moving: 1 of 2\n"), std::string::npos) << text;
  EXPECT_EQ(std::ranges::count(text, '!'), 2) << "the cell, and what it means";
}

TEST(Robustness, TheHeatMapHasEveryNumberAndFramesWhatIsWorse) {
  const std::string svg = to_svg(two_worlds());
  EXPECT_NE(svg.find("worse &lt;&amp;&gt;"), std::string::npos);
  std::size_t frames = 0, cells = 0;
  for (std::size_t at = svg.find("stroke-width=\"2.5\""); at != std::string::npos;
       at = svg.find("stroke-width=\"2.5\"", at + 1))
    ++frames;
  for (std::size_t at = svg.find("fill=\"rgb("); at != std::string::npos; at = svg.find("fill=\"rgb(", at + 1)) ++cells;
  EXPECT_EQ(frames, 1u);
  EXPECT_EQ(cells, 6u);
}

}  // namespace
}  // namespace trivela::experiment
