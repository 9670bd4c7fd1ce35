#include <gtest/gtest.h>

#include <cmath>

#include "sim/sensor_suite.hpp"

namespace trivela::sim {
namespace {

const kicking::Draws kDraws{5, 1};

Opportunity standing(double x, double y, double heading) {
  Opportunity o;
  o.start = {x, y, heading};
  o.opponents[0].distance_m = 2.0;
  return o;
}

Scenario noiseless() {
  Scenario s;
  s.odometry = {0.0, 0.0, 0.0, 0.0};
  s.vision.position_white_sd_m = s.vision.position_slow_sd_m = 0.0;
  s.vision.heading_white_sd_rad = s.vision.heading_slow_sd_rad = 0.0;
  s.vision.ball_sd_m = s.vision.ball_sd_ratio = s.vision.opponent_sd_m = s.vision.dropout_ratio = 0.0;
  s.flight_camera.position_sd_m = s.flight_camera.dropout_ratio = 0.0;
  return s;
}

/// Lets `cycles` cycles pass.
void run(World& world, SensorSuite& suite, int cycles) {
  for (int i = 0; i < cycles; ++i) {
    world.advance_to(world.t_ns() + 20'000'000);
    suite.remember(world);
    suite.next_cycle();
  }
}

TEST(Wheels, TurnByTheOmniBasesEquation) {
  const Scenario s = noiseless();
  World world{s};
  SensorSuite suite{s};
  Opportunity o = standing(0, 0, 0.7);
  world.place(o, 1.0, kDraws);
  suite.begin(kDraws);
  o.velocity = {0.3, 1.2, 0.9};
  world.start_play(o);
  const WheelSample sample = suite.wheels(world);
  ASSERT_EQ(sample.wheel_count, 3);
  EXPECT_NEAR(sample.wheel_radps[0], (-0.5 * 0.3 + std::sqrt(0.75) * 1.2 + 0.22 * 0.9) / 0.05, 1e-9);  // 30 degrees
  EXPECT_NEAR(sample.wheel_radps[1], (-0.5 * 0.3 - std::sqrt(0.75) * 1.2 + 0.22 * 0.9) / 0.05, 1e-9);  // 150 degrees
  EXPECT_NEAR(sample.wheel_radps[2], (0.3 + 0.22 * 0.9) / 0.05, 1e-9);                                 // 270 degrees
  EXPECT_EQ(sample.wheel_radps[3], 0.0);
  EXPECT_NEAR(sample.gyro_radps, 0.9, 1e-12);
}

TEST(Vision, ShowsTheWorldOfOneLatencyAgo) {
  const Scenario s = noiseless();
  World world{s};
  SensorSuite suite{s};
  Opportunity o = standing(1.0, 2.0, 0.0);
  o.velocity = {0.0, 1.0, 0.0};
  world.place(o, 1.0, kDraws);
  suite.begin(kDraws);
  suite.remember(world);
  EXPECT_FALSE(suite.vision(world).pose);  // exposed before the robot was there
  EXPECT_FALSE(suite.flight(world).ball);
  world.start_play(o);
  run(world, suite, 10);
  const VisionFrame frame = suite.vision(world);
  EXPECT_EQ(frame.t_exposure_ns, 140'000'000);
  ASSERT_TRUE(frame.pose && frame.ball && frame.opponent);
  EXPECT_NEAR(frame.pose->y_m, 2.14, 1e-9);
  EXPECT_NEAR(frame.ball->x_m, 0.0, 1e-9);
  EXPECT_NEAR(frame.ball->y_m, 0.27, 1e-9);
  EXPECT_NEAR(frame.opponent->y_m, 2.27, 1e-9);
  const FlightFrame flight = suite.flight(world);
  EXPECT_EQ(flight.t_exposure_ns, 160'000'000);
  ASSERT_TRUE(flight.ball);
  EXPECT_NEAR(flight.ball->y_m, 2.16 + 0.27, 1e-9);
  EXPECT_NEAR(flight.ball->z_m, 0.11, 1e-9);
}

TEST(Vision, ShowsTheKeeperWhereThereIsOneAndItIsNear) {
  for (const bool enabled : {false, true}) {
    Scenario s = noiseless();
    s.keeper.enabled = enabled;
    World world{s};
    SensorSuite suite{s};
    for (const double y_m : {4.0, 2.0}) {
      world.place(standing(1.0, y_m, 0.0), 1.0, kDraws);
      suite.begin(kDraws);
      suite.remember(world);
      run(world, suite, 10);
      const auto keeper = suite.vision(world).keeper;
      ASSERT_EQ(keeper.has_value(), enabled && y_m > 3.0) << "it is seen up to 6 m";
      if (!keeper) continue;
      EXPECT_NEAR(keeper->x_m, -1.0, 1e-9);
      EXPECT_NEAR(keeper->y_m, 5.0, 1e-9);
    }
  }
}

/// Frames of a robot that kicks at 0.1 s and stands.
std::vector<VisionFrame> frames_of_a_kick(const Scenario& s) {
  World world{s};
  SensorSuite suite{s};
  const Opportunity o = standing(0.0, 4.0, 0.0);
  world.place(o, 1.0, kDraws);
  suite.begin(kDraws);
  suite.remember(world);
  world.start_play(o);
  world.command({.drive = {}, .fire = Fire{100'000'000, 1, 40.0}});
  std::vector<VisionFrame> frames;
  for (int cycle = 0; cycle < 50; ++cycle) {
    run(world, suite, 1);
    frames.push_back(suite.vision(world));
  }
  return frames;
}

TEST(Vision, ShowsAKeeperThatGuessesOnItsWayOneLatencyAgo) {
  Scenario s = noiseless();
  s.kicker.delay_sd_s = 0.0;
  s.keeper.enabled = true;
  s.keeper.guess_m = 0.6;
  const std::vector<VisionFrame> frames = frames_of_a_kick(s);
  const auto seen_m = [&](double since_release_s) {  // the ball leaves at 0.16 s, and a frame is 0.06 s old
    return std::abs(frames.at(static_cast<std::size_t>(std::lround((since_release_s + 0.22) / 0.02)) - 1).keeper->x_m);
  };
  EXPECT_NEAR(seen_m(0.0), 0.0, 1e-9);
  EXPECT_NEAR(seen_m(0.2), 0.09, 0.01);
  EXPECT_NEAR(seen_m(0.3), 0.2025, 0.015);
  EXPECT_NEAR(seen_m(0.76), 0.6, 0.01);
}

TEST(Vision, OfAKeeperThatGuessesIsTheSameUntilItJumps) {
  Scenario s;
  s.keeper.enabled = true;
  const std::vector<VisionFrame> waits = frames_of_a_kick(s);
  s.keeper.guess_m = 0.6;
  const std::vector<VisionFrame> jumps = frames_of_a_kick(s);
  int moved = 0;
  for (std::size_t i = 0; i < waits.size(); ++i) {
    ASSERT_EQ(waits[i].keeper.has_value(), jumps[i].keeper.has_value());
    EXPECT_EQ(waits[i].pose.has_value(), jumps[i].pose.has_value());
    if (!waits[i].keeper) continue;
    const bool same = waits[i].keeper->x_m == jumps[i].keeper->x_m && waits[i].keeper->y_m == jumps[i].keeper->y_m;
    EXPECT_TRUE(same || i >= 7) << i;
    moved += !same;
  }
  EXPECT_GT(moved, 20);
}

TEST(Vision, LatencyMayLieBetweenSteps) {
  Scenario s = noiseless();
  s.vision.latency_s = 0.0123456;
  World world{s};
  SensorSuite suite{s};
  Opportunity o = standing(1.0, 2.0, 0.0);
  o.velocity = {0.0, 1.0, 0.0};
  world.place(o, 1.0, kDraws);
  suite.begin(kDraws);
  suite.remember(world);
  world.start_play(o);
  run(world, suite, 10);
  EXPECT_NEAR(suite.vision(world).pose->y_m, 2.2 - 0.0123456, 1e-9);
}

TEST(Vision, HasTheNoiseThatTheScenarioNames) {
  const Scenario s;
  World world{s};
  SensorSuite suite{s};
  double squares_x = 0, squares_h = 0, ball2 = 0, product = 0, slow_variance = 0;
  int seen = 0, missed = 0, runs = 0;
  for (std::uint32_t opportunity = 1; opportunity <= 400; ++opportunity) {
    const kicking::Draws draws{9, opportunity};
    world.place(standing(1.0, 2.0, 0.4), 1.0, draws);
    suite.begin(draws);
    suite.remember(world);
    double first = std::nan("");
    for (int i = 0; i < 12; ++i) {
      run(world, suite, 1);
      const VisionFrame frame = suite.vision(world);
      if (i < 3) continue;
      if (!frame.pose) {
        ++missed;
        continue;
      }
      ++seen;
      const double error = frame.pose->x_m - 1.0;
      squares_x += error * error;
      squares_h += std::pow(frame.pose->heading_rad - 0.4, 2);
      if (frame.ball) ball2 += std::pow(frame.ball->x_m, 2);
      if (std::isnan(first)) {
        first = error;
      } else if (i == 11) {
        product += first * error;
        ++runs;
      }
    }
    slow_variance = std::pow(s.vision.position_slow_sd_m, 2) * std::exp(-8 * 0.02 / 2.0);
  }
  EXPECT_NEAR(std::sqrt(squares_x / seen), 0.12, 0.01);
  EXPECT_NEAR(std::sqrt(squares_h / seen), std::sqrt(2e-4), 0.001);
  EXPECT_NEAR(std::sqrt(ball2 / seen), 0.02 + 0.02 * 0.27, 0.002);
  EXPECT_NEAR(product / runs, slow_variance, 0.004);  // the slow part stays
  EXPECT_NEAR(static_cast<double>(missed) / (seen + missed), 0.02, 0.01);
}

TEST(Wheels, HaveTheNoiseThatTheScenarioNames) {
  const Scenario s;
  World world{s};
  SensorSuite suite{s};
  double white2 = 0, gyro2 = 0;
  int count = 0;
  for (std::uint32_t opportunity = 1; opportunity <= 1000; ++opportunity, ++count) {
    const kicking::Draws draws{9, opportunity};
    world.place(standing(0, 0, 0), 1.0, draws);
    suite.begin(draws);
    const WheelSample sample = suite.wheels(world);
    white2 += sample.wheel_radps[1] * sample.wheel_radps[1];
    gyro2 += sample.gyro_radps * sample.gyro_radps;
  }
  EXPECT_NEAR(std::sqrt(white2 / count), 0.6, 0.06);
  EXPECT_NEAR(std::sqrt(gyro2 / count), std::hypot(0.02, 0.01), 0.003);
}

TEST(Vision, DoesNotSeeABallHighAbove) {
  const Scenario s = noiseless();
  World world{s};
  SensorSuite suite{s};
  const Opportunity o = standing(0.0, 0.0, 0.0);
  world.place(o, 1.0, kDraws);
  suite.begin(kDraws);
  world.start_play(o);
  world.command({.drive = {}, .fire = Fire{.t_ns = 0, .kick_id = 1, .power = 30}});
  run(world, suite, 25);
  ASSERT_TRUE(world.shot());
  EXPECT_FALSE(suite.vision(world).ball);
  ASSERT_TRUE(suite.flight(world).ball);
  EXPECT_GT(suite.flight(world).ball->z_m, 0.4);
}

}  // namespace
}  // namespace trivela::sim
