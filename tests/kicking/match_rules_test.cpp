#include "kicking/policy/match_rules.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "kicking/policy/shot.hpp"
#include "tests/kicking/play.hpp"

namespace trivela::kicking {
namespace {

using tests::play;
using tests::ready_at;

constexpr double kBrake_mps2 = 2.5;

DribbleLimit reach_of_three_metres(const Eigen::Vector2d& taken_m = {0, 0}) {
  return {3.0 - 0.3 - 0.27, kBrake_mps2, taken_m};
}

TEST(DribbleLimit, LeavesACommandAloneWhereNothingIsForbidden) {
  const Twist command{0.3, 2.0, 1.0};
  EXPECT_EQ(DribbleLimit{}.keep(command, {50, 50}, {0, 1}).vy_mps, 2.0);
}

TEST(DribbleLimit, LetsARobotGoAsFastAsItCanStillBrake) {
  // 3 m less the margin and the ball's distance from the centre are 2.43 m, of which 0.43 m are left.
  const Twist kept = reach_of_three_metres().keep({0, 2.0, 0.5}, {0, 2.0}, {0, 1});
  EXPECT_NEAR(kept.vy_mps, std::sqrt(2 * kBrake_mps2 * 0.43), 1e-12);
  EXPECT_NEAR(kept.vx_mps, 0.0, 1e-12);
  EXPECT_EQ(kept.omega_radps, 0.5);
}

TEST(DribbleLimit, ForbidsOnlyWhatLeadsAway) {
  const DribbleLimit reach = reach_of_three_metres();
  // At the edge, facing along it, then facing back.
  const Twist along = reach.keep({0, 1.5, 0}, {2.43, 0}, {0, 1});
  EXPECT_NEAR(along.vy_mps, 1.5, 1e-12);
  const Twist back = reach.keep({0, 1.5, 0}, {2.43, 0}, {-1, 0});
  EXPECT_NEAR(back.vy_mps, 1.5, 1e-12);
  const Twist out = reach.keep({0, 1.5, 0}, {2.5, 0}, {1, 0});
  EXPECT_NEAR(out.vy_mps, 0.0, 1e-12);
}

TEST(DribbleLimit, NeverLeavesAVelocityThatCannotBeBrakedInTime) {
  const DribbleLimit reach = reach_of_three_metres({0.4, -0.2});
  for (double place_rad = 0.0; place_rad < 6.3; place_rad += 0.7)
    for (double heading_rad = 0.0; heading_rad < 6.3; heading_rad += 0.9)
      for (double carried_m : {0.01, 0.8, 1.9, 2.4, 2.43, 3.2}) {
        const Eigen::Vector2d outward(std::cos(place_rad), std::sin(place_rad));
        const Eigen::Vector2d forward(-std::sin(heading_rad), std::cos(heading_rad));
        const Twist kept = reach.keep({0.5, 2.2, 0.1}, Eigen::Vector2d(0.4, -0.2) + carried_m * outward, forward);
        const Eigen::Vector2d right(forward.y(), -forward.x());
        const double out_mps = (kept.vx_mps * right + kept.vy_mps * forward).dot(outward);
        EXPECT_LE(out_mps * out_mps * (out_mps > 0), 2 * kBrake_mps2 * std::max(0.0, 2.43 - carried_m) + 1e-9);
      }
}

class RuledPolicy : public testing::TestWithParam<PolicyName> {};

TEST_P(RuledPolicy, HoldsInItsOwnHalfAndSaysSo) {
  PolicyConfig config = tests::strict_config();
  config.rules.opponents_half_only = true;
  PolicyMemory memory;
  const RobotModel robot;
  // The ball lies 0.27 m before the robot: 0.2 m beyond the line is less than the margin.
  PolicyOutput output = evaluate(GetParam(), config, robot, {}, ready_at({0, -0.07, 0}), memory);
  EXPECT_FALSE(output.fire);
  EXPECT_EQ(output.reason, Reason::kOwnHalf);
  EXPECT_STREQ(name(output.reason), "own_half");
  output = evaluate(GetParam(), config, robot, {}, ready_at({0, 3, 0}), memory);
  EXPECT_NE(output.reason, Reason::kOwnHalf);
}

TEST_P(RuledPolicy, KicksFromTheOpponentsHalfAsWithoutTheRule) {
  PolicyConfig ruled = tests::strict_config();
  ruled.rules.opponents_half_only = true;
  const auto with = play(GetParam(), ruled, {}, ready_at({0.5, 3.5, 0.4}, {0.2, 1.0, 0}));
  const auto without = play(GetParam(), tests::strict_config(), {}, ready_at({0.5, 3.5, 0.4}, {0.2, 1.0, 0}));
  ASSERT_TRUE(with.fired);
  ASSERT_TRUE(without.fired);
  EXPECT_EQ(with.seconds, without.seconds);
  EXPECT_EQ(with.fired->power, without.fired->power);
}

TEST_P(RuledPolicy, CarriesTheBallNoFartherThanTheLimitWhereverItTurns) {
  PolicyConfig config;
  config.rules.carry_limit_m = 3.0;
  config.carry_margin_m = 0.05;
  const RobotModel robot;
  for (const double heading_rad : {0.0, 1.2, -2.4, 3.1}) {
    PolicyMemory memory;
    PolicyInput input = ready_at({2.0, -4.0, heading_rad}, {0.0, 1.0, 0.0});
    input.kicker_ready = false;  // so that it drives on for as long as it may
    const Eigen::Vector2d taken = held_ball(input.pose, robot);
    double farthest_m = 0.0;
    for (int cycle = 0; cycle < 400; ++cycle) {
      input.twist = evaluate(GetParam(), config, robot, {}, input, memory).drive;
      input.pose = advance(input.pose, input.twist, config.cycle_s);
      input.t_ns += 20'000'000;
      farthest_m = std::max(farthest_m, (held_ball(input.pose, robot) - taken).norm());
    }
    EXPECT_LE(farthest_m, 3.0) << "heading " << heading_rad;
  }
}

TEST_P(RuledPolicy, HasANewReachWithANewPossession) {
  PolicyConfig config;
  config.rules.carry_limit_m = 1.0;
  PolicyMemory memory;
  PolicyInput input = ready_at({0.0, -6.0, 0.0}, {0.0, 1.0, 0.0});
  input.kicker_ready = false;
  const auto drive = [&] { return evaluate(GetParam(), config, {}, {}, input, memory).drive; };
  drive();
  input.pose.y_m += 2.0;
  EXPECT_NEAR(std::hypot(drive().vx_mps, drive().vy_mps), 0.0, 1e-9);
  input.possession_id = 2;
  EXPECT_GT(std::hypot(drive().vx_mps, drive().vy_mps), 0.3);
}

/// Plays a set piece of which so much is left at the beginning; none: no rule.
tests::Played set_piece(std::optional<double> left_s, const PolicyInput& from, std::vector<Reason>* reasons = nullptr) {
  const PolicyConfig config;
  PolicyMemory memory;
  tests::Played played;
  PolicyInput input = from;
  for (; played.seconds < 3.0; played.seconds += config.cycle_s) {
    if (left_s && *left_s > played.seconds) {
      input.set_piece_left_s = *left_s - played.seconds;
    } else {
      input.set_piece_left_s = std::nullopt;
    }
    const PolicyOutput output = evaluate(PolicyName::kPredictive, config, {}, {}, input, memory);
    if (reasons != nullptr) reasons->push_back(output.reason);
    if (output.fire) {
      played.fired = output;
      return played;
    }
    input.twist = output.drive;
    input.pose = advance(input.pose, input.twist, config.cycle_s);
    input.t_ns += 20'000'000;
  }
  return played;
}

TEST(SetPiece, IsTakenBeforeItsTimeIsOverWhereThePlanWouldWaitForABetterMoment) {
  const PolicyInput from = ready_at({1.5, 4.0, 0.8});
  const RobotModel robot;
  std::vector<Reason> reasons;
  const auto free = set_piece({}, from, &reasons);
  ASSERT_TRUE(free.fired);
  ASSERT_GT(free.seconds, 0.06);
  EXPECT_EQ(reasons.front(), Reason::kWaiting);
  const double left_s = free.seconds - 0.04 + robot.delay_s;
  const auto hurried = set_piece(left_s, from);
  ASSERT_TRUE(hurried.fired);
  EXPECT_LE(hurried.seconds + hurried.fired->fire_after_s + robot.delay_s, left_s + 1e-9);
  EXPECT_GE(*hurried.fired->p_on_target, PolicyConfig{}.predictive.threshold);
  EXPECT_LT(*hurried.fired->p_on_target, *free.fired->p_on_target);
}

TEST(SetPiece, OfWhichMoreIsLeftThanAPlanLooksAheadChangesNothing) {
  const PolicyInput from = ready_at({1.5, 4.0, 0.5});
  const auto free = set_piece({}, from), easy = set_piece(6.0, from);
  ASSERT_TRUE(free.fired && easy.fired);
  EXPECT_EQ(free.seconds, easy.seconds);
  EXPECT_EQ(free.fired->power, easy.fired->power);
}

TEST(SetPiece, ThatCannotBeTakenInTimeIsHeldAndPlayedOnAfterwards) {
  const PolicyInput from = ready_at({1.5, 4.0, 2.5});  // it faces away
  std::vector<Reason> reasons;
  const auto late = set_piece(0.2, from, &reasons), free = set_piece({}, from);
  ASSERT_TRUE(late.fired && free.fired);
  EXPECT_EQ(reasons.front(), Reason::kUnlikely) << "and no `waiting` for what comes too late";
  EXPECT_GT(late.seconds, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Policies, RuledPolicy,
                         testing::Values(PolicyName::kStopped, PolicyName::kMoving, PolicyName::kPredictive),
                         [](const auto& policy) { return std::string(name(policy.param)); });

}  // namespace
}  // namespace trivela::kicking
