#include "kicking/learning/kicker_learner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kicking/random/draws.hpp"

namespace trivela::kicking {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const RobotModel kFile{};

/// What a kicker with these differences gives, from the equations of the motion and not from the learner's.
KickFlight flight_of(const KickerVector& truth, double power, const Twist& twist, double speed_ratio = 1.0,
                     double turned_rad = 0.0) {
  const Pose release{1.0, 3.0, 0.3};
  const double v = kFile.table.speed_for(power) * std::exp(truth[kSpeedPart]) * speed_ratio;
  const double angle = kFile.exit_angle_rad + truth[kElevationPart];
  const double heading = release.heading_rad + twist.omega_radps * truth[kDelayPart];
  const Eigen::Vector2d robot(twist.vx_mps - twist.omega_radps * kFile.ball_offset_m, twist.vy_mps);
  const double along = robot.y() * ((robot.y() < 0.0 ? kFile.transfer_exact.backward : kFile.transfer_exact.forward) +
                                    truth[kAlongPart]);
  const double side = robot.x() * (kFile.transfer_exact.lateral + truth[kSidewaysPart]);
  const Eigen::Vector2d over_floor =
      v * std::cos(angle) * direction(heading + truth[kDirectionPart] + turned_rad) + rotate({side, along}, heading);
  const double up = v * std::sin(angle);
  return {.power = power,
          .release = release,
          .twist = twist,
          .speed_mps = std::hypot(over_floor.norm(), up),
          .elevation_rad = std::atan2(up, over_floor.norm()),
          .direction_rad = std::atan2(-over_floor.x(), over_floor.y()),
          .sd_mps = 0.02,
          .late_s = truth[kDelayPart]};
}

KickerVector differing(double speed, double elevation_deg, double direction_deg, double delay_s, double along,
                       double sideways) {
  KickerVector truth;
  truth << std::log(speed), radians(elevation_deg), radians(direction_deg), delay_s, along, sideways;
  return truth;
}

/// Kicks with the spreads of the file, in any motion.
void kick(KickerLearner& learner, const KickerVector& truth, int kicks, std::uint64_t seed = 1) {
  const Draws draws{seed, 1};
  for (int i = 0; i < kicks; ++i) {
    const auto n = draws.normals(Role::kKicker, static_cast<std::uint32_t>(i));
    const auto u = draws.uniforms(Role::kStart, static_cast<std::uint32_t>(i));
    const Twist twist{2.0 * u[0] - 1.0, 2.5 * u[1] - 0.5, 2.0 * u[2] - 1.0};
    KickerVector one = truth;
    one[kElevationPart] += kFile.spreads.exit_angle_sd_rad * n[2];
    learner.learn(flight_of(one, 18.0 + 30.0 * u[3], twist, 1.0 + kFile.spreads.speed_sd_ratio * n[0],
                            kFile.spreads.direction_sd_rad * n[1]));
  }
}

TEST(LinearFlight, AFlightOfTheFilesKickerLeavesNothing) {
  for (const Twist& twist : {Twist{}, Twist{0.5, 1.0, 1.2}, Twist{-0.8, -0.6, -0.4}}) {
    const auto linear = linear_flight(flight_of(KickerVector::Zero(), 30.0, twist), kFile, KickerVector::Zero());
    EXPECT_LT(linear.residual.cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(LinearFlight, ShowsAFasterKickAlongAndUp) {
  KickFlight flight = flight_of(KickerVector::Zero(), 30.0, {});
  flight.speed_mps += 0.5;
  const auto linear = linear_flight(flight, kFile, KickerVector::Zero());
  EXPECT_NEAR(linear.residual[0], 0.5 * std::cos(kFile.exit_angle_rad), 1e-12);
  EXPECT_NEAR(linear.residual[1], 0.0, 1e-12);
  EXPECT_NEAR(linear.residual[2], 0.5 * std::sin(kFile.exit_angle_rad), 1e-12);
}

TEST(LinearFlight, TheDesignIsTheDerivative) {
  const Twist twist{0.4, 1.1, -0.9};
  const KickFlight flight = flight_of(KickerVector::Zero(), 25.0, twist);
  constexpr double kStep = 1e-6;
  const auto at = linear_flight(flight, kFile, KickerVector::Zero());
  for (Eigen::Index i = 0; i < kKickerParts; ++i) {
    KickerVector moved = KickerVector::Zero();
    moved[i] = kStep;
    const FlightResidual slope = (at.residual - linear_flight(flight, kFile, moved).residual) / kStep;
    for (Eigen::Index row = 0; row < 4; ++row) {
      EXPECT_NEAR(slope[row], at.design(row, i), 1e-4) << row << " " << i;
    }
  }
}

TEST(KickerLearner, BeginsWithTheFileAndItsErrors) {
  const KickerChange change{};
  const KickerLearner learner{kFile, change};
  EXPECT_EQ(learner.estimate().mean, KickerVector::Zero());
  // 5 % of the belief are three times as wide.
  const double wider = std::sqrt(0.95 + 0.05 * 9.0);
  EXPECT_NEAR(learner.estimate().se[kSpeedPart], wider * std::hypot(0.05, kFile.spreads.table_sd_ratio), 1e-12);
  EXPECT_EQ(learner.estimate().speed_sd_ratio, kFile.spreads.speed_sd_ratio);
  EXPECT_EQ(learner.estimate().kicks, 0u);
}

TEST(KickerLearner, FindsEveryPartOfAKickerWithinItsErrors) {
  for (const double speed : {0.85, 0.95, 1.0, 1.1, 1.15}) {
    for (const double sign : {-1.0, 1.0}) {
      const KickerVector truth = differing(speed, 2.0 * sign, 1.5 * sign, 0.03 * sign, -0.15, -0.1);
      KickerLearner learner{kFile, {}};
      kick(learner, truth, 80, sign > 0.0 ? 3 : 4);
      const KickerEstimate& estimate = learner.estimate();
      EXPECT_EQ(estimate.kicks, 80u);
      for (Eigen::Index i = 0; i < kKickerParts; ++i)
        EXPECT_LT(std::abs(estimate.mean[i] - truth[i]), 4.0 * estimate.se[i] + 1e-3) << speed << " " << i;
      EXPECT_LT(estimate.se[kSpeedPart], 0.015);
      EXPECT_NEAR(estimate.mean[kSpeedPart], truth[kSpeedPart], 0.02) << speed;
      EXPECT_NEAR(estimate.mean[kDelayPart], truth[kDelayPart], 0.01) << speed;
    }
  }
}

TEST(KickerLearner, FindsAKickerThatIsFartherOffThanItsFileSays) {
  const KickerVector truth = differing(1.2, -4.0, 0.0, 0.06, 0.0, 0.0);
  KickerLearner learner{kFile, {}};
  kick(learner, truth, 10);
  EXPECT_NEAR(learner.estimate().mean[kSpeedPart], truth[kSpeedPart], 0.04);
  RobotModel unsure = kFile;
  unsure.spreads.table_sd_ratio = 0.15;
  unsure.spreads.exit_angle_se_rad = radians(4.0);
  unsure.spreads.delay_se_s = 0.06;
  KickerLearner knows{unsure, {}};
  kick(knows, truth, 2);
  EXPECT_NEAR(knows.estimate().mean[kSpeedPart], truth[kSpeedPart], 0.05) << "a file that says so is left at once";
}

TEST(KickerLearner, IsNearAfterThreeKicks) {
  double sum = 0.0;
  constexpr int kRuns = 20;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    KickerLearner learner{kFile, {}};
    kick(learner, differing(1.1, 0.0, 0.0, 0.0, 0.0, 0.0), 3, seed);
    sum += learner.estimate().mean[kSpeedPart];
  }
  EXPECT_NEAR(sum / kRuns, std::log(1.1), 0.015);
}

TEST(KickerLearner, ErrorsShrinkWithKicksAndStayAboveWhatItForgets) {
  KickerLearner learner{kFile, {}};
  double before = learner.estimate().se[kSpeedPart];
  for (const int kicks : {1, 9, 30}) {
    kick(learner, KickerVector::Zero(), kicks, 7);
    EXPECT_LT(learner.estimate().se[kSpeedPart], before);
    before = learner.estimate().se[kSpeedPart];
  }
  EXPECT_GT(before, 0.002);
}

TEST(KickerLearner, OneWrongTrackHardlyMovesIt) {
  KickerLearner learner{kFile, {}};
  kick(learner, KickerVector::Zero(), 20);
  const KickerVector before = learner.estimate().mean;
  KickFlight touched = flight_of(KickerVector::Zero(), 30.0, {});
  touched.speed_mps *= 0.5;
  touched.direction_rad += 0.4;
  learner.learn(touched);
  EXPECT_GT(learner.estimate().p_mistaken, 0.5);
  EXPECT_LT(std::abs(learner.estimate().mean[kSpeedPart] - before[kSpeedPart]), 0.02);
  kick(learner, KickerVector::Zero(), 3, 9);
  EXPECT_NEAR(learner.estimate().mean[kSpeedPart], before[kSpeedPart], 0.02) << "and what it did passes";
}

TEST(KickerLearner, FollowsAJumpOfFivePerCentWithinEightKicks) {
  int followed = 0;
  constexpr int kRuns = 21;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    KickerLearner learner{kFile, {}};
    kick(learner, KickerVector::Zero(), 25, seed);
    const double before = learner.estimate().mean[kSpeedPart];
    kick(learner, differing(0.95, 0.0, 0.0, 0.0, 0.0, 0.0), 8, 100 + seed);
    followed += learner.estimate().mean[kSpeedPart] - before < 0.5 * std::log(0.95);
  }
  EXPECT_GT(followed, kRuns / 2);
}

TEST(KickerLearner, AFlightThatIsNoneChangesNothing) {
  KickerLearner learner{kFile, {}};
  kick(learner, KickerVector::Zero(), 3);
  const KickerVector before = learner.estimate().mean;
  for (double KickFlight::*const part : {&KickFlight::speed_mps, &KickFlight::elevation_rad, &KickFlight::direction_rad,
                                         &KickFlight::sd_mps, &KickFlight::power}) {
    KickFlight bad = flight_of(KickerVector::Zero(), 30.0, {});
    bad.*part = kNaN;
    EXPECT_FALSE(learner.learn(bad));
  }
  KickFlight standing = flight_of(KickerVector::Zero(), 30.0, {});
  standing.speed_mps = 0.0;
  EXPECT_FALSE(learner.learn(standing));
  EXPECT_EQ(learner.estimate().mean, before);
  EXPECT_EQ(learner.estimate().kicks, 3u);
}

TEST(KickerLearner, GoesOnWithWhatAnEarlierMatchLeftAndADaysChange) {
  KickerLearner yesterday{kFile, {}};
  kick(yesterday, differing(1.1, 0.0, 0.0, 0.0, 0.0, 0.0), 40);
  KickerLearner today{kFile, {}};
  today.begin_with(yesterday.estimate());
  EXPECT_TRUE(today.estimate().mean.isApprox(yesterday.estimate().mean, 1e-12));
  EXPECT_EQ(today.estimate().kicks, 0u);
  EXPECT_GT(today.estimate().se[kSpeedPart], std::hypot(0.05, yesterday.estimate().se[kSpeedPart]));
  EXPECT_LT(today.estimate().se[kSpeedPart], 1.3 * std::hypot(0.05, yesterday.estimate().se[kSpeedPart]));
}

TEST(KickerLearner, ChiSquareIsFourOnAverageWhereTheSpreadsAreRight) {
  double sum = 0.0;
  int n = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    KickerLearner learner{kFile, {}};
    for (int i = 0; i < 40; ++i) {
      kick(learner, KickerVector::Zero(), 1, 1000 * seed + static_cast<std::uint64_t>(i));
      if (i < 5) continue;
      sum += learner.estimate().chi_square;
      ++n;
    }
  }
  // The delay of these kicks has no spread, so that three of the four residuals vary.
  EXPECT_GT(sum / n, 1.5);
  EXPECT_LT(sum / n, 5.0);
}

TEST(KickerLearner, LearnsASpreadThatIsThreeTimesTheFiles) {
  RobotModel calm = kFile;
  calm.spreads.direction_sd_rad = kFile.spreads.direction_sd_rad / 3.0;
  KickerLearner learner{calm, {}};
  kick(learner, KickerVector::Zero(), 100);
  EXPECT_GT(learner.estimate().direction_sd_rad, 2.0 * calm.spreads.direction_sd_rad);
  EXPECT_LT(learner.estimate().direction_sd_rad, 1.3 * kFile.spreads.direction_sd_rad);
}

TEST(CorrectedModel, OfNoDifferenceIsTheFilesWithTheEstimatesErrors) {
  const KickerLearner learner{kFile, {}};
  const RobotModel model = corrected(kFile, learner.estimate());
  for (std::size_t i = 0; i < kFile.table.set_points().size(); ++i)
    EXPECT_EQ(model.table.set_points()[i].speed_mps, kFile.table.set_points()[i].speed_mps);
  EXPECT_EQ(model.exit_angle_rad, kFile.exit_angle_rad);
  EXPECT_EQ(model.direction_rad, 0.0);
  EXPECT_EQ(model.delay_s, kFile.delay_s);
  EXPECT_EQ(model.alpha_slope_rad_per_mps, kFile.alpha_slope_rad_per_mps);
  EXPECT_EQ(model.beta_slope_s, kFile.beta_slope_s);
  EXPECT_EQ(model.transfer_exact.forward, kFile.transfer_exact.forward);
  EXPECT_EQ(model.spreads.table_sd_ratio, learner.estimate().se[kSpeedPart]);
  EXPECT_GT(model.spreads.exit_angle_sd_rad, kFile.spreads.exit_angle_sd_rad);
}

TEST(CorrectedModel, MovesEachFigureByItsPart) {
  KickerEstimate estimate;
  estimate.mean = differing(1.1, 1.0, -2.0, 0.02, -0.2, -0.1);
  const RobotModel model = corrected(kFile, estimate);
  EXPECT_NEAR(model.table.speed_for(30.0), 1.1 * kFile.table.speed_for(30.0), 1e-12);
  EXPECT_NEAR(degrees(model.exit_angle_rad), degrees(kFile.exit_angle_rad) + 1.0, 1e-9);
  EXPECT_NEAR(degrees(model.direction_rad), -2.0, 1e-9);
  EXPECT_NEAR(model.delay_s, 0.08, 1e-12);
  EXPECT_NEAR(model.transfer_exact.forward, 0.8, 1e-12);
  EXPECT_NEAR(model.transfer_exact.backward, 0.3, 1e-12);
  EXPECT_NEAR(model.transfer_exact.lateral, 0.9, 1e-12);
  EXPECT_LT(model.alpha_slope_rad_per_mps, kFile.alpha_slope_rad_per_mps / 1.1);
  EXPECT_NEAR(model.beta_slope_s, kFile.beta_slope_s + 0.02, 0.005);
}

TEST(CorrectedModel, StaysInTheRangesOfARobotsFile) {
  KickerEstimate wild;
  for (const double sign : {-1.0, 1.0}) {
    wild.mean.setConstant(100.0 * sign);
    const RobotModel model = corrected(kFile, wild);
    EXPECT_GT(model.table.front().speed_mps, 0.5 * kFile.table.front().speed_mps);
    EXPECT_LT(model.table.back().speed_mps, 2.0 * kFile.table.back().speed_mps);
    EXPECT_GE(model.exit_angle_rad, radians(5.0));
    EXPECT_LE(model.exit_angle_rad, radians(80.0));
    EXPECT_GE(model.delay_s, 0.0);
    EXPECT_LE(model.delay_s, 0.5);
    EXPECT_LE(std::abs(model.direction_rad), radians(20.0));
    EXPECT_GE(model.transfer_exact.lateral, 0.0);
    EXPECT_LE(model.transfer_exact.lateral, 1.5);
    EXPECT_GE(model.beta_slope_s, 0.0);
  }
}

TEST(KickerEstimate, IsSoundWhereAllIsFiniteAndNoErrorNegative) {
  EXPECT_TRUE(valid(KickerEstimate{}));
  KickerEstimate bad;
  bad.mean[kDelayPart] = kNaN;
  EXPECT_FALSE(valid(bad));
  bad = {};
  bad.se[kAlongPart] = -0.1;
  EXPECT_FALSE(valid(bad));
  bad = {};
  bad.mean[kSpeedPart] = 1e300;
  EXPECT_FALSE(valid(bad));
  bad = {};
  bad.se[kSpeedPart] = kNaN;
  EXPECT_FALSE(valid(bad));
  bad = {};
  bad.direction_sd_rad = kNaN;
  EXPECT_FALSE(valid(bad));
}

}  // namespace
}  // namespace trivela::kicking
