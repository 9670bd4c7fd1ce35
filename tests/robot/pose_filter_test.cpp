#include "robot/belief/pose_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

using kicking::Pose;
using kicking::TurnedPose;
using kicking::Twist;

double distance_m(const Pose& a, const Pose& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

// A robot that drives through F with exact odometry, whose frame is another one than F.
struct Drive {
  config::WorldState settings{};
  PoseFilter filter{settings};
  std::int64_t t_ns = kCycle_ns;
  Pose truth{1.0, -2.0, 0.7};
  Pose odometry{};
  double var_position_m2 = 0.0;
  double var_heading_rad2 = 0.0;

  void predict() { filter.predict(t_ns, odometry, var_position_m2, var_heading_rad2); }
  void go(const Twist& twist, double var_step_m2 = 1e-4, double var_step_rad2 = 1e-5) {
    truth = kicking::advance(truth, twist, 0.02);
    odometry = kicking::advance(odometry, twist, 0.02);
    var_position_m2 += var_step_m2;
    var_heading_rad2 += var_step_rad2;
    t_ns += kCycle_ns;
    predict();
  }
  void stand(int frames, const Pose& seen) {
    for (int i = 0; i < frames; ++i) {
      go({});
      filter.correct(t_ns, seen);
    }
  }
};

TEST(PoseFilter, KnowsNothingBeforeTheFirstFrameAndTakesItAsItIs) {
  Drive drive;
  drive.filter.correct(drive.t_ns, drive.truth);
  EXPECT_FALSE(drive.filter.pose()) << "a frame before any odometry is ignored";
  drive.predict();
  EXPECT_FALSE(drive.filter.pose());
  EXPECT_FALSE(drive.filter.pose_at(drive.t_ns));
  drive.filter.correct(drive.t_ns, drive.truth);
  ASSERT_TRUE(drive.filter.pose());
  EXPECT_LT(distance_m(*drive.filter.pose(), drive.truth), 1e-12);
  EXPECT_NEAR(drive.filter.sd_position_m(), drive.settings.pose_sd_m, 1e-12);
  EXPECT_NEAR(drive.filter.sd_heading_rad(), drive.settings.pose_sd_heading_rad, 1e-12);
}

TEST(PoseFilter, CarriesThePoseAlongOdometryWithoutFrames) {
  Drive drive;
  drive.predict();
  drive.filter.correct(drive.t_ns, drive.truth);
  double last_sd_m = drive.filter.sd_position_m();
  for (int i = 0; i < 100; ++i) {
    drive.go({0.4, 1.5, 1.0});
    EXPECT_LT(distance_m(*drive.filter.pose(), drive.truth), 1e-9);
    EXPECT_NEAR(kicking::wrap_angle(drive.filter.pose()->heading_rad - drive.truth.heading_rad), 0.0, 1e-9);
    EXPECT_GT(drive.filter.sd_position_m(), last_sd_m);
    last_sd_m = drive.filter.sd_position_m();
  }
}

TEST(PoseFilter, LateFramesOfAMovingRobotCorrectThePastWithoutBias) {
  Drive drive;
  drive.predict();
  std::vector<Pose> truths{drive.truth};
  double worst_m = 0.0, worst_rad = 0.0;
  for (int i = 1; i <= 200; ++i) {
    drive.go({0.5, 2.0, 2.0});
    truths.push_back(drive.truth);
    if (i < 3) continue;
    // Exposed 50 ms ago, between two samples of odometry.
    const Pose older = truths[truths.size() - 4], newer = truths[truths.size() - 3];
    const Pose step = relative(TurnedPose{older}, newer);
    drive.filter.correct(drive.t_ns - 50'000'000,
                         compose(TurnedPose{older}, {step.x_m / 2, step.y_m / 2, step.heading_rad / 2}));
    worst_m = std::max(worst_m, distance_m(*drive.filter.pose(), drive.truth));
    worst_rad =
        std::max(worst_rad, std::abs(kicking::wrap_angle(drive.filter.pose()->heading_rad - drive.truth.heading_rad)));
  }
  EXPECT_LT(worst_m, 1e-3);  // taken for a picture of now it would lag by 0.1 m
  EXPECT_LT(worst_rad, 1e-9);
}

TEST(PoseFilter, ALateFrameOfARobotThatWasPlacedWrongMovesItByTheGain) {
  Drive drive;
  drive.predict();
  drive.filter.correct(drive.t_ns, {0.0, 0.0, 0.0});
  drive.var_position_m2 = 0.0144;  // so much drift that the next frame counts two thirds
  drive.odometry = {0.0, 1.0, 0.0};
  drive.t_ns += kCycle_ns;
  drive.predict();
  drive.filter.correct(drive.t_ns - kCycle_ns, {0.3, 0.0, 0.0});  // a picture of the start
  EXPECT_NEAR(drive.filter.pose()->x_m, 0.2, 1e-12);
  EXPECT_NEAR(drive.filter.pose()->y_m, 1.0, 1e-12) << "what was driven since stays";
  EXPECT_NEAR(drive.filter.sd_position_m(), std::sqrt(2.0 * 0.0144 / 3.0), 1e-12);
}

TEST(PoseFilter, AveragesTheNoiseOfFrames) {
  Drive drive;
  std::mt19937_64 random{5};
  std::normal_distribution<double> noise{0.0, drive.settings.pose_sd_m};
  std::normal_distribution<double> turn{0.0, drive.settings.pose_sd_heading_rad};
  drive.predict();
  double squares_m2 = 0.0, turns_rad2 = 0.0;
  int counted = 0;
  for (int i = 0; i < 4000; ++i) {
    drive.go({0.0, 0.5, 0.5}, 1e-6, 1e-8);
    drive.filter.correct(drive.t_ns, {drive.truth.x_m + noise(random), drive.truth.y_m + noise(random),
                                      drive.truth.heading_rad + turn(random)});
    if (i < 400) continue;
    squares_m2 += std::pow(distance_m(*drive.filter.pose(), drive.truth), 2) / 2.0;
    turns_rad2 += std::pow(kicking::wrap_angle(drive.filter.pose()->heading_rad - drive.truth.heading_rad), 2);
    ++counted;
  }
  // Exact odometry makes the errors smaller than the filter, which expects drift, believes; never larger.
  EXPECT_LT(std::sqrt(squares_m2 / counted), drive.filter.sd_position_m());
  EXPECT_LT(drive.filter.sd_position_m(), drive.settings.pose_sd_m / 5.0);
  EXPECT_LT(std::sqrt(turns_rad2 / counted), drive.settings.pose_sd_heading_rad / 5.0);
}

TEST(PoseFilter, OneWildFrameChangesNothing) {
  Drive drive;
  drive.predict();
  drive.filter.correct(drive.t_ns, drive.truth);
  drive.stand(10, drive.truth);
  const Pose before = *drive.filter.pose();
  drive.stand(1, {drive.truth.x_m + 4.0, drive.truth.y_m, 2.0});
  EXPECT_LT(distance_m(*drive.filter.pose(), before), 1e-12);
  EXPECT_NEAR(drive.filter.pose()->heading_rad, before.heading_rad, 1e-12);
}

TEST(PoseFilter, AKidnappedRobotIsPlacedAnewAfterThatManyFramesAndNotBefore) {
  Drive drive;
  drive.predict();
  drive.filter.correct(drive.t_ns, drive.truth);
  drive.stand(10, drive.truth);
  const Pose elsewhere{-4.0, 3.0, 2.5};
  drive.stand(static_cast<int>(drive.settings.relocalise_frames) - 1, elsewhere);
  EXPECT_LT(distance_m(*drive.filter.pose(), drive.truth), 1e-9);
  drive.stand(1, elsewhere);
  EXPECT_LT(distance_m(*drive.filter.pose(), elsewhere), 1e-12);
  EXPECT_NEAR(drive.filter.pose()->heading_rad, 2.5, 1e-12);
  EXPECT_NEAR(drive.filter.sd_position_m(), drive.settings.pose_sd_m, 1e-12);
}

TEST(PoseFilter, ARobotTurnedOnTheSpotIsPlacedAnewToo) {
  Drive drive;
  drive.predict();
  drive.filter.correct(drive.t_ns, drive.truth);
  drive.stand(10, drive.truth);
  Pose turned = drive.truth;
  turned.heading_rad += 0.5;
  drive.stand(static_cast<int>(drive.settings.relocalise_frames), turned);
  EXPECT_NEAR(drive.filter.pose()->heading_rad, turned.heading_rad, 1e-12);
  Pose slightly = turned;
  slightly.heading_rad += 0.1;  // drift, which is filtered
  drive.stand(static_cast<int>(drive.settings.relocalise_frames), slightly);
  EXPECT_LT(drive.filter.pose()->heading_rad, turned.heading_rad + 0.099);
}

TEST(PoseFilter, AGoodFrameInBetweenEndsTheRunOfWildOnes) {
  Drive drive;
  drive.predict();
  drive.filter.correct(drive.t_ns, drive.truth);
  const Pose elsewhere{-4.0, 3.0, 2.5};
  for (int i = 0; i < 10; ++i) {
    drive.stand(static_cast<int>(drive.settings.relocalise_frames) - 1, elsewhere);
    drive.stand(1, drive.truth);
  }
  EXPECT_LT(distance_m(*drive.filter.pose(), drive.truth), 1e-9);
}

TEST(PoseFilter, WildFramesThatDisagreePlaceTheRobotNowhere) {
  Drive drive;
  drive.predict();
  drive.filter.correct(drive.t_ns, drive.truth);
  for (int i = 0; i < 12; ++i) drive.stand(1, {i % 2 == 0 ? -5.0 : 5.0, i % 3 - 4.0, 0.0});
  EXPECT_LT(distance_m(*drive.filter.pose(), drive.truth), 1e-9);
}

TEST(PoseFilter, IgnoresFramesThatAreNotFinite) {
  Drive drive;
  drive.predict();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  drive.filter.correct(drive.t_ns, {nan, 0.0, 0.0});
  EXPECT_FALSE(drive.filter.pose());
  drive.filter.correct(drive.t_ns, drive.truth);
  for (const Pose& bad : {Pose{nan, 0.0, 0.0}, Pose{0.0, nan, 0.0}, Pose{0.0, 0.0, HUGE_VAL}})
    drive.filter.correct(drive.t_ns, bad);
  EXPECT_LT(distance_m(*drive.filter.pose(), drive.truth), 1e-12);
}

TEST(PoseFilter, LooksUpWhereTheRobotWas) {
  Drive drive;
  drive.predict();
  drive.filter.correct(drive.t_ns, drive.truth);
  const Pose start = drive.truth;
  const std::int64_t then = drive.t_ns;
  for (int i = 0; i < 10; ++i) drive.go({0.0, 2.0, 1.0});
  EXPECT_LT(distance_m(*drive.filter.pose_at(then), start), 1e-9);
  EXPECT_LT(distance_m(*drive.filter.pose_at(drive.t_ns), drive.truth), 1e-9);
}

}  // namespace
}  // namespace trivela::robot
