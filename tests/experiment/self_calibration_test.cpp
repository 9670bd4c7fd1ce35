// What a robot learns of its kicker in simulated matches, against the simulator's truth, which it never hears.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "experiment/play/play_match.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::experiment {
namespace {

using config::SelfCalibrationMode;

constexpr std::uint32_t kPossessions = 60;

struct Result {
  int kicks = 0, on_target = 0, opportunities = 0;
  std::vector<msg::KickerEstimate> estimates;
  std::vector<msg::KickDecision> decisions;
  double share() const { return static_cast<double>(on_target) / opportunities; }
};

Result play(SelfCalibrationMode mode, const sim::Scenario& scenario, int matches = 1,
            kicking::PolicyName policy = kicking::PolicyName::kPredictive) {
  Arm arm;
  arm.policy = policy;
  arm.settings.self_calibration.mode = mode;
  Result result;
  for (int m = 0; m < matches; ++m) {
    MatchRecord record;
    const PlayedMatch match =
        play_match(scenario, arm, 11, static_cast<std::uint32_t>(m), kPossessions, {.every_cycle = true}, &record);
    for (const PlayedPossession& possession : match.possessions) {
      ++result.opportunities;
      if (!possession.kick) continue;
      ++result.kicks;
      result.on_target += possession.kick->truth == kicking::Outcome::kOnTarget;
    }
    result.estimates.insert(result.estimates.end(), record.estimates.begin(), record.estimates.end());
    result.decisions.insert(result.decisions.end(), record.decisions.begin(), record.decisions.end());
  }
  return result;
}

sim::Scenario faster(double ratio) {
  sim::Scenario scenario;
  scenario.kicker.speed_scale_ratio = ratio;
  return scenario;
}

TEST(SelfCalibration, TheScaleOfAKickerIsFoundInAMatch) {
  const double as_it_is = play(SelfCalibrationMode::kShadow, faster(1.0)).estimates.back().speed_ln;
  for (const double ratio : {0.9, 1.1}) {
    const msg::KickerEstimate last = play(SelfCalibrationMode::kShadow, faster(ratio)).estimates.back();
    EXPECT_GT(last.kicks, 20u);
    EXPECT_NEAR(last.speed_ln - as_it_is, std::log(ratio), 0.02) << ratio;
  }
}

TEST(SelfCalibration, TheDelayOfAKickerIsFoundInAMatch) {
  sim::Scenario late;
  late.kicker.delay_s += 0.08;
  EXPECT_NEAR(play(SelfCalibrationMode::kShadow, late).estimates.back().delay_s, 0.08, 0.02);
}

TEST(SelfCalibration, AShadowChangesNoDecision) {
  const Result off = play(SelfCalibrationMode::kOff, faster(1.1)),
               shadow = play(SelfCalibrationMode::kShadow, faster(1.1));
  EXPECT_TRUE(off.estimates.empty());
  EXPECT_GT(shadow.estimates.size(), 20u);
  ASSERT_EQ(off.decisions.size(), shadow.decisions.size());
  for (std::size_t i = 0; i < off.decisions.size(); ++i) {
    EXPECT_EQ(off.decisions[i].fire, shadow.decisions[i].fire);
    EXPECT_EQ(off.decisions[i].estimate, 0u);
    EXPECT_EQ(shadow.decisions[i].estimate, 0u);
  }
  EXPECT_EQ(off.on_target, shadow.on_target);
}

TEST(SelfCalibration, EveryUpdateIsARowAndLaterDecisionsNameIt) {
  const Result on = play(SelfCalibrationMode::kOn, faster(1.1));
  for (std::size_t i = 0; i < on.estimates.size(); ++i) {
    EXPECT_EQ(on.estimates[i].seq, i + 1);
    EXPECT_EQ(on.estimates[i].kicks, i);
    EXPECT_TRUE(on.estimates[i].used);
    EXPECT_EQ(on.estimates[i].kick_id == 0, i == 0);
  }
  std::map<std::uint32_t, std::int64_t> since;
  for (const msg::KickDecision& decision : on.decisions) {
    ASSERT_GE(decision.estimate, 1u);
    ASSERT_LE(decision.estimate, on.estimates.size());
    EXPECT_GT(decision.t_ns, on.estimates[decision.estimate - 1].t_ns) << "of an earlier cycle";
  }
}

TEST(SelfCalibration, ARobotWhoseKickerIsTenPerCentTooFastPlaysOn) {
  const Result off = play(SelfCalibrationMode::kOff, faster(1.1), 6),
               on = play(SelfCalibrationMode::kOn, faster(1.1), 6);
  EXPECT_LT(off.share(), 0.35);
  EXPECT_GT(on.share(), 0.48);
  const Result off_moving = play(SelfCalibrationMode::kOff, faster(1.1), 6, kicking::PolicyName::kMoving),
               on_moving = play(SelfCalibrationMode::kOn, faster(1.1), 6, kicking::PolicyName::kMoving);
  EXPECT_GT(on_moving.on_target, off_moving.on_target) << "every policy gains";
}

TEST(SelfCalibration, ARobotWithoutAGoalCameraLosesNothing) {
  sim::Scenario blind = faster(1.0);
  blind.flight_camera.dropout_ratio = 1.0;
  const Result off = play(SelfCalibrationMode::kOff, blind, 3), on = play(SelfCalibrationMode::kOn, blind, 3);
  EXPECT_EQ(on.estimates.size(), 3u) << "the first one of each match";
  EXPECT_GT(on.share(), off.share() - 0.05);
}

}  // namespace
}  // namespace trivela::experiment
