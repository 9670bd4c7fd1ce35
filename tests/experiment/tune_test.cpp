// The search for a policy's settings, on worlds of which the best settings are known.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "config/text/error.hpp"
#include "experiment/study/tune/tune.hpp"

namespace trivela::experiment {
namespace {

Coordinate numbers(const std::string& key, const std::vector<double>& values) {
  Coordinate made{key, {}};
  for (const double value : values) made.choices.push_back({key + " = " + std::to_string(value)});
  return made;
}

/// 40 matches of 100 opportunities on 5 calibrations; shots on target fall with the distance from the best settings.
ArmTally played(double distance, std::uint32_t seed) {
  std::mt19937 random{seed};
  ArmTally arm;
  for (std::uint32_t m = 0; m < 40; ++m) {
    const auto noise = static_cast<std::int64_t>(random() % 7);
    const auto on_target = static_cast<std::int64_t>(std::lround(60.0 - 20.0 * distance)) + noise;
    arm.push_back({.opportunities = 100, .kicks = 90, .on_target = on_target, .calibration = m % 5});
  }
  return arm;
}

double distance_of(const config::Settings& settings) {
  return std::abs(settings.policy.settle_s - 0.1) * 4.0 + std::abs(settings.policy.dribble_mps - 0.5);
}

std::vector<ArmTally> play(const std::vector<config::Settings>& settings) {
  std::vector<ArmTally> arms;
  for (const config::Settings& each : settings) arms.push_back(played(distance_of(each), 7));
  return arms;
}

TEST(CoordinateSearch, FindsTheBestOfTheValuesAndSaysHowItGotThere) {
  Tuning tuning;
  tuning.settings.policy.settle_s = 0.4;
  tuning.settings.policy.dribble_mps = 2.0;
  tuning.space = {numbers("policy.settle_s", {0.0, 0.1, 0.2, 0.4}), numbers("policy.dribble_mps", {0.2, 0.5, 1.0})};
  coordinate_search(5, play, tuning);
  EXPECT_TRUE(tuning.finished);
  EXPECT_EQ(tuning.settings.policy.settle_s, 0.1);
  EXPECT_EQ(tuning.settings.policy.dribble_mps, 0.5);
  ASSERT_EQ(tuning.steps.size(), 2U);
  EXPECT_EQ(tuning.steps[0].from, Choice{"policy.settle_s = 0.4"});
  EXPECT_NEAR(tuning.steps[0].gain.value, 0.24, 0.005);
  EXPECT_EQ(total_of(tuning.best).on_target, total_of(played(0.0, 7)).on_target);
  EXPECT_EQ(tuning.tried, 1U + 3 + 3 + 3 + 2) << "the start, a round that changes both, one that changes nothing";
}

TEST(CoordinateSearch, LeavesWhatMakesNoDifferenceAsItIs) {
  // Every value is as good as the other, but for chance.
  Tuning tuning;
  std::uint32_t seed = 0;
  const auto by_chance = [&](const std::vector<config::Settings>& settings) {
    std::vector<ArmTally> arms;
    for (std::size_t i = 0; i < settings.size(); ++i) arms.push_back(played(0.0, 11));
    if (seed++ > 0) arms.front()[3].on_target += 1;  // one shot of one match
    return arms;
  };
  tuning.space = {numbers("policy.settle_s", {0.0, 0.1})};
  coordinate_search(3, by_chance, tuning);
  EXPECT_TRUE(tuning.steps.empty());
  EXPECT_EQ(tuning.settings.policy.settle_s, config::Settings{}.policy.settle_s);
}

TEST(CoordinateSearch, KeepsTheBestSoFarWhereItIsStopped) {
  Tuning tuning;
  int left = 2;
  const auto stopped = [&](const std::vector<config::Settings>& settings) {
    if (left-- == 0) throw std::runtime_error{"stop"};
    return play(settings);
  };
  tuning.space = {numbers("policy.settle_s", {0.1, 0.2}), numbers("policy.dribble_mps", {0.5})};
  EXPECT_THROW(coordinate_search(5, stopped, tuning), std::runtime_error);
  EXPECT_FALSE(tuning.finished);
  EXPECT_EQ(tuning.settings.policy.settle_s, 0.1);
  EXPECT_EQ(total_of(tuning.best).on_target, total_of(play({tuning.settings}).front()).on_target);
}

TEST(TunedSpace, HasPlayableValuesOfThePolicysOwnAmongThemTheDefaults) {
  for (const auto policy :
       {kicking::PolicyName::kStopped, kicking::PolicyName::kMoving, kicking::PolicyName::kPredictive}) {
    std::set<std::string> names;
    for (const Coordinate& coordinate : tuned_space(policy)) {
      SCOPED_TRACE(coordinate.name);
      EXPECT_TRUE(names.insert(coordinate.name).second);
      EXPECT_TRUE(coordinate.name.starts_with("policy."));
      std::set<std::map<std::string, std::string>> different;
      for (const Choice& choice : coordinate.choices)
        EXPECT_TRUE(different.insert(config::setting_values(with_choice({}, choice))).second) << choice.front();
      EXPECT_GE(different.size(), 2U);
      const config::Settings defaults;
      EXPECT_EQ(config::setting_values(with_choice(defaults, present_choice(defaults, coordinate))),
                config::setting_values(defaults));
    }
  }
  EXPECT_THROW(tuned_space(kicking::PolicyName::kOracle), std::invalid_argument);
}

TEST(TunedSpace, ReadsSettingsOfTheCommandLine) {
  const auto space = tuned_space(kicking::PolicyName::kMoving);
  EXPECT_EQ(coordinate_of("policy.keep_off_m", space, "setting").choices.size(), 5U);
  EXPECT_EQ(coordinate_of("policy.settle_s=0.1|0.2", space, "setting").choices,
            (std::vector<Choice>{{"policy.settle_s = 0.1"}, {"policy.settle_s = 0.2"}}));
  EXPECT_EQ(coordinate_of("policy.height_law=\"paper\"|\"exact\"", space, "setting").choices.size(), 2U);
  for (const char* refused :
       {"policy.settle_s", "policy.settle=1|2", "goal.y_m=8|9", "policy.settle_s=0.1", "policy.settle_s=0.1|0.1",
        "policy.settle_s=0.1|soon", "policy.settle_s=0.1|99", "policy.test_drive.run_up_m=1|2", ""}) {
    EXPECT_THROW(coordinate_of(refused, space, "setting"), config::BadArgument) << refused;
  }
}

Tuning found() {
  Tuning tuning{.policy = "stopped", .command = "trivela tune stopped"};
  tuning.tuning = {"default.toml", 1001, 40, 100, 5};
  tuning.held_out = {"default.toml", 1002, 40, 100, 5};
  tuning.space = {numbers("policy.settle_s", {0.1, 0.2})};
  tuning.settings.policy.dribble_mps = 0.7;  // of --set
  coordinate_search(3, play, tuning);
  tuning.held_out_played = {played(1.0, 8), played(0.9, 8)};
  return tuning;
}

TEST(TunedSettings, AreAFileThatSaysWhereItComesFromAndReadsBack) {
  const Tuning tuning = found();
  const std::string text = to_settings_file(tuning, "/nowhere/out/tuned.toml");
  for (const char* said :
       {"#   trivela tune stopped\n", "seed 1001", "held out, 40 matches of 100, 5 calibrations, seed 1002",
        "settle_s = 0.1\n", "dribble_mps = 0.7\n", "[policy]\n"}) {
    EXPECT_NE(text.find(said), std::string::npos) << said << text;
  }
  EXPECT_EQ(text.find("aim_tolerance"), std::string::npos) << "neither searched nor changed";
  EXPECT_NE(to_text(tuning).find("gain +2.0 (+2.0 to +2.0) points where"), std::string::npos) << to_text(tuning);
}

TEST(TunedSettings, OfASearchThatWasStoppedSayThatNothingWasHeldOut) {
  Tuning tuning = found();
  tuning.finished = false;
  tuning.held_out_played.clear();
  const std::string text = to_settings_file(tuning, "tuned.toml");
  EXPECT_NE(text.find("# interrupted: the best so far\n"), std::string::npos) << text;
  EXPECT_NE(text.find("# not tried on other matches"), std::string::npos) << text;
}

}  // namespace
}  // namespace trivela::experiment
