#include <gmock/gmock.h>

#include <cmath>

#include "config/scenario/scenario.hpp"
#include "experiment/study/arms_report.hpp"
#include "experiment/study/factorial_report.hpp"
#include "play_arms.hpp"

namespace trivela::experiment {
namespace {

using kicking::PolicyName;
using testing::HasSubstr;
using testing::Not;

/// 20 matches of 40 opportunities, half of them with a kick, so many on target.
ArmTally matches_of(std::int64_t on_target, std::int64_t kicks = 20) {
  ArmTally matches;
  for (std::int64_t i = 0; i < 20; ++i) matches.push_back({40, kicks, on_target + (i % 2 == 0 ? 1 : -1)});
  return matches;
}

/// Efficiency 0.4, +0.1 for the new table, +0.2 for moving, +0.05 for both together; predictive 0.1 above moving.
std::vector<PlayedCell> played() {
  std::vector<PlayedCell> cells;
  for (const Cell& cell : factorial_cells()) {
    const bool again = cell.table == "new", moves = cell.policy != PolicyName::kStopped;
    const int on_target = 8 + (again ? 2 : 0) + (moves ? 4 : 0) + (again && moves ? 1 : 0) +
                          (cell.policy == PolicyName::kPredictive ? 2 : 0);
    cells.push_back({cell, matches_of(on_target)});
  }
  return cells;
}

TEST(Factorial, HasEveryCellOnce) {
  const auto cells = factorial_cells();
  ASSERT_EQ(cells.size(), 14u);
  EXPECT_EQ(cells.front().name(), "old stopped paper");
  EXPECT_EQ(cells.back().name(), "new predictive");
  const Arm arm = arm_of({"old", PolicyName::kMoving, Law::kReleased}, {}, {});
  EXPECT_EQ(arm.table, "old");
  EXPECT_EQ(arm.settings.policy.height_law, kicking::HeightLaw::kExtendedRange);
  EXPECT_EQ(arm.settings.policy.motion_law, kicking::MotionLaw::kPaper);
}

TEST(Factorial, EffectsAreThoseThatMadeTheCounts) {
  const auto effects = effects_of(played());
  const auto value = [&](const char* key) {
    for (const NamedEffect& effect : effects) {
      if (effect.key == key) return effect.efficiency.value;
    }
    return std::nan("");
  };
  EXPECT_NEAR(value("calibration"), 0.125, 1e-12);
  EXPECT_NEAR(value("motion"), 0.225, 1e-12);
  EXPECT_NEAR(value("calibration_x_motion"), 0.05, 1e-12);
  EXPECT_NEAR(value("exact_law"), 0.0, 1e-12);
  EXPECT_NEAR(value("prediction"), 0.1, 1e-12);
}

TEST(Factorial, CalibrationAndMotionAddUpToTheGain) {
  for (const Measure measure : {Measure::kEfficiency, Measure::kPerOpportunity}) {
    const Gain gain = gain_of(played(), measure);
    EXPECT_NEAR(gain.gain.value, gain.calibration.value + gain.motion.value, 1e-12);
  }
  EXPECT_NEAR(gain_of(played(), Measure::kEfficiency).gain.value, 0.35, 1e-12);
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
  const Term terms[] = {{&newer, 1.0}, {&older, -1.0}};
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
  std::vector<SweepPoint> sweep;
  for (const auto& [median_m, kicks] : {std::pair{1.0, 30}, {2.0, 22}, {3.0, 16}}) {
    sweep.push_back({median_m, matches_of(5, 10), matches_of(kicks * 3 / 4, kicks)});
  }
  const SweepAnswer answer = answer_of(sweep);
  ASSERT_TRUE(answer.ratio_at_m);
  // By hand: 2.2 at 2 m, 1.6 at 3 m.
  EXPECT_NEAR(*answer.ratio_at_m, 2.0 + (2.2 - kPaperKickRatio) / 0.6, 1e-9);
  EXPECT_EQ(answer.pair_within.size(), 3u);  // 50 and 75 % everywhere
  sweep.resize(2);
  EXPECT_FALSE(answer_of(sweep).ratio_at_m);
}

TEST(Factorial, ReportSaysWhatItClaimsAndWhatNot) {
  FactorialReport report{.robots = {"calibrated_1"}, .cells = played()};
  EXPECT_THAT(to_text(report), HasSubstr("It says nothing about why the paper's tournaments differed"));
  EXPECT_EQ(to_json(report)["rows"].size(), 14u);
  EXPECT_THAT(csv_of(rows_of(report), report.played), HasSubstr("cell,new,predictive,,"));
  EXPECT_THAT(to_text(report), testing::StartsWith("SIMULATED: "));
  EXPECT_EQ(to_json(report)["simulated"], true);
  EXPECT_THAT(csv_of(rows_of(report), report.played), HasSubstr(",simulated\n"));
  EXPECT_THAT(csv_of(rows_of(report), report.played), testing::EndsWith(",1\n"));
  EXPECT_THAT(to_svg(report), testing::AllOf(HasSubstr("simulated: "), HasSubstr(">old<"), HasSubstr(">new<")));
  EXPECT_THAT(to_svg(report), testing::Not(HasSubstr(">-0.2<")));
  EXPECT_THAT(to_svg(report), HasSubstr("<svg"));
}

TEST(Factorial, BlockedKicksStandApartWhereAsked) {
  std::vector<PlayedCell> cells = played();
  for (PlayedCell& played : cells) {
    for (MatchTally& match : played.matches) match.blocked = played.cell.policy == PolicyName::kMoving ? 5 : 0;
  }
  const auto motion = [&](Measure measure) { return effects_of(cells, measure)[1].efficiency.value; };
  EXPECT_NEAR(motion(Measure::kEfficiency), 0.225, 1e-12);
  // Of 15, not 20 kicks: by hand (12 + 15) / 2 / 15 - (8 + 10) / 2 / 20.
  EXPECT_NEAR(motion(Measure::kUnblocked), 0.9 - 0.45, 1e-12);
  FactorialReport report{.robots = {"calibrated_1"}, .cells = cells};
  EXPECT_THAT(to_text(report), HasSubstr("blocked ones included"));
  report.played.efficiency = Measure::kUnblocked;
  EXPECT_THAT(to_text(report), HasSubstr("of the kicks that nobody blocked"));
  EXPECT_EQ(to_json(report)["blocked"], "apart");
}

TEST(Factorial, SaysWhichAssumptionsReachThePapersPair) {
  ArmTally older = matches_of(10), newer = matches_of(13);
  for (MatchTally& match : newer) match.blocked = 3;
  FactorialReport report{.cells = played(), .biases = {{0.1, older, newer}}};
  const std::string text = to_text(report);
  EXPECT_THAT(text, HasSubstr("outside  50.0"));
  EXPECT_THAT(text, HasSubstr("65.0"));
  EXPECT_THAT(text, HasSubstr("76.5"));
  const auto json = to_json(report)["pair"];
  ASSERT_EQ(json.size(), 2u);
  EXPECT_FALSE(json[0]["both_within_papers"]) << "65 % is below 68";
  EXPECT_TRUE(json[1]["both_within_papers"]);
}

TEST(Factorial, CountsWhatBouncedInAndWhatPassedTheKeeper) {
  std::vector<PlayedCell> cells = played();
  for (PlayedCell& played : cells) {
    for (MatchTally& match : played.matches) {
      match.bounced = match.on_target / 2;
      match.goals = 4;
    }
  }
  FactorialReport report{.robots = {"calibrated_1"}, .cells = cells};
  EXPECT_THAT(to_text(report), Not(HasSubstr("goals/opp.")));
  report.played.keeper = true;
  EXPECT_THAT(to_text(report), HasSubstr("goals/opp. [%]"));
  EXPECT_THAT(to_text(report), HasSubstr("10.0 (10.0 to 10.0)"));
  EXPECT_NEAR(share_of(cells[0].matches, Measure::kBounced).value, 0.4375, 0.07);
  EXPECT_EQ(to_json(report)["rows"][0]["goals"], 80);
}

TEST(StudyOfArms, ComparesEachArmWithTheFirst) {
  ArmsReport report{.played = {.scenario = "default.toml", .matches = 20, .possessions = 40},
                    .arms = {{"stopped", matches_of(8)}, {"moving, twice", matches_of(10)}}};
  const std::string text = to_text(report), csv = csv_of(rows_of(report), report.played);
  EXPECT_THAT(text, HasSubstr("minus stopped"));
  EXPECT_THAT(text, HasSubstr("+10.0 (+10.0 to +10.0)"));
  EXPECT_THAT(csv, HasSubstr("\n\"moving, twice\",800,400,200,0,0,0,"));
  EXPECT_NEAR(to_json(report)["rows"][1]["minus_first"]["efficiency"]["value"].get<double>(), 0.1, 1e-12);
  for (MatchTally& match : report.arms[1].matches) match.true_on_target = match.on_target;
  EXPECT_THAT(to_text(report), Not(HasSubstr("moving, twice: the observer")));
  EXPECT_THAT(to_text(report), HasSubstr("stopped: many labels are wrong or unknown"));
}

TEST(Factorial, AShareStaysWithinItsBounds) {
  ArmTally few(6, MatchTally{1, 1, 1});
  few.back().on_target = 0;
  const Term alone[] = {{&few, 1.0}};
  EXPECT_GT(contrast(alone, Measure::kEfficiency).ci.hi, 1.0);
  const Effect share = share_of(few, Measure::kEfficiency);
  EXPECT_EQ(share.ci.hi, 1.0);
  EXPECT_EQ(share.ci.lo, contrast(alone, Measure::kEfficiency).ci.lo);
  for (const auto on_target : {0, 1}) {
    const ArmTally all_alike(6, MatchTally{1, 1, on_target});
    const Effect certain = share_of(all_alike, Measure::kEfficiency);
    EXPECT_GT(certain.ci.hi - certain.ci.lo, 0.3) << "six kicks leave much open";
    EXPECT_TRUE(certain.ci.lo == 0.0 || certain.ci.hi == 1.0);
  }
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

TEST(Factorial, WithoutKicksItSaysSoAndPrintsNoNan) {
  const ArmTally none(2, MatchTally{1, 0, 0});
  FactorialReport report{.robots = {"calibrated_1"}};
  for (const Cell& cell : factorial_cells()) report.cells.push_back({cell, none});
  report.sweep = {{2.0, none, none}};
  const std::string text = to_text(report), csv = csv_of(rows_of(report), report.played), svg = to_svg(report),
                    json = to_json(report).dump();
  for (const std::string* output : {&text, &csv, &svg, &json}) {
    EXPECT_EQ(output->find("nan"), std::string::npos) << *output;
    EXPECT_EQ(output->find("inf"), std::string::npos) << *output;
  }
  EXPECT_THAT(text, HasSubstr("efficiency cannot be told, there are too few kicks"));
  EXPECT_THAT(text, HasSubstr("shots on target per opportunity cannot be told, there are too few kicks"));
  EXPECT_THAT(text, HasSubstr("too few kicks for a kick ratio"));
  EXPECT_THAT(text, HasSubstr("too few kicks to say where its pair of efficiencies is nearest"));
  EXPECT_THAT(csv, HasSubstr("cell,old,stopped,paper,0,,2,0,0,0,0,0,,,,0.000000,0.000000,"));
  EXPECT_TRUE(to_json(report)["rows"][0]["efficiency"].is_null());
  EXPECT_TRUE(to_json(report)["sweep"]["nearest_m"].is_null());
}

TEST(Factorial, ASweepOfOnePointIsAtThatPoint) {
  FactorialReport report{.robots = {"calibrated_1"}, .cells = played()};
  report.sweep = {{2.0, matches_of(5, 10), matches_of(6, 10)}};
  EXPECT_THAT(to_text(report), HasSubstr("ratio of 2.03 is not met at 2 m."));
}

TEST(Factorial, PlayIsTheSameForAnyNumberOfJobs) {
  const std::vector<Arm> arms{arm_of({"old", PolicyName::kStopped, Law::kExact}, {}, {config::Robot{}}),
                              arm_of({"new", PolicyName::kMoving, Law::kExact}, {}, {config::Robot{}})};
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
  std::vector<Arm> arms;
  for (const PolicyName policy : {PolicyName::kStopped, PolicyName::kMoving})
    arms.push_back(arm_of({"new", policy, Law::kPaper}, settings, robots));
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
