#include <gtest/gtest.h>

#include <random>

#include "kicking/geometry/time.hpp"
#include "kicking/outcome/outcome.hpp"
#include "tests/kicking/play.hpp"

namespace trivela::kicking {
namespace {

using tests::play;
using tests::ready_at;
using tests::strict_config;

PolicyOutput once(const PolicyInput& input, const PolicyConfig& config = strict_config()) {
  PolicyMemory memory;
  return evaluate(PolicyName::kMoving, config, {}, {}, input, memory);
}

TEST(MovingPolicy, FiresInMotionWhenTheDeflectedLineMeetsTheTarget) {
  // 1 m/s to the right deflects the ball by 8.62 degrees to the right.
  const PolicyOutput aimed = once(ready_at({0, 3, radians(8.617644)}, {1, 0, 0}));
  EXPECT_EQ(aimed.reason, Reason::kFire);
  EXPECT_NEAR(aimed.alpha_rad, radians(8.617644), 1e-12);
  EXPECT_NEAR(*aimed.offset_right_m, 0.0, 1e-9);
  EXPECT_EQ(once(ready_at({0, 3, 0}, {1, 0, 0})).reason, Reason::kNotAligned);
}

TEST(MovingPolicy, FiresOnEnteringTheExtendedSegmentAndNotInItsMiddle) {
  PolicyMemory memory;
  const auto turning_at = [](double heading_deg, double t_s) {
    PolicyInput input = ready_at({0, 3, radians(heading_deg)}, {0, 0, 1.0});  // beta 0.12 rad: 6.9 degrees
    input.t_ns = nanoseconds(t_s);
    return input;
  };
  const auto reason = [&](const PolicyInput& input) {
    return evaluate(PolicyName::kMoving, strict_config(), {}, {}, input, memory).reason;
  };
  EXPECT_EQ(reason(turning_at(-8.0, 0.00)), Reason::kNotAligned);
  PolicyInput charging = turning_at(-6.5, 0.02);
  charging.kicker_ready = false;
  EXPECT_EQ(reason(charging), Reason::kKickerNotReady);
  EXPECT_EQ(reason(turning_at(-5.0, 0.04)), Reason::kNotAligned);  // too late: it would go left
  EXPECT_EQ(reason(turning_at(5.0, 0.06)), Reason::kNotAligned);   // left the segment
  EXPECT_EQ(reason(turning_at(-6.5, 0.08)), Reason::kFire);
}

TEST(MovingPolicy, FiresLateWhereTheSegmentIsNotExtended) {
  PolicyMemory memory;
  PolicyInput input = ready_at({0, 3, 0});
  input.kicker_ready = false;
  EXPECT_EQ(evaluate(PolicyName::kMoving, strict_config(), {}, {}, input, memory).reason, Reason::kKickerNotReady);
  input.kicker_ready = true;
  EXPECT_EQ(evaluate(PolicyName::kMoving, strict_config(), {}, {}, input, memory).reason, Reason::kFire);
}

TEST(MovingPolicy, TakesTheRobotsSpeedOffTheKick) {
  for (const MotionLaw law : {MotionLaw::kPaper, MotionLaw::kExact}) {
    PolicyConfig config = strict_config();
    config.motion_law = law;
    const PolicyOutput still = once(ready_at({0, 3, 0}), config);
    const PolicyOutput forward = once(ready_at({0, 3, 0}, {0, 1, 0}), config);
    const PolicyOutput backward = once(ready_at({0, 3, 0}, {0, -1, 0}), config);
    EXPECT_NEAR(*still.v_kick_mps, *still.v0_mps, 1e-9);
    EXPECT_LT(*forward.v_kick_mps, *still.v_kick_mps - 0.4);
    EXPECT_GT(*backward.v_kick_mps, *still.v_kick_mps + 0.2);
  }
  PolicyConfig paper = strict_config();
  paper.motion_law = MotionLaw::kPaper;
  const PolicyOutput forward = once(ready_at({0, 3, 0}, {0, 1, 0}), paper);
  EXPECT_NEAR(*forward.v_kick_mps, *forward.v0_mps - 0.70 * std::cos(radians(36.78)), 1e-12);
  const PolicyOutput backward = once(ready_at({0, 3, 0}, {0, -1, 0}), paper);
  EXPECT_NEAR(*backward.v_kick_mps, *backward.v0_mps + 0.35 * std::cos(radians(36.78)), 1e-12);
}

TEST(MovingPolicy, HeightLawsDifferAsDerived) {
  PolicyConfig config = strict_config();
  const auto height = [&](HeightLaw law) {
    config.height_law = law;
    return once(ready_at({0, 3, 0}), config).predicted->z_m;
  };
  const double rise = 5.73 * std::tan(radians(36.78));
  EXPECT_NEAR(height(HeightLaw::kExact), 0.70, 1e-9);
  EXPECT_NEAR(height(HeightLaw::kExtendedRange), 0.11 + 0.59 / (1 + 0.59 / rise), 1e-9);
  EXPECT_NEAR(height(HeightLaw::kPaper), 0.11, 1e-9);
}

TEST(MovingPolicy, NeverKicksBeyondItsRangeNorOverTheBarFromClose) {
  EXPECT_EQ(once(ready_at({0, -5, 0})).reason, Reason::kOutOfRange);
  EXPECT_EQ(once(ready_at({0, 8.5, 0})).reason, Reason::kOutOfRange);
  RobotModel strong;
  strong.table = EffectiveTable{{1, 8.0}, {2, 12.0}};
  PolicyMemory memory;
  EXPECT_EQ(evaluate(PolicyName::kMoving, strict_config(), strong, {}, ready_at({0, 6, 0}), memory).reason,
            Reason::kOutOfRange);
}

TEST(MovingPolicy, KeepsDrivingToTheGoalWhileItTurns) {
  const PolicyOutput output = once(ready_at({0, 3, 0.5}, {0, 1, 0}));
  EXPECT_EQ(output.reason, Reason::kNotAligned);
  EXPECT_GT(output.drive.vy_mps, 0.9);
  EXPECT_LT(output.drive.omega_radps, -1.0);
}

TEST(MovingPolicy, MirrorsLeftAndRight) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const AlphaLaw law : {AlphaLaw::kPaperLine, AlphaLaw::kPhysical}) {
    PolicyConfig config = strict_config();
    config.alpha_law = law;
    for (int i = 0; i < 200; ++i) {
      const Pose pose{3 * unit(random), 3 + 2 * unit(random), unit(random)};
      const Twist twist{unit(random), unit(random), 2 * unit(random)};
      const PolicyOutput a = once(ready_at(pose, twist), config);
      const PolicyOutput b =
          once(ready_at({-pose.x_m, pose.y_m, -pose.heading_rad}, {-twist.vx_mps, twist.vy_mps, -twist.omega_radps}),
               config);
      EXPECT_EQ(a.reason, b.reason);
      EXPECT_NEAR(*a.v_kick_mps, *b.v_kick_mps, 1e-9);
      EXPECT_NEAR(a.drive.omega_radps, -b.drive.omega_radps, 1e-9);
      EXPECT_NEAR(a.left_m, b.right_m, 1e-9);
    }
  }
}

