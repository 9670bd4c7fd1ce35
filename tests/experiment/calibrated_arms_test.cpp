// Robots of several calibrations in the matches of one experiment.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "experiment/run/arms.hpp"
#include "play_arms.hpp"

namespace trivela::experiment {
namespace {

Team team_of(double delay_s) {
  config::Robot robot;
  robot.model.delay_s = delay_s;
  return {robot};
}

std::vector<Arm> two_arms() {
  Arm own{.name = "own", .settings = {}, .random = {}};
  own.own_robots = true;
  return {{.name = "moving", .settings = {}, .random = {}}, own};
}

TEST(PlayPlan, GivesEachMatchOneCalibrationInTurnToEveryArmButOneWithRobotsOfItsOwn) {
  const PlayPlan plan{.calibrations = {team_of(0.05), team_of(0.06), team_of(0.07)}};
  std::map<std::uint32_t, int> matches;
  for (std::uint32_t match = 0; match < 31; ++match) {
    ++matches[plan.calibration_of(match)];
    EXPECT_DOUBLE_EQ(plan.in_match(match, two_arms()[0]).robots[0].model.delay_s,
                     0.05 + 0.01 * plan.calibration_of(match));
    EXPECT_EQ(plan.in_match(match, two_arms()[1]).robots[0].model.delay_s, config::Robot{}.model.delay_s);
  }
  EXPECT_EQ(matches, (std::map<std::uint32_t, int>{{0, 11}, {1, 10}, {2, 10}}));
}

TEST(PlayPlan, WithoutCalibrationsLeavesTheRobotsAsTheyAre) {
  EXPECT_EQ(PlayPlan{}.calibration_of(17), 0U);
  EXPECT_EQ(PlayPlan{}.in_match(17, {.robots = team_of(0.09)}).robots[0].model.delay_s, 0.09);
}

TEST(CalibrationSeeds, OfTheHeadlinesAreNotThoseThatSettingsWereChosenBy) {
  std::set<std::uint64_t> seeds;
  for (const std::uint64_t experiment : {1, 2, 7, 1001, 1002}) {
    for (std::uint32_t calibration = 0; calibration < 20; ++calibration) {
      for (std::uint32_t robot = 1; robot <= 5; ++robot)
        EXPECT_TRUE(seeds.insert(calibration_seed(experiment, calibration, robot)).second) << experiment;
    }
  }
  EXPECT_LT(*seeds.rbegin(), kCalibrationSeeds);
}

TEST(PlayArms, PlaysAMatchWithItsCalibrationAndCountsItThere) {
  const sim::Scenario scenario;
  Arm arm{.name = "moving", .settings = {}, .random = {}};
  Team wrong = team_of(0.06);
  wrong[0].model.exit_angle_rad += 0.3;
  PlayPlan plan{.seed = 3, .matches = 6, .possessions = 20, .jobs = 2, .calibrations = {team_of(0.06), wrong}};
  const auto none = [](std::size_t, std::size_t) {};
  const ArmTally both = play_arms(scenario, {arm}, plan, none).front();
  std::vector<ArmTally> alone;
  for (const Team& team : plan.calibrations) {
    Arm one = arm;
    one.robots = team;
    alone.push_back(play_arms(scenario, {one}, {.seed = 3, .matches = 6, .possessions = 20}, none).front());
  }
  EXPECT_NE(total_of(alone[0]).on_target, total_of(alone[1]).on_target);
  for (std::uint32_t m = 0; m < 6; ++m) {
    EXPECT_EQ(both[m].calibration, m % 2);
    EXPECT_EQ(both[m].kicks, alone[m % 2][m].kicks);
    EXPECT_EQ(both[m].on_target, alone[m % 2][m].on_target);
  }
}

TEST(PlayArms, ReportsNothingAfterProgressThrew) {
  Arm arm{.name = "moving", .settings = {}, .random = {}};
  std::size_t played = 0;
  const auto stop = [&](std::size_t done, std::size_t) {
    played = done;
    if (done == 3) throw std::runtime_error{"stop"};
  };
  EXPECT_THROW(play_arms({}, {arm}, {.matches = 500, .possessions = 2, .jobs = 2}, stop), std::runtime_error);
  EXPECT_EQ(played, 3U);
}

/// Matches of one calibration are alike: a share of matches on few calibrations is known less well than of as many
/// calibrations.
TEST(Contrast, AllowsForWhatTheMatchesOfAnCalibrationHaveInCommon) {
  ArmTally nested, apart;
  for (std::uint32_t m = 0; m < 200; ++m) {
    const std::int64_t on_target = 30 + 10 * static_cast<std::int64_t>(m % 10 % 3) + m / 10 % 2;
    nested.push_back({.opportunities = 100, .kicks = 100, .on_target = on_target, .calibration = m % 10});
    apart.push_back({.opportunities = 100, .kicks = 100, .on_target = on_target});
  }
  const Effect by_calibration = share_of(nested, Measure::kPerOpportunity),
               by_match = share_of(apart, Measure::kPerOpportunity);
  EXPECT_EQ(by_calibration.value, by_match.value);
  // Ten calibrations of 30, 40 and 50 %: sd of their mean times t with 9 degrees of freedom.
  EXPECT_NEAR(by_calibration.ci.hi - by_calibration.value, 2.262 * 0.0876 / std::sqrt(10.0), 0.006);
  EXPECT_GT(by_calibration.ci.hi - by_calibration.value, 3.0 * (by_match.ci.hi - by_match.value));
}

}  // namespace
}  // namespace trivela::experiment
