#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "kicking/alignment/alignment.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/policy/shot.hpp"
#include "tests/kicking/play.hpp"

namespace trivela::kicking {
namespace {

using ::testing::ElementsAre;
using tests::play;
using tests::Played;
using tests::ready_at;

const Goal kGoal{};

/// One possession after another with one memory, as a drive has them.
class Drill {
 public:
  Drill(PolicyName policy, PolicyConfig config, RobotModel robot = {})
      : policy_(policy), config_(std::move(config)), robot_(std::move(robot)) {}

  /// Each possession from this pose on; the robot stands there.
  Played possession(const Pose& start, double limit_s = 12.0) {
    PolicyInput input = ready_at(start);
    input.possession_id = ++possessions_;
    input.t_ns = std::int64_t{20'000'000'000} * possessions_;
    input.last_kick = seen_;
    return play(policy_, config_, robot_, input, memory_, limit_s);
  }

  /// What is seen of the kick of the possession played last.
  void see(std::optional<double> x_cross_m) { seen_ = SeenKick{possessions_, possessions_, x_cross_m}; }

  const PolicyMemory& memory() const { return memory_; }

 private:
  PolicyName policy_;
  PolicyConfig config_;
  RobotModel robot_;
  PolicyMemory memory_;
  std::uint32_t possessions_ = 0;
  std::optional<SeenKick> seen_;
};

TEST(StandingDrive, KicksEachSetPointAsOftenAsAskedAndThenNoMore) {
  PolicyConfig config;
  config.test_drive.powers = {15.0, 30.5, 50.0};
  config.test_drive.kicks_per_level = 2;
  Drill drill{PolicyName::kStandingDrive, config};
  std::vector<double> powers;
  for (int i = 0; i < 6; ++i) {
    const Played played = drill.possession({0.3, -4.0, 0.1});
    ASSERT_TRUE(played.fired);
    EXPECT_EQ(played.fired->drive.vy_mps, 0.0);
    EXPECT_EQ(played.fired->drive.omega_radps, 0.0);
    powers.push_back(*played.fired->power);
  }
  EXPECT_THAT(powers, ElementsAre(15.0, 15.0, 30.5, 30.5, 50.0, 50.0));
  EXPECT_FALSE(drill.possession({0.0, 0.0, 0.0}).fired);
}

TEST(StandingDrive, WaitsUntilItHasBeenAtRestForAWhile) {
  PolicyMemory memory;
  const auto reason = [&](double seconds, const Twist& twist) {
    PolicyInput input = ready_at({0, 0, 0}, twist);
    input.t_ns = nanoseconds(seconds);
    return evaluate(PolicyName::kStandingDrive, {}, {}, {}, input, memory).reason;
  };
  EXPECT_EQ(reason(0.0, {0.0, 1.0, 0.0}), Reason::kApproaching);
  EXPECT_EQ(reason(0.1, {}), Reason::kSettling);
  EXPECT_EQ(reason(0.2, {0.0, 0.0, 0.5}), Reason::kApproaching);
  EXPECT_EQ(reason(0.3, {}), Reason::kSettling);
  EXPECT_EQ(reason(0.54, {}), Reason::kSettling);
  EXPECT_EQ(reason(0.56, {}), Reason::kFire);
}

TEST(StandingDrive, AsksNothingOfTheTable) {
  RobotModel weak;
  weak.table = EffectiveTable{{1, 1.0}, {2, 2.0}};
  EXPECT_EQ(Drill(PolicyName::kStandingDrive, {}, weak).possession({0, -8, 0}).fired->power, 15.0);
}

/// Kicks of a pass drive from anywhere, with what they must all have.
void expect_passes(PolicyName policy, const std::vector<double>& velocities, auto&& expect) {
  PolicyConfig config;
  config.test_drive.kicks_per_level = 3;
  config.test_drive.distance_m = config.test_drive.straight_distance_m = 5.0;
  config.target_x_m = 0.4;
  Drill drill{policy, config};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const double velocity : velocities) {
    for (int i = 0; i < 3; ++i) {
      SCOPED_TRACE(testing::Message() << velocity << " m/s, kick " << i);
      const Played played = drill.possession({3.0 * unit(random), 3.0 + 3.0 * unit(random), 3.0 * unit(random)}, 20.0);
      ASSERT_TRUE(played.fired);
      EXPECT_NEAR(played.at.pose.heading_rad, 0.0, radians(1.0));
      EXPECT_NEAR(played.at.twist.omega_radps, 0.0, 0.05);
      expect(velocity, played);
      // The power is that of a standing robot.
      const Shot standing = drive_shot(config, {}, kGoal, played.at);
      EXPECT_EQ(played.fired->power, standing.power);
      EXPECT_EQ(played.fired->reason, Reason::kFire);
    }
  }
  EXPECT_FALSE(drill.possession({0, 3, 0}, 20.0).fired);
}

TEST(LateralDrive, PassesTheMiddleSidewaysAtEachVelocityFacingTheGoal) {
  expect_passes(PolicyName::kLateralDrive, PolicyConfig{}.test_drive.lateral_mps, [](double velocity, const Played& p) {
    EXPECT_NEAR(p.at.twist.vx_mps, velocity, 0.02);
    EXPECT_NEAR(p.at.twist.vy_mps, 0.0, 0.02);
    const double passed_m = std::copysign(1.0, velocity) * (p.at.pose.x_m - 0.4);
    EXPECT_GE(passed_m, 0.0);
    EXPECT_LE(passed_m, 0.02 * std::abs(velocity) + 1e-9) << "the first cycle beyond";
    EXPECT_NEAR(p.at.pose.y_m, 4.0, 0.2);
  });
}

TEST(StraightDrive, PassesItsPlaceAtEachVelocityForwardsAndBackwards) {
  expect_passes(PolicyName::kStraightDrive, PolicyConfig{}.test_drive.straight_mps,
                [](double velocity, const Played& p) {
                  EXPECT_NEAR(p.at.twist.vy_mps, velocity, 0.02);
                  EXPECT_NEAR(p.at.twist.vx_mps, 0.0, 0.02);
                  EXPECT_NEAR(p.at.pose.x_m, 0.4, 0.2);
                  EXPECT_NEAR(p.at.pose.y_m, 4.0, 0.2);
                  if (velocity == 0.0) return;  // it stands there
                  const double passed_m = std::copysign(1.0, velocity) * (p.at.pose.y_m - 4.0);
                  EXPECT_GE(passed_m, 0.0);
                  EXPECT_LE(passed_m, 0.02 * std::abs(velocity) + 1e-9);
                });
}

TEST(PassDrive, AimsAtAHeightAndSettlesWhateverThePlayingPoliciesDo) {
  PolicyConfig hasty;
  hasty.height_law = HeightLaw::kPaper;
  hasty.settle_s = 0.0;
  hasty.aim_tolerance_rad = radians(20.0);
  hasty.rest_speed_mps = hasty.rest_turn_rate_radps = 1.0;
  PolicyConfig strict = tests::strict_config();
  for (const PolicyName drive :
       {PolicyName::kStandingDrive, PolicyName::kLateralDrive, PolicyName::kTurnDrive, PolicyName::kStraightDrive}) {
    const Played a = Drill{drive, hasty}.possession({0.5, 2.0, 0.3}, 20.0);
    const Played b = Drill{drive, strict}.possession({0.5, 2.0, 0.3}, 20.0);
    ASSERT_TRUE(a.fired && b.fired) << name(drive);
    EXPECT_EQ(a.seconds, b.seconds) << name(drive);
    EXPECT_EQ(a.fired->power, b.fired->power) << name(drive);
  }
  const Played straight = Drill{PolicyName::kStraightDrive, hasty}.possession({0.0, 4.0, 0.0}, 20.0);
  EXPECT_NEAR(straight.fired->predicted->z_m, hasty.target_height_m, 1e-6);
}

TEST(PassDrive, StartsOverWhenTheKickerWasNotReadyAtThePlaceOfTheKick) {
  PolicyMemory memory;
  PolicyConfig config;
  PolicyInput input = ready_at({-1.6, 3.0, 0.0});
  EXPECT_EQ(evaluate(PolicyName::kLateralDrive, config, {}, {}, input, memory).drive.vx_mps, 0.5)
      << "at the mark: it goes";
  input.pose.x_m = 0.001;
  input.twist.vx_mps = 0.5;
  input.kicker_ready = false;
  EXPECT_EQ(evaluate(PolicyName::kLateralDrive, config, {}, {}, input, memory).reason, Reason::kKickerNotReady);
  input.kicker_ready = true;
  input.pose.x_m = 0.1;
  EXPECT_EQ(evaluate(PolicyName::kLateralDrive, config, {}, {}, input, memory).reason, Reason::kNotAligned)
      << "too late";
  input.pose.x_m = 0.6;
  evaluate(PolicyName::kLateralDrive, config, {}, {}, input, memory);
  EXPECT_LT(evaluate(PolicyName::kLateralDrive, config, {}, {}, input, memory).drive.vx_mps, 0.0) << "back to the mark";
}

TEST(PassDrive, DoesNotKickWhereSomebodyPushedIt) {
  const auto reason = [](const Pose& at, double vx_mps) {
    PolicyMemory memory;
    EXPECT_EQ(evaluate(PolicyName::kLateralDrive, {}, {}, {}, ready_at({-1.6, 3.0, 0.0}), memory).drive.vx_mps, 0.5);
    return evaluate(PolicyName::kLateralDrive, {}, {}, {}, ready_at(at, {vx_mps, 0.0, 0.0}), memory).reason;
  };
  EXPECT_EQ(reason({0.001, 3.0, 0.0}, 0.5), Reason::kFire);
  EXPECT_EQ(reason({0.001, 3.0, radians(30.0)}, 0.5), Reason::kNotAligned) << "turned";
  EXPECT_EQ(reason({0.001, 3.0, radians(-30.0)}, 0.5), Reason::kNotAligned);
  EXPECT_EQ(reason({0.001, 2.0, 0.0}, 0.5), Reason::kNotAligned) << "a metre aside";
}

TEST(StandingDrive, DoesNotKickAwayFromTheGoal) {
  PolicyConfig config;
  Drill drill{PolicyName::kStandingDrive, config};
  EXPECT_FALSE(drill.possession({0.0, -4.0, radians(90.0)}, 3.0).fired);
  EXPECT_TRUE(drill.possession({0.0, -4.0, radians(10.0)}, 3.0).fired);
}

/// Plays a turn drive to its end; `cross` says where the ball of a kick crosses. The allowed error of each turn rate's
/// last step, as an angle.
std::vector<double> bisected(const PolicyConfig& config, auto&& cross) {
  Drill drill{PolicyName::kTurnDrive, config};
  std::vector<double> found;
  const std::size_t a_level = config.test_drive.turn_steps * config.test_drive.turn_kicks_per_step;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  for (std::size_t i = 0; i < a_level * config.test_drive.turn_radps.size(); ++i) {
    const Played played = drill.possession({0.0, 1.0, any(random)}, 20.0);
    EXPECT_TRUE(played.fired);
    if (!played.fired) break;
    EXPECT_NEAR(played.at.twist.omega_radps, config.test_drive.turn_radps[i / a_level], 0.01);
    EXPECT_EQ(played.at.twist.vx_mps, 0.0);
    drill.see(cross(played));
    if (i % a_level == a_level - 1) found.push_back(played.fired->beta_rad);
  }
  EXPECT_FALSE(drill.possession({0.0, 1.0, 0.0}, 20.0).fired) << "it is through";
  return found;
}

/// Allowed angle that brings the ball to the middle when the order goes out exactly at it (paper, section 3.3).
double wanted_rad(double omega_radps, const Played& p) {
  const RobotModel robot;
  const double v_h_mps = robot.table.speed_for(*p.fired->power) * std::cos(robot.exit_angle_rad);
  return beta_physical_rad(omega_radps, robot.delay_s, robot.ball_offset_m, v_h_mps);
}

TEST(TurnDrive, FindsTheAllowedErrorThatBringsTheBallToTheMiddle) {
  PolicyConfig config;
  config.test_drive.turn_steps = 7;
  std::vector<double> wanted;
  std::optional<Played> last;
  const auto found = bisected(config, [&](const Played& played) {
    last = played;
    return played.fired->predicted->x_m;
  });
  ASSERT_EQ(found.size(), config.test_drive.turn_radps.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double omega = config.test_drive.turn_radps[i];
    // The order comes up to a cycle after the line has entered: so much more is found, half of it on average.
    const double expected = wanted_rad(omega, *last) + 0.5 * omega * config.cycle_s;
    EXPECT_NEAR(found[i], expected, 0.5 * std::abs(omega) * config.cycle_s + radians(0.3)) << omega;
  }
}

TEST(TurnDrive, TheMeanOfAStepKeepsTheBisectionOnItsWayWhenKicksScatter) {
  PolicyConfig config;
  config.test_drive.turn_kicks_per_step = 6;
  config.test_drive.turn_radps = {1.0, -1.0, 2.0, -2.0};
  std::mt19937 random(11);
  std::normal_distribution<double> scatter(0.0, 8.0 * std::tan(radians(1.5)));
  std::optional<Played> last;
  const auto found = bisected(config, [&](const Played& played) {
    last = played;
    return played.fired->predicted->x_m + scatter(random);
  });
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double omega = config.test_drive.turn_radps[i];
    EXPECT_NEAR(found[i], wanted_rad(omega, *last) + 0.5 * omega * config.cycle_s, radians(2.5)) << omega;
  }
}

TEST(TurnDrive, AKickThatWasNotSeenToCrossDoesNotCount) {
  PolicyConfig config;
  config.test_drive.turn_kicks_per_step = 1;
  Drill drill{PolicyName::kTurnDrive, config};
  const double first = drill.possession({0, 1, 0}).fired->beta_rad;
  drill.see(std::nullopt);
  EXPECT_EQ(drill.possession({0, 1, 0}).fired->beta_rad, first);
  EXPECT_EQ(drill.possession({0, 1, 0}).fired->beta_rad, first) << "nor does one whose outcome has not come";
  drill.see(-3.0);
  EXPECT_DOUBLE_EQ(drill.possession({0, 1, 0}).fired->beta_rad, 1.5 * first) << "too late: more is allowed";
  drill.see(3.0);
  EXPECT_DOUBLE_EQ(drill.possession({0, 1, 0}).fired->beta_rad, 1.25 * first);
}

DriveMemory& drive_of(PolicyMemory& memory) { return dynamic_cast<DriveMemory&>(*memory.get()); }

class AnyDrive : public testing::TestWithParam<PolicyName> {};

TEST_P(AnyDrive, NeverFiresAgainstTheConditionsOfEveryPolicy) {
  const auto spoiled = [](auto&& spoil) {
    PolicyInput input = ready_at({0.0, 3.0, 0.0});
    spoil(input);
    return input;
  };
  const std::vector<std::pair<PolicyInput, Reason>> cases{
      {spoiled([](PolicyInput& in) { in.playing = false; }), Reason::kNotPlaying},
      {spoiled([](PolicyInput& in) { in.possession = false; }), Reason::kNoBall},
      {spoiled([](PolicyInput& in) { in.state_age_s = 1.0; }), Reason::kStaleState},
      {spoiled([](PolicyInput& in) { in.pose.x_m = NAN; }), Reason::kStaleState}};
  for (const auto& [input, reason] : cases) {
    PolicyMemory memory;
    evaluate(GetParam(), {}, {}, {}, ready_at({0.0, 3.0, 0.0}), memory);
    drive_of(memory).passing = true;
    drive_of(memory).settling_since_t_ns = -1'000'000'000;
    const PolicyOutput output = evaluate(GetParam(), {}, {}, {}, input, memory);
    EXPECT_FALSE(output.fire);
    EXPECT_EQ(output.reason, reason);
    EXPECT_EQ(output.drive.vx_mps, 0.0);
    EXPECT_FALSE(drive_of(memory).passing) << "a pass that was interrupted starts over";
  }
}

TEST_P(AnyDrive, WaitsForTheKicker) {
  PolicyMemory memory;
  PolicyInput input = ready_at({0.0, 3.0, 0.0});
  input.kicker_ready = false;
  EXPECT_FALSE(play(GetParam(), {}, {}, input, memory, 10.0).fired);
  input.kicker_ready = true;
  input.t_ns = 20'000'000'000;
  EXPECT_TRUE(play(GetParam(), {}, {}, input, memory, 20.0).fired);
}

TEST_P(AnyDrive, GoesOnAsItDidUntilTheBallHasLeft) {
  PolicyConfig config;
  config.test_drive.kicks_per_level = 1;  // the next velocity is another one
  PolicyMemory memory;
  const Played played = play(GetParam(), config, {}, ready_at({0.0, 3.0, 0.0}), memory, 20.0);
  ASSERT_TRUE(played.fired);
  PolicyInput input = played.at;
  for (int i = 1; i <= 5; ++i) {
    input.t_ns += 20'000'000;
    const PolicyOutput output = evaluate(GetParam(), config, {}, {}, input, memory);
    EXPECT_EQ(output.reason, Reason::kOrderPending);
    EXPECT_EQ(output.drive.vx_mps, played.fired->drive.vx_mps);
    EXPECT_EQ(output.drive.vy_mps, played.fired->drive.vy_mps);
    EXPECT_EQ(output.drive.omega_radps, played.fired->drive.omega_radps);
  }
}

TEST_P(AnyDrive, WithAnEmptyListKicksNothing) {
  PolicyConfig config;
  config.test_drive.powers = config.test_drive.lateral_mps = config.test_drive.straight_mps =
      config.test_drive.turn_radps = {};
  PolicyMemory memory;
  const PolicyOutput output = evaluate(GetParam(), config, {}, {}, ready_at({0, 3, 0}), memory);
  EXPECT_EQ(output.reason, Reason::kDriveFinished);
}

INSTANTIATE_TEST_SUITE_P(Drives, AnyDrive,
                         testing::Values(PolicyName::kStandingDrive, PolicyName::kLateralDrive, PolicyName::kTurnDrive,
                                         PolicyName::kStraightDrive),
                         [](const auto& drive) { return std::string{name(drive.param)}; });

}  // namespace
}  // namespace trivela::kicking