struct Laws {
  MotionLaw motion;
  AlphaLaw alpha;
  double off_centre_m;
};

class MovingLaws : public testing::TestWithParam<Laws> {};

TEST_P(MovingLaws, ScoreInMotionInAWorldWithoutNoise) {
  PolicyConfig config = strict_config();
  config.motion_law = GetParam().motion;
  config.alpha_law = GetParam().alpha;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  double faster_s = 0.0;
  for (int i = 0; i < 30; ++i) {
    const Pose start{3 * unit(random), 3 + 2.5 * unit(random), 1.5 * unit(random)};
    SCOPED_TRACE(testing::Message() << start.x_m << ' ' << start.y_m << ' ' << start.heading_rad);
    const PolicyInput input = ready_at(start, {0.5 * unit(random), 1 + unit(random), unit(random)});
    const auto played = play(PolicyName::kMoving, config, {}, input);
    ASSERT_TRUE(played.fired);
    const auto& crossing = played.fired->predicted;
    ASSERT_TRUE(crossing);
    EXPECT_NEAR(crossing->x_m, 0.0, GetParam().off_centre_m);
    EXPECT_EQ(classify(crossing->x_m, crossing->z_m, {}), Outcome::kOnTarget);
    faster_s += play(PolicyName::kStopped, config, {}, input).seconds - played.seconds;
  }
  EXPECT_GT(faster_s / 30, 0.3);
}

INSTANTIATE_TEST_SUITE_P(AllLaws, MovingLaws,
                         testing::Values(Laws{MotionLaw::kExact, AlphaLaw::kPaperLine, 0.6},
                                         Laws{MotionLaw::kExact, AlphaLaw::kPhysical, 0.25},
                                         Laws{MotionLaw::kPaper, AlphaLaw::kPaperLine, 0.6},
                                         Laws{MotionLaw::kPaper, AlphaLaw::kPhysical, 0.25}));

}  // namespace
}  // namespace trivela::kicking
