#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kicking/policy/predictive/lookahead_search.hpp"
#include "tests/kicking/play.hpp"

namespace trivela::kicking {
namespace {

using tests::play;
using tests::ready_at;

constexpr PolicyName kPredictive = PolicyName::kPredictive;

PolicyOutput once(const PolicyInput& input, const PolicyConfig& config = {}, const RobotModel& robot = {}) {
  PolicyMemory memory;
  return evaluate(kPredictive, config, robot, {}, input, memory);
}

const PredictiveMemory& own(const PolicyMemory& memory) { return memory.as<PredictiveMemory>(); }

/// A cycle of a robot that knows its opponent exactly.
PolicyInput threatened(const Pose& pose, const Twist& twist, double opponent_m, double closing_mps) {
  PolicyInput input = ready_at(pose, twist);
  input.opponent_distance_m = opponent_m;
  input.opponent_closing_mps = closing_mps;
  return input;
}

TEST(PredictivePolicy, FiresAtOnceWhereNothingGetsBetter) {
  const PolicyOutput output = once(ready_at({0, 4, 0}, {0, 1.2, 0}));
  EXPECT_TRUE(output.fire);
  ASSERT_TRUE(output.p_on_target);
  EXPECT_GT(*output.p_on_target, 0.9);
  ASSERT_TRUE(output.predicted);
  EXPECT_NEAR(output.predicted->x_m, 0.0, 0.05);
}

TEST(PredictivePolicy, AimsBelowTheFixedHeightAndAboveTheFloor) {
  for (const double y : {0.5, 2.0, 4.0, 5.5}) {
    const PolicyOutput output = once(ready_at({0, y, 0}));
    ASSERT_TRUE(output.predicted) << y;
    EXPECT_NEAR(output.predicted->z_m, output.target_z_m, 0.03) << y;
    EXPECT_GT(output.target_z_m, 0.15) << y;
    EXPECT_LT(output.target_z_m, 0.6) << y;
  }
}

TEST(PredictivePolicy, PowerIsTheBestOverASweep) {
  const RobotModel robot;
  const Goal goal;
  const PolicyConfig config;
  const StateSpread state{config.predictive.position_sd_m, config.predictive.heading_sd_rad,
                          config.predictive.speed_sd_mps, config.predictive.turn_rate_sd_radps};
  for (const double y : {1.0, 2.5, 4.0}) {
    const ReleaseState release{{0.3, y}, direction(-0.02), {0.2, 0.8}, 0.4};
    ShotGuess guess;
    guess.exit_angle = Elevation(robot.exit_angle_rad);
    const ShotModel model(config, robot, goal, state);
    model.chance(release, guess);  // finds the spread that the height is chosen for
    const ShotChance best = model.chance(release, guess);
    for (double power = 15.0; power <= 50.0; power += 0.5) {
      const KickExit exit{robot.table.speed_for(power), guess.exit_angle};
      const CrossingSpread crossing = crossing_spread(release, exit, robot, state, Goal{}.y_m);
      EXPECT_LE(p_on_target(crossing, config.predictive.bounce_ratio, {}), best.p + 0.005) << y << ' ' << power;
    }
  }
}

TEST(PredictivePolicy, WaitsWhileTurningOntoTheGoalGetsBetter) {
  const PolicyOutput output = once(threatened({0, 3, 0.45}, {0, 0, -1.5}, 4.0, 1.0));
  EXPECT_FALSE(output.fire);
  EXPECT_EQ(output.reason, Reason::kWaiting);
  EXPECT_LT(output.drive.omega_radps, 0.0);
}

TEST(PredictivePolicy, FiresAPoorShotWhereTheBallWouldBeLost) {
  // Aimed at the post; the opponent is there in 20 ms, and would not be for seconds.
  const Pose pose{0, 3, 0.15};
  const PolicyOutput lost = once(threatened(pose, {}, 0.52, 1.0));
  EXPECT_TRUE(lost.fire);
  EXPECT_LT(*lost.p_on_target, 0.8);
  const PolicyOutput safe = once(threatened(pose, {}, 4.0, 1.0));
  EXPECT_EQ(safe.reason, Reason::kWaiting);
}

TEST(PredictivePolicy, NeverFiresBelowItsThreshold) {
  PolicyConfig config;
  for (const double threshold : {0.3, 0.6, 0.9, 0.99}) {
    config.predictive.threshold = threshold;
    for (double heading = -1.0; heading <= 1.0; heading += 0.05) {
      for (const double opponent : {0.55, 0.8, 3.0}) {
        const PolicyOutput output = once(threatened({1.0, 2.0, heading}, {0.3, 0.8, -1.0}, opponent, 1.4), config);
        if (!output.fire) continue;
        EXPECT_GE(*output.p_on_target, threshold);
      }
    }
  }
  config.predictive.threshold = 0.999;
  EXPECT_EQ(once(threatened({0, 3, 0.3}, {}, 0.6, 1.0), config).reason, Reason::kUnlikely);
}

TEST(PredictivePolicy, SchedulesTheReleaseWithinTheCycle) {
  bool inside = false;
  for (double heading = -0.8; heading <= 0.8; heading += 0.004) {
    const PolicyOutput output = once(threatened({0, 3.0, heading}, {0, 1.0, 2.5}, 1.2, 1.5));
    EXPECT_GE(output.fire_after_s, 0.0);
    EXPECT_LT(output.fire_after_s, PolicyConfig{}.cycle_s);
    inside = inside || (output.fire && output.fire_after_s > 0.001 && output.fire_after_s < 0.019);
  }
  EXPECT_TRUE(inside);
}

TEST(PredictivePolicy, KicksFromAnywhereAndHitsByItsOwnModel) {
  for (const double x : {-2.0, 0.0, 2.5}) {
    for (const double heading : {-2.5, -1.0, 0.0, 0.7, 3.0}) {
      const auto played = play(kPredictive, {}, {}, ready_at({x, 2.0, heading}, {0.3, 0.5, 0.0}));
      ASSERT_TRUE(played.fired) << x << ' ' << heading;
      EXPECT_LT(played.seconds, 3.0);
      EXPECT_LT(std::abs(played.fired->predicted->x_m), 0.89);
      EXPECT_GT(*played.fired->p_on_target, 0.8);
    }
  }
}

TEST(PredictivePolicy, IsFasterThanMoving) {
  for (const double heading : {0.8, 1.5, 2.5}) {
    const PolicyInput start = ready_at({0.5, 3.0, heading}, {0.0, 0.8, 0.0});
    PolicyInput hurried = start;
    hurried.opponent_distance_m = 2.5;
    EXPECT_LT(play(kPredictive, {}, {}, hurried).seconds, play(PolicyName::kMoving, {}, {}, start).seconds);
  }
}

TEST(PredictivePolicy, MirroredInputGivesTheMirroredDecision) {
  for (double heading = -3.0; heading <= 3.0; heading += 0.13) {
    const PolicyOutput a = once(threatened({1.2, 2.0, heading}, {0.5, 0.9, -1.2}, 1.3, 1.5));
    const PolicyOutput b = once(threatened({-1.2, 2.0, -heading}, {-0.5, 0.9, 1.2}, 1.3, 1.5));
    EXPECT_EQ(a.fire, b.fire) << heading;
    EXPECT_EQ(a.reason, b.reason) << heading;
    EXPECT_NEAR(a.fire_after_s, b.fire_after_s, 1e-9);
    EXPECT_NEAR(a.p_on_target.value_or(0), b.p_on_target.value_or(0), 1e-9);
    EXPECT_NEAR(a.drive.vx_mps, -b.drive.vx_mps, 1e-9);
    EXPECT_NEAR(a.drive.vy_mps, b.drive.vy_mps, 1e-9);
    EXPECT_NEAR(a.drive.omega_radps, -b.drive.omega_radps, 1e-9);
  }
}

TEST(PredictivePolicy, HoldsUnderEveryHindrance) {
  const PolicyInput good = ready_at({0, 4, 0}, {0, 1.2, 0});
  ASSERT_TRUE(once(good).fire);
  PolicyInput input = good;
  input.playing = false;
  EXPECT_EQ(once(input).reason, Reason::kNotPlaying);
  input = good;
  input.possession = false;
  EXPECT_EQ(once(input).reason, Reason::kNoBall);
  input = good;
  input.kicker_ready = false;
  EXPECT_EQ(once(input).reason, Reason::kKickerNotReady);
  input = good;
  input.state_age_s = 0.2;
  EXPECT_EQ(once(input).reason, Reason::kStaleState);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (double Pose::*field : {&Pose::x_m, &Pose::y_m, &Pose::heading_rad}) {
      input = good;
      input.pose.*field = bad;
      EXPECT_EQ(once(input).reason, Reason::kStaleState);
    }
    input = good;
    input.twist.omega_radps = bad;
    EXPECT_EQ(once(input).reason, Reason::kStaleState);
    input = good;
    input.opponent_distance_m = bad;
    EXPECT_TRUE(std::isfinite(once(input).drive.omega_radps));
    input = good;
    input.sd_position_m = bad;
    EXPECT_EQ(once(input).reason, Reason::kStaleState);
  }
}

TEST(PredictivePolicy, OutOfRangeIsWhereFullPowerFallsShort) {
  const PolicyOutput far = once(ready_at({0, -6.0, 0}));
  EXPECT_FALSE(far.fire);
  EXPECT_EQ(far.reason, Reason::kOutOfRange);
  EXPECT_GT(far.drive.vy_mps, 0.5);
}

TEST(PredictivePolicy, DrivesOnAsReckonedUntilTheBallHasLeft) {
  PolicyMemory memory;
  PolicyInput input = threatened({0, 3, 0.25}, {0, 0.8, -2.5}, 0.9, 2.0);
  bool fired = false;
  for (int i = 0; i < 20 && !fired; ++i) {
    fired = evaluate(kPredictive, {}, {}, {}, input, memory).fire;
    input.t_ns += 20'000'000;
  }
  ASSERT_TRUE(fired);
  const DrivePlan plan = own(memory).way.plan;
  const PolicyOutput pending = evaluate(kPredictive, {}, {}, {}, input, memory);
  EXPECT_FALSE(pending.fire);
  EXPECT_EQ(pending.reason, Reason::kOrderPending);
  EXPECT_EQ(own(memory).way.plan, plan);
}

TEST(LearnedPolicy, WithAnEmptyModelDecidesByThePhysicalProbability) {
  PolicyConfig config;
  config.learned.emplace();
  PolicyMemory memory;
  const PolicyInput input = ready_at({0, 3, 0.05});
  const PolicyOutput learned = evaluate(PolicyName::kLearned, config, {}, {}, input, memory);
  const PolicyOutput physical = once(input);
  EXPECT_EQ(learned.fire, physical.fire);
  EXPECT_EQ(*learned.p_on_target, *physical.p_on_target);
}

PolicyOutput learned_once(const LearnedDecision& decision, const PolicyInput& input) {
  PolicyConfig config;
  config.learned.emplace().decision = decision;
  PolicyMemory memory;
  return evaluate(PolicyName::kLearned, config, {}, {}, input, memory);
}

TEST(LearnedPolicy, WaitsWhereItsWeightsMakeWaitingWorthMore) {
  const PolicyInput input = threatened({0, 3, 0.05}, {0, 0.8, -0.5}, 3.0, 1.0);
  LearnedDecision patient, hasty;
  patient.fire_weights[0] = -2.0;
  hasty.fire_weights[0] = 2.0;
  EXPECT_EQ(learned_once(patient, input).reason, Reason::kWaiting);
  EXPECT_TRUE(learned_once(hasty, input).fire);
}

TEST(LearnedPolicy, TurnsTheSignOfItsWeightsWithTheirFeatures) {
  const PolicyInput slow = threatened({0, 3, 0.05}, {0, 0.8, 0.0}, 3.0, 1.0);
  const PolicyInput fast = threatened({0, 3, 0.05}, {0, 0.8, -1.5}, 3.0, 1.0);
  LearnedDecision decision;
  decision.fire_weights[0] = 1.0;
  decision.fire_weights[2] = -5.0;  // a turning robot waits
  EXPECT_TRUE(learned_once(decision, slow).fire);
  EXPECT_FALSE(learned_once(decision, fast).fire);
}

TEST(LearnedPolicy, DrivesByTheStyleThatPromisesMore) {
  LearnedDecision decision;
  decision.styles = 2;
  decision.style[0] = {.speed_ratio = 0.0};
  decision.style[1] = {.speed_ratio = 1.5};
  PolicyConfig config;
  config.learned.emplace().decision = decision;
  PolicyMemory memory;
  PolicyInput input = threatened({0, -3.5, 0.0}, {0, 0.5, 0}, 8.0, 0.1);  // full power falls short from here
  double fastest_mps = 0.0;
  for (int i = 0; i < 10; ++i) {
    fastest_mps = std::max(fastest_mps, evaluate(PolicyName::kLearned, config, {}, {}, input, memory).drive.vy_mps);
    input.t_ns += 20'000'000;
  }
  EXPECT_NEAR(fastest_mps, 1.8, 1e-9);
  EXPECT_EQ(own(memory).way.style, 1u);
}

TEST(LearnedPolicy, KeepsTheLimitsOfTheRobotWithTheBall) {
  const PolicyConfig config;
  for (const double side : {0.5, 3.0, 10.0}) {
    for (const double speed : {-1.0, 0.4, 2.0}) {
      LearnedDecision decision;
      decision.style[0] = {.speed_ratio = speed, .side_ratio = side, .brake_ratio = 4.0, .aim_ratio = 0.9};
      for (const double heading : {-2.5, -0.7, 0.1, 1.3, 3.0}) {
        const Twist drive = learned_once(decision, ready_at({1, 2, heading}, {0.5, 1.0, 1.0})).drive;
        EXPECT_LE(std::abs(drive.vx_mps), config.max_sideways_mps);
        EXPECT_LE(drive.vy_mps, config.max_forward_mps);
        EXPECT_GE(drive.vy_mps, -config.max_sideways_mps);
        EXPECT_LE(std::abs(drive.omega_radps), config.max_turn_rate_radps);
      }
    }
  }
}

}  // namespace
}  // namespace trivela::kicking
