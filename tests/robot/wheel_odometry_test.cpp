#include "robot/odometry/wheel_odometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/instants.hpp"
#include "tests/robot/wheel_speeds.hpp"

namespace trivela::robot {
namespace {

using kicking::OmniKinematics;
using kicking::Twist;

const kicking::WheelBase kBase{};
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

hal::WheelSample sample(std::int64_t t_ns, const std::vector<double>& wheel_radps, std::optional<double> gyro_radps) {
  hal::WheelSample out{t_ns, static_cast<int>(wheel_radps.size()), {}, gyro_radps};
  std::ranges::copy(wheel_radps, out.wheel_radps.begin());
  return out;
}

struct Driven {
  config::Odometry noise{};
  WheelOdometry odometry{kBase, noise};
  std::int64_t t_ns = 1'000'000'000;

  std::optional<msg::Odometry> cycle(const Twist& twist, std::optional<double> gyro_radps = {}) {
    const msg::Odometry* const estimate = odometry.update(sample(t_ns, wheel_speeds_radps(kBase, twist), gyro_radps));
    t_ns += kCycle_ns;
    return estimate != nullptr ? std::optional{*estimate} : std::nullopt;
  }
};

TEST(WheelOdometry, TheFirstSampleMovesNothing) {
  robot::Driven driven;
  const auto first = driven.cycle({1.0, 2.0, 3.0});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->x_m, 0.0);
  EXPECT_EQ(first->y_m, 0.0);
  EXPECT_EQ(first->var_position_m2, 0.0);
  EXPECT_NEAR(first->vy_mps, 2.0, 1e-12);
}

TEST(WheelOdometry, DrivesStraightByHand) {
  robot::Driven driven;
  for (int i = 0; i <= 50; ++i) driven.cycle({0.5, 1.0, 0.0});
  const auto estimate = driven.cycle({0.5, 1.0, 0.0});
  EXPECT_NEAR(estimate->x_m, 51 * 0.02 * 0.5, 1e-12);
  EXPECT_NEAR(estimate->y_m, 51 * 0.02 * 1.0, 1e-12);
  EXPECT_NEAR(estimate->heading_rad, 0.0, 1e-12);
}

TEST(WheelOdometry, ForgedSpeedsLeaveNoTrace) {
  robot::Driven driven;
  driven.cycle({0.5, 1.0, 0.0});
  for (const double forged : {1e4, 1e300, -1e308}) {
    const std::vector<double> wheels(4, forged);
    EXPECT_FALSE(driven.odometry.update(sample(driven.t_ns, wheels, {})));
    EXPECT_TRUE(driven.cycle({0.5, 1.0, 0.0}, forged)) << "the gyro alone is passed over";
  }
  const auto estimate = driven.cycle({0.5, 1.0, 0.0});
  EXPECT_NEAR(estimate->y_m, 4 * 0.02 * 1.0, 1e-12);
  EXPECT_NEAR(estimate->heading_rad, 0.0, 1e-12);
}

TEST(WheelOdometry, ACircleCloses) {
  constexpr int kCycles = 200;  // 4 s
  const Twist twist{0.3, 1.0, 2.0 * std::numbers::pi / (kCycles * 0.02)};
  robot::Driven driven;
  driven.cycle(twist);
  double farthest_m = 0.0;
  std::optional<msg::Odometry> estimate;
  for (int i = 0; i < kCycles; ++i) {
    estimate = driven.cycle(twist);
    farthest_m = std::max(farthest_m, std::hypot(estimate->x_m, estimate->y_m));
  }
  EXPECT_NEAR(estimate->x_m, 0.0, 1e-9);
  EXPECT_NEAR(estimate->y_m, 0.0, 1e-9);
  EXPECT_NEAR(kicking::wrap_angle(estimate->heading_rad), 0.0, 1e-9);
  EXPECT_NEAR(farthest_m, 2.0 * std::hypot(0.3, 1.0) / twist.omega_radps, 1e-3);  // the diameter
}

TEST(WheelOdometry, TheTurnRateIsTheMeanOfWheelsAndGyroByTheirVariances) {
  robot::Driven driven;
  const double var_wheels = OmniKinematics{kBase}.twist_variance(driven.noise.wheel_sd_radps).z();
  const double var_gyro = driven.noise.gyro_sd_radps * driven.noise.gyro_sd_radps;
  const auto estimate = driven.cycle({0.0, 0.0, 1.0}, 1.5);
  EXPECT_NEAR(estimate->omega_radps, (1.0 / var_wheels + 1.5 / var_gyro) / (1.0 / var_wheels + 1.0 / var_gyro), 1e-12);
  EXPECT_NEAR(estimate->var_omega_rad2ps2, 1.0 / (1.0 / var_wheels + 1.0 / var_gyro), 1e-15);
  EXPECT_LT(std::abs(estimate->omega_radps - 1.5), 0.05) << "the gyro is the better of the two";
}

TEST(WheelOdometry, WithoutAGyroTheWheelsAloneTurn) {
  for (const auto gyro : {std::optional<double>{}, std::optional{kNaN}, std::optional{HUGE_VAL}, std::optional{2e3}}) {
    robot::Driven driven;
    const auto estimate = driven.cycle({0.0, 0.0, 1.0}, gyro);
    ASSERT_TRUE(estimate);
    EXPECT_EQ(std::isnan(estimate->gyro_radps), gyro != 2e3);
    EXPECT_NEAR(estimate->omega_radps, 1.0, 1e-12);
    EXPECT_NEAR(estimate->var_omega_rad2ps2, OmniKinematics{kBase}.twist_variance(driven.noise.wheel_sd_radps).z(),
                1e-15);
  }
}

TEST(WheelOdometry, SaysWhatItWasMadeFromAndNoneWhereThereIsNothing) {
  WheelOdometry odometry{kBase, {}};
  const auto with = odometry.update(sample(1, {1.0, 2.0, -3.0}, 0.5));
  EXPECT_EQ(with->t_ns, 1);
  EXPECT_EQ(with->wheel_2_radps, -3.0);
  EXPECT_TRUE(std::isnan(with->wheel_3_radps));
  EXPECT_EQ(with->gyro_radps, 0.5);
  EXPECT_TRUE(std::isnan(odometry.update(sample(2, {1.0, 2.0, -3.0}, {}))->gyro_radps));
}

TEST(WheelOdometry, IgnoresSamplesThatAreNotUsable) {
  robot::Driven driven;
  driven.cycle({0.0, 1.0, 0.0});
  const auto before = driven.cycle({0.0, 1.0, 0.0});
  const std::int64_t t_ns = driven.t_ns;
  const auto w = wheel_speeds_radps(kBase, {0.0, 1.0, 0.0});
  for (const double broken : {kNaN, HUGE_VAL, -HUGE_VAL}) {
    auto bad = w;
    bad[1] = broken;
    EXPECT_FALSE(driven.odometry.update(sample(t_ns, bad, 0.0))) << broken;
  }
  EXPECT_FALSE(driven.odometry.update(sample(t_ns, {w.begin(), w.begin() + 2}, 0.0))) << "too few wheels";
  EXPECT_FALSE(driven.odometry.update(sample(t_ns, {}, 0.0))) << "no wheels";
  EXPECT_FALSE(driven.odometry.update(sample(t_ns - kCycle_ns, w, 0.0))) << "the same instant again";
  EXPECT_FALSE(driven.odometry.update(sample(t_ns - 5 * kCycle_ns, w, 0.0))) << "an older one";
  const auto after = driven.cycle({0.0, 1.0, 0.0});
  ASSERT_TRUE(after);
  EXPECT_NEAR(after->y_m - before->y_m, 0.02, 1e-12) << "as if they had never come";
}

TEST(WheelOdometry, BridgesAGapAtTheMeanSpeedOfItsEnds) {
  robot::Driven driven;
  driven.cycle({0.0, 1.0, 0.0});
  driven.t_ns += 4 * kCycle_ns;
  EXPECT_NEAR(driven.cycle({0.0, 3.0, 0.0})->y_m, 0.2, 1e-12);
}

TEST(WheelOdometry, AGainOfSpeedNeitherLeadsNorLags) {
  robot::Driven driven;
  driven.cycle({});
  std::optional<msg::Odometry> estimate;
  for (int i = 1; i <= 50; ++i) estimate = driven.cycle({0.0, 0.0, 2.0 * i / 50});  // 2 rad/s2 for a second
  EXPECT_NEAR(estimate->heading_rad, 0.5 * 2.0 * 1.0, 1e-12);
}

TEST(WheelOdometry, VariancesGrowWithEveryCycleAndFasterOnTheMove) {
  const auto after_a_second = [](const Twist& twist) {
    robot::Driven driven;
    msg::Odometry last = *driven.cycle(twist, twist.omega_radps);
    for (int i = 0; i < 50; ++i) {
      const auto next = driven.cycle(twist, twist.omega_radps);
      EXPECT_GT(next->var_position_m2, last.var_position_m2);
      EXPECT_GT(next->var_heading_rad2, last.var_heading_rad2);
      last = *next;
    }
    return last;
  };
  const auto still = after_a_second({});
  EXPECT_GT(after_a_second({0.0, 2.0, 0.0}).var_position_m2, still.var_position_m2);
  EXPECT_GT(after_a_second({0.0, 0.0, 3.0}).var_heading_rad2, still.var_heading_rad2);
  EXPECT_NEAR(after_a_second({0.0, 2.0, 0.0}).var_heading_rad2, still.var_heading_rad2, 1e-12);
}

}  // namespace
}  // namespace trivela::robot
