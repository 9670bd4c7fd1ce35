#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <set>

#include "config/text/error.hpp"
#include "experiment/study/studies.hpp"
#include "experiment/study/tune/tune.hpp"
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

std::string default_of(const std::string& key) { return value_of({}, key); }

TEST(UncertainInputs, AreNumbersWithPlayableEndsOnBothSidesOrAtTheValue) {
  std::set<std::string> keys;
  for (const UncertainInput& input : uncertain_inputs()) {
    SCOPED_TRACE(input.key);
    EXPECT_TRUE(keys.insert(input.key).second);
    EXPECT_GT(input.why.size(), 4U);
    for (const std::string& end : {input.low, input.high})
      EXPECT_EQ(value_of(with({}, input.key, end), input.key), end);
    const std::string value = default_of(input.key);
    if (value.find_first_not_of("0123456789.-e") != std::string::npos) continue;  // a law
    EXPECT_LE(std::stod(input.low), std::stod(value));
    EXPECT_GE(std::stod(input.high), std::stod(value));
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
  const Inputs changed = with({}, "policy.height_law", "extended_range");
  EXPECT_EQ(changed.settings.policy.height_law, kicking::HeightLaw::kExtendedRange);
  EXPECT_EQ(value_of(changed, "policy.height_law"), "extended_range");
  EXPECT_NEAR(with({}, "policy.aim_tolerance_deg", "3").settings.policy.aim_tolerance_rad, 3.0 * M_PI / 180.0, 1e-15);
  for (const auto& [key, value] : {std::pair{"policy.height_law", "released"}, {"policy.settle_s", "-1"}})
    EXPECT_THROW(with({}, key, value), config::Error) << key;
  EXPECT_THROW(value_of({}, "policy.settle"), config::Error);
}

TEST(UncertainInputs, ChangeOneNumberAndNothingElse) {
  const Inputs changed = with({}, "kicker.direction_sd_deg", "3");
  EXPECT_NEAR(changed.scenario.kicker.direction_sd_rad, 3.0 * M_PI / 180.0, 1e-15);
  for (const UncertainInput& input : uncertain_inputs()) {
    if (input.key != "kicker.direction_sd_deg") {
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

TEST(UncertainInputs, OfATableThatIsWrongAreRefusedWithTheLine) {
  const std::string path = ::testing::TempDir() + "inputs.csv";
  for (const auto& [row, said] : {std::pair{"kicker.delay,0.05,0.08,x", "inputs.csv:2: \"kicker.delay\""},
                                  {"kicker.delay_s,0.08,0.05,x", "inputs.csv:2: low is not below high"},
                                  {"kicker.delay_s,soon,0.05,x", "inputs.csv:2: column low"},
                                  {"policy.height_law,paper,old,x", "policy.height_law = 'old'"},
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
  for (const char* key : {"kicker.delay", "delay_s", "kicker.powers"})
    EXPECT_THROW(value_of({}, key), config::Error) << key;
  EXPECT_THROW(with({}, "opponent.count", "2.5"), config::Error);
}

/// The rows of a study: its worlds' labels, with these matches.
std::vector<StudyRow> rows_of(const Study& study, const std::vector<ArmTally>& matches) {
  std::vector<StudyRow> rows;
  for (const StudyWorld& world : study.worlds)
    for (const RowLabels& labels : world.labels) rows.push_back({labels, matches.at(rows.size())});
  return rows;
}

std::string outputs_of(const StudyReport& report) { return report.text + report.csv + report.svg + report.json.dump(); }

const std::vector<Arm> kTwo{{.name = "stopped"}, {.name = "moving"}};

Study two_inputs(Measure measure = Measure::kPerOpportunity) {
  sim::Scenario scenario;
  scenario.kicker.delay_s = 0.08;    // of which the high value is not played
  scenario.vision.latency_s = 0.03;  // and the low one
  return sensitivity_study(scenario, kTwo,
                           {{"kicker.delay_s", "0.05", "0.08", "said"}, {"vision.latency_s", "0.03", "0.1", "said"}},
                           measure, [](const std::string& why) { ADD_FAILURE() << why; });
}

/// The scenario, and each of the two inputs at one end.
std::vector<ArmTally> hand_case() {
  return {alike(10, 100, 50, 20), alike(10, 100, 80, 50), alike(10, 100, 50, 21),
          alike(10, 100, 80, 50), alike(10, 100, 50, 20), alike(10, 100, 80, 35)};
}

TEST(Sensitivity, AChangeIsTheDifferenceOfDifferencesAndTheLargestComesFirst) {
  const Study study = two_inputs();
  const auto report = report_of(study, rows_of(study, hand_case()), {.scenario = "hand.toml", .matches = 10});
  EXPECT_NEAR(report.json["headlines"][0]["value"].get<double>(), 0.30, 1e-12);
  const auto& rows = report.json["rows"];
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[3]["input"], "vision.latency_s");
  EXPECT_NEAR(rows[3]["change"]["value"].get<double>(), -0.15, 1e-12);
  EXPECT_EQ(rows[5]["input"], "kicker.delay_s");
  EXPECT_NEAR(rows[5]["change"]["value"].get<double>(), -0.01, 1e-12);
  EXPECT_EQ(report.json["inputs"].size(), 2U);
  EXPECT_EQ(report.json["inputs"][1]["value"], 0.08);
  EXPECT_NE(report.text.find("-15.0 (-15.0 to -15.0)"), std::string::npos) << report.text;
  EXPECT_THAT(report.csv, testing::HasSubstr("\nvision.latency_s,0.1,moving,1000,800,350,0,0,0,0.437500,"));
  EXPECT_THAT(report.csv, testing::HasSubstr(",-0.150000,-0.150000,-0.150000,1\n"));
  for (const char* key : {"vision.latency_s", "kicker.delay_s"})
    EXPECT_NE(report.svg.find(key), std::string::npos) << key;
}

TEST(Sensitivity, PairingTakesOutWhatAMatchDoesToAll) {
  // Hard and easy matches, the same for all arms: the change is certain although each arm is not.
  std::vector<ArmTally> matches = hand_case();
  for (ArmTally& arm : matches)
    for (std::size_t m = 0; m < 10; ++m) arm[m].on_target += static_cast<std::int64_t>(m) - 4;
  const Study study = two_inputs();
  const auto json = report_of(study, rows_of(study, matches), {}).json;
  const auto& ci = json["rows"][5]["change"]["ci"];
  EXPECT_NEAR(ci[1].get<double>() - ci[0].get<double>(), 0.0, 1e-12);
}

TEST(Sensitivity, ComparesGoalsWhereAsked) {
  std::vector<ArmTally> matches = hand_case();
  for (std::size_t i = 0; i < 10; ++i) {
    matches[0][i].goals = 1 + static_cast<std::int64_t>(i % 2);
    matches[1][i].goals = 5;
  }
  const Study study = two_inputs(Measure::kGoals);
  const StudyReport report = report_of(study, rows_of(study, matches), {.keeper = true});
  EXPECT_NEAR(report.json["headlines"][0]["value"].get<double>(), 0.035, 1e-12);
  EXPECT_NE(report.text.find("Goals past the keeper"), std::string::npos);
}

TEST(Sensitivity, LeavesOutAValueThatTheWorldHasNoRoomFor) {
  std::string left_out;
  const Study study = sensitivity_study({}, kTwo, {{"opponent.count", "1", "2.5", "said"}}, Measure::kPerOpportunity,
                                        [&](const std::string& why) { left_out += why; });
  EXPECT_NE(left_out.find("opponent.count = 2.5"), std::string::npos) << left_out;
  for (const StudyWorld& world : study.worlds) EXPECT_NE(world.what, "opponent.count = 2.5");
}

TEST(Sensitivity, WithoutShotsOnTargetItHasNoIntervals) {
  const Study study = two_inputs();
  const StudyReport report = report_of(study, rows_of(study, std::vector(6, alike(2, 1, 0, 0))), {});
  EXPECT_EQ(outputs_of(report).find("nan"), std::string::npos) << outputs_of(report);
  EXPECT_NE(report.text.find("moving - stopped: +0.0 (-)"), std::string::npos) << report.text;
  EXPECT_NE(report.csv.find("kicker.delay_s,0.05,moving,2,0,0,"), std::string::npos);
}

Study frontier() {
  return frontier_study({}, {.name = "predictive"}, {0.2, 0.5, 0.8},
                        {{.name = "moving"}, {.name = "stopped"}, {.name = "oracle"}});
}

std::vector<StudyRow> frontier_case() {
  return rows_of(frontier(), {alike(20, 100, 80, 56), alike(20, 100, 60, 48), alike(20, 100, 0, 0),
                              alike(20, 100, 70, 42), alike(20, 100, 20, 15), alike(20, 100, 80, 70)});
}

TEST(Frontier, IsMixedBetweenThresholdsAtThePolicysOwnKicks) {
  const std::vector<StudyRow> rows = frontier_case();
  // Half of each: 70 kicks, 52 on target.
  EXPECT_NEAR(frontier_above(rows, rows[3]).value, 52.0 / 70.0 - 42.0 / 70.0, 1e-12);
}

TEST(Frontier, BeyondItsEndsIsComparedWithTheEnd) {
  std::vector<StudyRow> rows = frontier_case();
  EXPECT_NEAR(frontier_above(rows, rows[4]).value, 0.8 - 0.75, 1e-12) << "at 0.8 it never kicks";
  rows[4].matches = alike(20, 100, 90, 45);
  EXPECT_NEAR(frontier_above(rows, rows[4]).value, 0.7 - 0.5, 1e-12);
  rows[4].matches = alike(20, 100, 0, 0);
  EXPECT_TRUE(std::isnan(frontier_above(rows, rows[4]).value));
}

TEST(Frontier, WithoutKicksPrintsNoNan) {
  const ArmTally none = alike(2, 1, 0, 0), one{{1, 1, 1}, {1, 0, 0}};
  std::vector<StudyRow> rows = rows_of(frontier(), std::vector(6, none));
  for (const std::size_t with_kick : {3, 0, 5}) {
    const std::string outputs = outputs_of(report_of(frontier(), rows, {}));
    EXPECT_EQ(outputs.find("nan"), std::string::npos) << outputs;
    EXPECT_EQ(outputs.find("inf"), std::string::npos) << outputs;
    rows[with_kick].matches = one;
  }
  const std::string text = report_of(frontier(), rows, {}).text;
  EXPECT_NE(text.find("100.0 (-)"), std::string::npos) << "one kick has no interval: " << text;
}

TEST(Frontier, TheJackknifeOfAShareIsTheIntervalOfItsMatches) {
  // Of a mean over matches of equal size it is the classic one: t s / sqrt(n).
  std::mt19937 random{5};
  const ArmTally arm = random_arm(random, 60, 0.7, 0.6);
  const Effect jack = jackknife({&arm}, [](const auto& totals) {
    return static_cast<double>(totals[0].on_target) / static_cast<double>(totals[0].opportunities);
  });
  const std::vector<Term> alone{{&arm, 1.0}};
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
    const auto arm = [&](double kick, double on_target) { return random_arm(random, 50, kick, on_target); };
    std::vector<StudyRow> rows = frontier_case();
    rows.erase(rows.begin() + 2);
    rows[0].matches = arm(0.8, 0.7);
    rows[1].matches = arm(0.6, 0.8);
    rows[2].matches = arm(0.7, 0.6);
    const Effect above = frontier_above(rows, rows[2]);
    covered += above.ci.lo <= truth && truth <= above.ci.hi;
  }
  EXPECT_NEAR(covered, 0.95 * kTimes, 4 * std::sqrt(0.95 * 0.05 * kTimes));
}

TEST(Frontier, TablesAndChartSayWhereAPolicyStands) {
  const StudyReport report = report_of(frontier(), frontier_case(), {.scenario = "hand.toml", .matches = 20});
  EXPECT_NE(report.text.find("+14.3 (+14.3 to +14.3)"), std::string::npos) << report.text;
  EXPECT_NE(report.text.find("At its best threshold, 0.2, predictive has 80.0 (80.0 to 80.0) % of the oracle's"),
            std::string::npos)
      << report.text;
  EXPECT_EQ(std::ranges::count(report.csv, '\n'), 1 + 3 + 3);
  EXPECT_NE(report.csv.find("predictive,0.8,2000,0,0,0,0,0,,,,0.000000"), std::string::npos) << report.csv;
  for (const char* name : {"predictive 0.2", "moving", "stopped", "oracle"})
    EXPECT_NE(report.svg.find(name), std::string::npos) << name;
  EXPECT_TRUE(report.json["rows"][3]["threshold"].is_null());
  EXPECT_NEAR(report.json["rows"][3]["frontier_above"]["value"].get<double>(), 10.0 / 70.0, 1e-12);
  EXPECT_NEAR(report.json["of_oracle"]["share"]["value"].get<double>(), 0.8, 1e-12);
}

StudyReport two_worlds() {
  const Study study = robustness_study({{.name = "moving"}, {.name = "predictive"}}, "moving",
                                       {{"as it is", "", {}}, {"worse <&>", "why", {}}});
  std::mt19937 random{5};
  std::vector<ArmTally> matches;
  for (const auto& [kick, on_target] : {std::pair{0.6, 0.8}, {0.9, 0.9}, {0.9, 0.9}, {0.6, 0.5}})
    matches.push_back(random_arm(random, 40, kick, on_target));
  return report_of(study, rows_of(study, matches), {.scenario = "default", .matches = 40, .possessions = 40});
}

TEST(Robustness, ComparesEachArmWithTheRivalInEachWorld) {
  const auto rows = two_worlds().json["rows"];
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[1]["world"], "as it is");
  EXPECT_EQ(rows[1]["arm"], "predictive");
  EXPECT_FALSE(rows[0].contains("change")) << "the rival itself";
  EXPECT_NEAR(rows[1]["change"]["value"].get<double>(), 0.81 - 0.48, 0.04);
  EXPECT_GT(rows[1]["change"]["ci"][0], 0.0);
  EXPECT_LT(rows[3]["change"]["ci"][1], 0.0);
}

TEST(Robustness, SaysInHowManyWorldsTheIntervalReachesBelowNothing) {
  const std::string text = two_worlds().text;
  EXPECT_NE(text.find("predictive - moving: 1 of 2\n"), std::string::npos) << text;
}

TEST(Robustness, TheChartHasAMarkForEveryNumber) {
  const std::string svg = two_worlds().svg;
  EXPECT_NE(svg.find("worse &lt;&amp;&gt;"), std::string::npos);
  std::size_t marks = 0;
  for (std::size_t at = svg.find("r=\"3\""); at != std::string::npos; at = svg.find("r=\"3\"", at + 1)) ++marks;
  EXPECT_EQ(marks, 4u + 2u) << "shares, and differences from the rival";
}

}  // namespace
}  // namespace trivela::experiment
