#include <gmock/gmock.h>

#include <cmath>

#include "config/scenario/scenario.hpp"
#include "experiment/study/studies.hpp"
#include "play_arms.hpp"

namespace trivela::experiment {
namespace {

using testing::HasSubstr;
using testing::Not;

/// 20 matches of 40 opportunities, half of them with a kick, so many on target.
ArmTally matches_of(std::int64_t on_target, std::int64_t kicks = 20) {
  ArmTally matches;
  for (std::int64_t i = 0; i < 20; ++i) matches.push_back({40, kicks, on_target + (i % 2 == 0 ? 1 : -1)});
  return matches;
}

Study study_of(const std::set<double>& medians_m = {}, const std::set<double>& biases_m = {}) {
  return factorial_study({}, {}, "released", medians_m, biases_m);
}

/// Efficiency 0.4, +0.1 for the new table, +0.2 for moving, +0.05 for both together; predictive 0.1 above moving.
std::vector<StudyRow> played() {
  std::vector<StudyRow> rows;
  const Study study = study_of();
  for (const RowLabels& labels : study.worlds.front().labels) {
    StudyRow& row = rows.emplace_back(StudyRow{labels, {}});
    const bool again = row.label("table") == "new", moves = row.label("policy") != "stopped";
    row.matches = matches_of(8 + (again ? 2 : 0) + (moves ? 4 : 0) + (again && moves ? 1 : 0) +
                             (row.label("policy") == "predictive" ? 2 : 0));
  }
  return rows;
}

/// With both sides of each point of a sweep.
std::vector<StudyRow> played(const Study& study, const std::vector<std::pair<ArmTally, ArmTally>>& points) {
  std::vector<StudyRow> rows = played();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& labels = study.worlds[i + 1].labels;
    rows.push_back({labels[0], points[i].first});
    rows.push_back({labels[1], points[i].second});
  }
  return rows;
}

/// The value of an effect in the report's JSON, by this measure.
double effect(const std::vector<StudyRow>& rows, const std::string& key, Measure measure = Measure::kEfficiency) {
  const StudyReport report = report_of(study_of(), rows, {.efficiency = measure});
  for (const Json& named : report.json["effects"])
    if (named["effect"] == key) return named["efficiency"]["value"].get<double>();
  return std::nan("");
}

TEST(Factorial, HasEveryCellOnce) {
  const Study study = study_of({1.0}, {0.1});
  const auto& arms = study.worlds.front().arms;
  ASSERT_EQ(arms.size(), 14u);
  EXPECT_EQ(arms.front().name, "old stopped paper");
  EXPECT_EQ(arms.back().name, "new predictive");
  EXPECT_EQ(arms[4].name, "old moving released");
  EXPECT_EQ(arms[4].table, "old");
  EXPECT_EQ(arms[4].settings.policy.height_law, kicking::HeightLaw::kExtendedRange);
  EXPECT_EQ(arms[4].settings.policy.motion_law, kicking::MotionLaw::kPaper);
  ASSERT_EQ(study.worlds.size(), 3u);
  EXPECT_EQ(study.worlds[1].scenario.opponent.distance_median_m, 1.0);
  EXPECT_EQ(study.worlds[2].scenario.hand_table.target_height_m, sim::Scenario{}.hand_table.target_height_m + 0.1);
  EXPECT_EQ(study.worlds[2].arms.back().name, "new moving released");
}

TEST(Factorial, EffectsAreThoseThatMadeTheCounts) {
  EXPECT_NEAR(effect(played(), "calibration"), 0.125, 1e-12);
  EXPECT_NEAR(effect(played(), "motion"), 0.225, 1e-12);
  EXPECT_NEAR(effect(played(), "calibration_x_motion"), 0.05, 1e-12);
  EXPECT_NEAR(effect(played(), "exact_law"), 0.0, 1e-12);
  EXPECT_NEAR(effect(played(), "prediction"), 0.1, 1e-12);
}

TEST(Factorial, CalibrationAndMotionAddUpToTheGain) {
  for (const Measure measure : {Measure::kEfficiency, Measure::kPerOpportunity})
    EXPECT_NEAR(effect(played(), "gain", measure),
                effect(played(), "calibration", measure) + effect(played(), "motion", measure), 1e-12);
  EXPECT_NEAR(effect(played(), "gain"), 0.35, 1e-12);
}

TEST(Factorial, WhatMatchesHaveInCommonCancels) {
  // Every arm varies alike from match to match: the difference does not vary at all.
  const ArmTally a = matches_of(8), b = matches_of(10);
  const std::vector<Term> terms{{&b, 1.0}, {&a, -1.0}};
  const Effect effect = contrast(terms, Measure::kEfficiency);
  EXPECT_NEAR(effect.value, 0.1, 1e-12);
  EXPECT_NEAR(effect.ci.hi - effect.ci.lo, 0.0, 1e-12);
  const std::vector<Term> one{{&a, 1.0}};
  EXPECT_GT(contrast(one, Measure::kEfficiency).ci.hi, contrast(one, Measure::kEfficiency).value);
}

TEST(Factorial, CalibrationsThatDifferWidenTheInterval) {
  // Ten matches on each of six calibrations; on each the newer arm gains another number of shots.
  ArmTally older, newer;
  for (std::uint32_t k = 0; k < 6; ++k) {
    for (std::int64_t m = 0; m < 10; ++m) {
      older.push_back({.opportunities = 40, .kicks = 20, .on_target = 8 + m % 2, .calibration = k});
      newer.push_back(
          {.opportunities = 40, .kicks = 20, .on_target = 10 + m % 2 + static_cast<std::int64_t>(k), .calibration = k});
    }
  }
  const std::vector<Term> terms{{&newer, 1.0}, {&older, -1.0}};
  const Effect effect = contrast(terms, Measure::kPerOpportunity);
  EXPECT_NEAR(effect.value, 4.5 / 40.0, 1e-12);
  // By hand: means of the calibrations 2 to 7 of 40, sd sqrt(3.5) / 40, Student's t of some 5 degrees of freedom.
  EXPECT_NEAR(effect.ci.hi - effect.value, 2.5706 * std::sqrt(3.5 / 6.0) / 40.0, 0.002);
  for (ArmTally* arm : {&older, &newer}) {
    for (MatchTally& match : *arm) match.calibration = 0;
  }
  EXPECT_LT(contrast(terms, Measure::kPerOpportunity).ci.hi, effect.ci.hi) << "sixty matches of one calibration";
}

TEST(Factorial, SweepSaysWhereThePapersRatioIsMet) {
  const Study study = study_of({1.0, 2.0, 3.0});
  std::vector<std::pair<ArmTally, ArmTally>> points;
  for (const int kicks : {30, 22, 16}) points.emplace_back(matches_of(5, 10), matches_of(kicks * 3 / 4, kicks));
  const auto ratio_at_m = [&] { return report_of(study, played(study, points), {}).json["sweep"]["ratio_at_m"]; };
  // By hand: 2.2 at 2 m, 1.6 at 3 m; the paper has 132 kicks and 65.
  EXPECT_NEAR(ratio_at_m().get<double>(), 2.0 + (2.2 - 132.0 / 65.0) / 0.6, 1e-9);
  points.resize(2);
  EXPECT_TRUE(ratio_at_m().is_null());
}

TEST(Factorial, ReportSaysWhatItClaimsAndWhatNot) {
  const StudyReport report = report_of(study_of(), played(), {});
  EXPECT_THAT(report.text, HasSubstr("It says nothing about why the paper's tournaments differed"));
  EXPECT_EQ(report.json["rows"].size(), 14u);
  EXPECT_THAT(report.text, testing::StartsWith("SIMULATED: "));
  EXPECT_EQ(report.json["simulated"], true);
  EXPECT_THAT(report.csv,
              testing::AllOf(HasSubstr("cell,new,predictive,,"), HasSubstr(",simulated\n"), testing::EndsWith(",1\n")));
  EXPECT_THAT(report.svg, testing::AllOf(HasSubstr("<svg"), HasSubstr("simulated: "), HasSubstr(">old<"),
                                         HasSubstr(">new<"), HasSubstr(">moving released<")));
}

TEST(Factorial, BlockedKicksStandApartWhereAsked) {
  std::vector<StudyRow> rows = played();
  for (StudyRow& row : rows)
    for (MatchTally& match : row.matches) match.blocked = row.label("policy") == "moving" ? 5 : 0;
  EXPECT_NEAR(effect(rows, "motion"), 0.225, 1e-12);
  // Of 15, not 20 kicks: by hand (12 + 15) / 2 / 15 - (8 + 10) / 2 / 20.
  EXPECT_NEAR(effect(rows, "motion", Measure::kUnblocked), 0.9 - 0.45, 1e-12);
  EXPECT_EQ(report_of(study_of(), rows, {.efficiency = Measure::kUnblocked}).json["blocked"], "apart");
}

TEST(Factorial, SaysWhichAssumptionsReachThePapersPair) {
  const ArmTally older = matches_of(10);
  ArmTally newer = matches_of(13);
  for (MatchTally& match : newer) match.blocked = 3;
  const Study study = study_of({}, {0.1});
  const StudyReport report = report_of(study, played(study, {{older, newer}}), {});
  EXPECT_THAT(report.text, testing::AllOf(HasSubstr("0.1  outside"), HasSubstr("65.0"), HasSubstr("76.5")));
  const auto& json = report.json["pair"];
  ASSERT_EQ(json.size(), 2u);
  EXPECT_FALSE(json[0]["both_within_papers"]) << "65 % is below 68";
  EXPECT_TRUE(json[1]["both_within_papers"]);
}

TEST(Factorial, CountsWhatBouncedInAndWhatPassedTheKeeper) {
  std::vector<StudyRow> rows = played();
  for (StudyRow& row : rows) {
    for (MatchTally& match : row.matches) {
      match.bounced = match.on_target / 2;
      match.goals = 4;
    }
  }
  EXPECT_THAT(report_of(study_of(), rows, {}).text, Not(HasSubstr("goals/opp.")));
  const StudyReport report = report_of(study_of(), rows, {.keeper = true});
  EXPECT_THAT(report.text, testing::AllOf(HasSubstr("goals/opp. [%]"), HasSubstr("10.0 (8.0 to 12.4)")));
  EXPECT_NEAR(share_of(rows[0].matches, Measure::kBounced).value, 0.4375, 0.07);
  EXPECT_EQ(report.json["rows"][0]["goals"], 80);
  EXPECT_THAT(report.json["notes"].dump(), HasSubstr("goals, bounced: the simulator's truth"));
}

TEST(StudyOfArms, ComparesEachArmWithTheFirst) {
  std::vector<StudyRow> rows{{{{"arm", "stopped"}}, matches_of(8)}, {{{"arm", "moving, twice"}}, matches_of(10)}};
  const Study study = arms_study({}, {{.name = "stopped"}, {.name = "moving, twice"}});
  const StudyReport report = report_of(study, rows, {.scenario = "default.toml", .matches = 20, .possessions = 40});
  EXPECT_THAT(report.text, testing::AllOf(HasSubstr("minus stopped"), HasSubstr("+10.0 (+10.0 to +10.0)")));
  EXPECT_THAT(report.csv, HasSubstr("\n\"moving, twice\",800,400,200,0,0,0,"));
  EXPECT_NEAR(report.json["rows"][1]["minus_first"]["efficiency"]["value"].get<double>(), 0.1, 1e-12);
  for (MatchTally& match : rows[1].matches) match.true_on_target = match.on_target;
  EXPECT_THAT(report_of(study, rows, {}).text, testing::AllOf(Not(HasSubstr("moving, twice: many labels")),
                                                              HasSubstr("stopped: many labels are wrong or unknown")));
}

TEST(Factorial, AShareStaysWithinItsBounds) {
  ArmTally few(6, MatchTally{1, 1, 1});
  few.back().on_target = 0;
  const std::vector<Term> alone{{&few, 1.0}};
  EXPECT_GT(contrast(alone, Measure::kEfficiency).ci.hi, 1.0);
  const Effect share = share_of(few, Measure::kEfficiency);
  EXPECT_LE(share.ci.hi, 1.0);
  EXPECT_LT(share.ci.lo, contrast(alone, Measure::kEfficiency).value);
  for (const auto on_target : {0, 1}) {
    const ArmTally all_alike(6, MatchTally{1, 1, on_target});
    const Effect certain = share_of(all_alike, Measure::kEfficiency);
    EXPECT_GT(certain.ci.hi - certain.ci.lo, 0.3) << "six kicks leave much open";
    EXPECT_TRUE(certain.ci.lo == 0.0 || certain.ci.hi == 1.0);
  }
}

// Clopper and Pearson's interval of 6 of 8, by bisection of the binomial tails.
TEST(Factorial, AShareOfMatchesThatAreAlikeByChanceIsNotCertain) {
  const ArmTally alike(2, MatchTally{4, 4, 3});
  const Effect share = share_of(alike, Measure::kEfficiency);
  EXPECT_NEAR(share.ci.lo, 0.3491442, 1e-6);
  EXPECT_NEAR(share.ci.hi, 0.9681460, 1e-6);
}

TEST(Factorial, OneMatchWithKicksGivesNoInterval) {
  const ArmTally none(3, MatchTally{1, 0, 0}), one{{1, 1, 1}, {1, 0, 0}, {1, 0, 0}};
  EXPECT_TRUE(std::isnan(share_of(none, Measure::kEfficiency).value));
  EXPECT_EQ(share_of(one, Measure::kEfficiency).value, 1.0);
  EXPECT_FALSE(has_interval(share_of(one, Measure::kEfficiency)));
  EXPECT_TRUE(has_interval(share_of(one, Measure::kPerOpportunity)));
  EXPECT_EQ(kick_ratio(one, one).value, 1.0);
  EXPECT_FALSE(has_interval(kick_ratio(one, one)));
  EXPECT_TRUE(std::isnan(kick_ratio(none, one).value));
}

TEST(Factorial, WithoutKicksItPrintsNoNan) {
  const ArmTally none(2, MatchTally{1, 0, 0});
  const Study study = study_of({2.0});
  std::vector<StudyRow> rows = played(study, {{none, none}});
  for (StudyRow& row : rows) row.matches = none;
  const StudyReport report = report_of(study, rows, {});
  for (const std::string& output : {report.text, report.csv, report.svg, report.json.dump()}) {
    EXPECT_EQ(output.find("nan"), std::string::npos) << output;
    EXPECT_EQ(output.find("inf"), std::string::npos) << output;
  }
  EXPECT_THAT(report.text, HasSubstr("kick ratio is met at: beyond the sweep"));
  EXPECT_THAT(report.csv, HasSubstr("cell,old,stopped,paper,1.5,,2,0,0,0,0,0,,,,0.000000,0.000000,"));
  EXPECT_TRUE(report.json["rows"][0]["efficiency"].is_null());
  EXPECT_TRUE(report.json["sweep"]["ratio_at_m"].is_null());
}

TEST(Factorial, PlayIsTheSameForAnyNumberOfJobs) {
  const auto cells = study_of().worlds.front().arms;
  const std::vector<Arm> arms{cells[2], cells[12]};  // old stopped exact, new moving exact
  const auto play = [&](unsigned jobs) {
    return play_arms({}, arms, {.seed = 3, .matches = 3, .possessions = 4, .jobs = jobs});
  };
  const auto one = play(1), two = play(2);
  for (std::size_t arm = 0; arm < arms.size(); ++arm) {
    for (std::size_t m = 0; m < 3; ++m) {
      EXPECT_EQ(one[arm][m].opportunities, 4);
      EXPECT_EQ(one[arm][m].kicks, two[arm][m].kicks);
      EXPECT_EQ(one[arm][m].on_target, two[arm][m].on_target);
    }
  }
}

TEST(Factorial, TheShippedWorldsArePlayed) {
  const std::string config = std::string{TRIVELA_SOURCE_DIR} + "/config/";
  config::Settings settings = config::load_settings(config + "default.toml");
  config::override_settings(settings, {"policy.objective = 'on_target'"});
  const std::vector<config::Robot> robots{config::load_robot(config + "robots/calibrated_1.toml")};
  const PlayPlan plan{.seed = 3, .matches = 4, .possessions = 15};
  const auto cells = factorial_study({}, {.settings = settings, .robots = robots}, "paper", {}, {}).worlds[0].arms;
  const std::vector<Arm> arms{cells[7], cells[10]};  // new stopped paper, new moving paper
  const auto played = [&](const std::string& world, const std::string& change = "") {
    sim::Scenario scenario = config::load_scenario(config + "scenarios/" + world + ".toml");
    if (!change.empty()) config::override_scenario(scenario, change);
    std::vector<MatchTally> totals;
    for (const ArmTally& arm : play_arms(scenario, arms, plan)) totals.push_back(total_of(arm));
    return totals;
  };
  const auto open = played("default"), kept = played("keeper"), blind = played("keeper", "keeper.sight_sd_mps = 3.0"),
             log = played("like_2016"), crowded = played("default", "defenders.count = 4");
  for (std::size_t i = 0; i < arms.size(); ++i) {
    EXPECT_GT(open[i].on_target, 0);
    EXPECT_EQ(open[i].goals, open[i].on_target) << "nobody is in the goal";
    EXPECT_EQ(open[i].kicks, kept[i].kicks) << "a keeper changes no kick that is to be on target";
    EXPECT_LT(kept[i].goals, open[i].goals);
    EXPECT_GT(blind[i].goals, kept[i].goals);
    EXPECT_GT(log[i].kicks, open[i].kicks) << "slow opponents leave time";
    EXPECT_GT(crowded[i].blocked, open[i].blocked);
  }
  EXPECT_GT(open[0].bounced, 0) << "the paper's law lets the ball land on the line";
  EXPECT_LT(open[0].bounced, open[0].on_target);
}

}  // namespace
}  // namespace trivela::experiment
