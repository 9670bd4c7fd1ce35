#include <gtest/gtest.h>

#include <random>

#include "kicking/outcome/outcome.hpp"
#include "tests/kicking/play.hpp"

namespace trivela::kicking {
namespace {

using tests::play;
using tests::ready_at;

const PolicyConfig kStrict = tests::strict_config();

/// Judges the same input over and over, 20 ms apart; the reason of the last cycle.
Reason after(PolicyInput input, double seconds, PolicyMemory& memory) {
  Reason reason = Reason::kFire;
  for (int i = 0; i <= std::lround(seconds / 0.02); ++i) {
    reason = evaluate(PolicyName::kStopped, kStrict, {}, {}, input, memory).reason;
    input.t_ns += 20'000'000;
  }
  return reason;
}

TEST(StoppedPolicy, BrakesBeforeItTurns) {
  PolicyMemory memory;
  const PolicyOutput output = evaluate(PolicyName::kStopped, kStrict, {}, {}, ready_at({0, 4, 0.5}, {0, 1, 0}), memory);
  EXPECT_EQ(output.reason, Reason::kApproaching);
  EXPECT_EQ(output.drive.vy_mps, 0.0);
  EXPECT_EQ(output.drive.omega_radps, 0.0);
}

TEST(StoppedPolicy, TurnsOnTheSpotTowardsTheTarget) {
  PolicyMemory memory;
  const PolicyOutput output = evaluate(PolicyName::kStopped, kStrict, {}, {}, ready_at({0, 4, 0.5}), memory);
  EXPECT_EQ(output.reason, Reason::kTurning);
  EXPECT_EQ(output.drive.vy_mps, 0.0);
  EXPECT_LT(output.drive.omega_radps, 0.0);
}

TEST(StoppedPolicy, SettlesAQuarterOfASecondBeforeItFires) {
  PolicyMemory memory;
  EXPECT_EQ(after(ready_at({0, 4, 0}), 0.22, memory), Reason::kSettling);
  PolicyMemory another;
  EXPECT_EQ(after(ready_at({0, 4, 0}), 0.26, another), Reason::kFire);
}

TEST(StoppedPolicy, StartsSettlingAnewWhenItLosesTheTarget) {
  PolicyMemory memory;
  PolicyInput input = ready_at({0, 4, 0});
  EXPECT_EQ(after(input, 0.2, memory), Reason::kSettling);
  input.t_ns = 220'000'000;
  input.pose.heading_rad = radians(3.0);
  EXPECT_EQ(after(input, 0.0, memory), Reason::kTurning);
  input.t_ns = 240'000'000;
  input.pose.heading_rad = 0.0;
  EXPECT_EQ(after(input, 0.2, memory), Reason::kSettling);
}

TEST(StoppedPolicy, DoesNotFireOutsideTheToleranceHoweverLongItSettles) {
  PolicyMemory memory;
  EXPECT_EQ(after(ready_at({0, 4, 0}), 0.2, memory), Reason::kSettling);
  PolicyInput input = ready_at({0, 4, radians(1.5)});
  input.t_ns = 220'000'000;
  EXPECT_EQ(after(input, 0.2, memory), Reason::kSettling);
}

TEST(StoppedPolicy, DrivesTowardsATargetOutOfRangeAndGivesUpWhereItMayNotGo) {
  PolicyMemory memory;
  const PolicyOutput far = evaluate(PolicyName::kStopped, kStrict, {}, {}, ready_at({0, -5, 0}), memory);
  EXPECT_EQ(far.reason, Reason::kApproaching);
  EXPECT_GT(far.drive.vy_mps, 0.5);
  RobotModel weak;
  weak.table = EffectiveTable{{1, 1.0}, {2, 2.0}};
  const PolicyOutput hopeless = evaluate(PolicyName::kStopped, kStrict, weak, {}, ready_at({0, 7, 0}), memory);
  EXPECT_EQ(hopeless.reason, Reason::kOutOfRange);
  EXPECT_EQ(hopeless.drive.vy_mps, 0.0);
}

TEST(StoppedPolicy, ScoresFromAnywhereInAWorldWithoutNoise) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 30; ++i) {
    const Pose start{3 * unit(random), 3 + 3 * unit(random) - (i % 5 ? 0 : 5), 3 * unit(random)};
    SCOPED_TRACE(testing::Message() << start.x_m << ' ' << start.y_m << ' ' << start.heading_rad);
    const auto played =
        play(PolicyName::kStopped, kStrict, {}, ready_at(start, {unit(random), unit(random), unit(random)}));
    ASSERT_TRUE(played.fired);
    const auto& crossing = played.fired->predicted;
    ASSERT_TRUE(crossing);
    EXPECT_NEAR(crossing->x_m, 0.0, 0.25);
    EXPECT_EQ(classify(crossing->x_m, crossing->z_m, {}), Outcome::kOnTarget);
    EXPECT_LE(std::hypot(played.at.twist.vx_mps, played.at.twist.vy_mps), 0.3);
  }
}

TEST(StoppedPolicy, WithItsDefaultsFiresAtRestWithinItsToleranceWithoutWaiting) {
  PolicyMemory memory;
  const auto reason = [&](double heading_deg, const Twist& twist) {
    memory = {};
    return evaluate(PolicyName::kStopped, {}, {}, {}, ready_at({0, 4, radians(heading_deg)}, twist), memory).reason;
  };
  EXPECT_EQ(reason(4.9, {}), Reason::kFire);
  EXPECT_EQ(reason(-4.9, {0, 0.29, 0.49}), Reason::kFire);
  EXPECT_EQ(reason(5.1, {}), Reason::kTurning);
  EXPECT_EQ(reason(0.0, {0, 0.31, 0}), Reason::kApproaching) << "it still stops";
  EXPECT_EQ(reason(0.0, {0, 0, 0.51}), Reason::kTurning);
}

}  // namespace
}  // namespace trivela::kicking
