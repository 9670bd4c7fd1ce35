#include "robot/observer/flight_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/kicker/flight.hpp"

namespace trivela::robot {
namespace {

sim::BallMotion kicked() { return {{{0.5, 3.0, 0.11}, {-0.7, 6.0, 4.5}}}; }

FlightFilter filter_of(const sim::BallMotion& ball, double sd_mps = 0.01) {
  const kicking::Sighting first{0, ball.position_m};
  const auto& v = ball.velocity_mps;
  return {
      first, 0.001, v, {sd_mps, sd_mps, sd_mps}, ball.rolling ? FlightFilter::Way::kRolls : FlightFilter::Way::kFlies};
}

void fly(sim::BallMotion& ball, double dt_s) {
  for (int i = 0; i < 10; ++i) sim::advance(ball, {}, dt_s / 10.0);
}

TEST(FlightFilter, FliesAsTheBallDoesThroughAirAndBounces) {
  sim::BallMotion ball = kicked();
  FlightFilter filter = filter_of(ball);
  for (int i = 1; i <= 75; ++i) {
    fly(ball, 0.02);
    filter.advance(0.02);
    ASSERT_NEAR(filter.x().p_m, ball.position_m.x(), 0.02) << i;
    ASSERT_NEAR(filter.y().p_m, ball.position_m.y(), 0.03) << i;
    ASSERT_NEAR(filter.z().p_m, ball.position_m.z(), 0.05) << i;
    if (i == 30) {
      EXPECT_FALSE(filter.bounced());
    }
  }
  EXPECT_TRUE(filter.bounced());
}

TEST(FlightFilter, ARollingBallComesToRestAndStays) {
  sim::BallMotion ball{{{0.0, 5.0, 0.11}, {0.3, 1.0, 0.0}}, true};
  FlightFilter filter = filter_of(ball);
  for (int i = 0; i < 200; ++i) {
    fly(ball, 0.02);
    filter.advance(0.02);
  }
  EXPECT_EQ(filter.speed_mps(), 0.0);
  EXPECT_NEAR(filter.y().p_m, ball.position_m.y(), 0.02);
}

// Of many noisy flights the standard deviations hold what they say, before the bounce and after it.
TEST(FlightFilter, SaysHowFarItMayBeOff) {
  constexpr double kSd_m = 0.05;
  std::mt19937_64 random{3};
  std::normal_distribution<double> noise{0.0, kSd_m};
  double squares_x = 0.0, squares_z = 0.0, after_z = 0.0;
  constexpr int kRuns = 600;
  for (int run = 0; run < kRuns; ++run) {
    sim::BallMotion ball = kicked();
    const auto see = [&] {
      return Eigen::Vector3d{ball.position_m.x() + noise(random), ball.position_m.y() + noise(random),
                             ball.position_m.z() + noise(random)};
    };
    FlightFilter filter{{0, see()}, kSd_m, {0.0, 5.0, 4.0}, {3.0, 3.0, 3.0}, FlightFilter::Way::kFlies};
    for (int i = 1; i <= 55; ++i) {
      fly(ball, 0.02);
      filter.advance(0.02);
      filter.correct(see(), kSd_m);
      const double off_z = filter.z().p_m - ball.position_m.z();
      if (i == 40) squares_x += std::pow(filter.x().p_m - ball.position_m.x(), 2) / filter.x().var_p_m2;
      if (i == 40) squares_z += off_z * off_z / filter.z().var_p_m2;
      if (i == 55) after_z += off_z * off_z / filter.z().var_p_m2;
    }
    EXPECT_TRUE(filter.bounced());
  }
  EXPECT_NEAR(std::sqrt(squares_x / kRuns), 1.0, 0.12);
  EXPECT_NEAR(std::sqrt(squares_z / kRuns), 1.0, 0.12);
  EXPECT_NEAR(std::sqrt(after_z / kRuns), 1.0, 0.3) << "when it bounced is taken from the mean";
}

TEST(FlightFilter, IsThrownBackFromThePlane) {
  FlightFilter filter = filter_of(kicked());
  filter.throw_back(9.0, 0.5, 0.1);
  EXPECT_EQ(filter.y().p_m, 9.0);
  EXPECT_DOUBLE_EQ(filter.y().v_mps, -3.0);
  EXPECT_DOUBLE_EQ(filter.x().v_mps, -0.35);
  EXPECT_NEAR(filter.y().var_v_m2ps2, 0.36, 0.01) << "a tenth of 6 m/s";
}

}  // namespace
}  // namespace trivela::robot
