#include "kicking/outcome/crossing_spread.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kicking/alignment/release_predictor.hpp"
#include "kicking/geometry/frames.hpp"
#include "kicking/outcome/outcome.hpp"

namespace trivela::kicking {
namespace {

constexpr Goal kGoal;
constexpr double kBounce = 0.9;

ReleaseState at(double x_m, double y_m, double heading_rad, const Twist& twist = {}) {
  const Eigen::Vector2d velocity = rotate({twist.vx_mps, twist.vy_mps}, heading_rad);
  return {{x_m, y_m}, direction(heading_rad), velocity, twist.omega_radps};
}

/// The same kick with every error drawn, by the full laws: does it go in, a ball that bounces counted by its chance?
double drawn(std::mt19937& generator, const ReleaseState& release, const KickExit& kick, const RobotModel& robot,
             const StateSpread& state) {
  std::normal_distribution<double> normal;
  const auto n = [&] { return normal(generator); };
  const KickSpreads& spread = robot.spreads;
  const double r = robot.ball_offset_m;
  const double heading_error = state.heading_rad * n(), late_s = spread.delay_sd_s * n();
  const double omega = release.omega_radps + state.turn_rate_radps * n();
  const double turned = heading_error + (omega - release.omega_radps) * robot.delay_s + omega * late_s;
  const Eigen::Vector2d velocity_error = state.speed_mps * Eigen::Vector2d(n(), n());
  const Eigen::Vector2d velocity = release.velocity_mps + velocity_error;
  const Eigen::Vector2d centre = release.ball_m - r * release.forward + state.position_m * Eigen::Vector2d(n(), n()) +
                                 velocity_error * robot.delay_s + velocity * late_s;
  const Eigen::Vector2d forward = rotate(release.forward, turned);
  const ReleaseState moved{centre + r * forward, forward, rotate(velocity, heading_error), omega};
  Transfer transfer = robot.transfer_exact;
  const double along = 1.0 + spread.transfer_sd_ratio * n();
  transfer.forward *= along;
  transfer.backward *= along;
  transfer.lateral *= 1.0 + spread.transfer_sd_ratio * n();
  const double v = kick.v_kick_mps * (1.0 + spread.speed_sd_ratio * n() + spread.table_sd_ratio * n());
  const double angle = kick.exit_angle.angle_rad + spread.exit_angle_sd_rad * n();
  const Eigen::Vector2d w =
      v * std::cos(angle) * rotate(forward, spread.direction_sd_rad * n()) + moved.carried_mps(transfer, r);
  const double t = (kGoal.y_m - moved.ball_m.y()) / w.y();
  const double x = moved.ball_m.x() + w.x() * t;
  const double z = robot.ball.radius_m + v * std::sin(angle) * t - 0.5 * kGravity_mps2 * t * t;
  if (!(t > 0.0) || std::abs(x) >= kGoal.clean_half_width_m() || z >= kGoal.clean_height_m()) return 0.0;
  return z < robot.ball.radius_m ? kBounce : 1.0;
}

struct Scene {
  const char* name;
  ReleaseState release;
  KickExit kick;
};

const Scene kScenes[]{{"straight", at(0, 3, 0), {7.6, Elevation(radians(36.78))}},
                      {"far and on the run", at(1.5, 0.5, 0.2, {0.4, 1.2, 0.0}), {8.4, Elevation(radians(36.78))}},
                      {"turning", at(-1, 4, -0.35, {-0.3, 0.8, 2.3}), {7.0, Elevation(radians(36.0))}},
                      {"at the post", at(0.9, 4, 0.0, {0.0, 0.5, 0.0}), {7.0, Elevation(radians(36.0))}},
                      {"high", at(0, 3.5, 0, {0, 0.3, 0}), {7.9, Elevation(radians(36.78))}}};

TEST(CrossingSpread, ProbabilityIsThatOfDrawnErrors) {
  const RobotModel robot;
  const StateSpread state{0.12, radians(0.8), 0.05, 0.05};
  for (const Scene& scene : kScenes) {
    std::mt19937 generator(7);
    constexpr int kDraws = 40000;
    double sum = 0.0;
    for (int i = 0; i < kDraws; ++i) sum += drawn(generator, scene.release, scene.kick, robot, state);
    const CrossingSpread spread = crossing_spread(scene.release, scene.kick, robot, state, kGoal.y_m);
    // First order, x and z independent; the draws themselves are good to 0.0075 (3 sd).
    EXPECT_NEAR(p_on_target(spread, kBounce, kGoal), sum / kDraws, 0.02) << scene.name;
  }
}

TEST(CrossingSpread, MeanIsTheReleasePredictors) {
  const RobotModel robot;
  const Twist twist{0.4, 1.0, 0.8};
  const Pose pose{1.0, 3.0, 0.1};
  const KickAction action{8.0, radians(36.78), robot.transfer_exact, 0.0, robot.ball_offset_m};
  const auto predicted = predict_crossing(pose, twist, action, kGoal.y_m);
  const Eigen::Vector2d ball = to_field(pose, {0.0, robot.ball_offset_m});
  const CrossingSpread spread = crossing_spread(at(ball.x(), ball.y(), pose.heading_rad, twist),
                                                {8.0, Elevation(radians(36.78))}, robot, {}, kGoal.y_m);
  ASSERT_TRUE(predicted);
  EXPECT_NEAR(spread.x_m, predicted->x_m, 1e-12);
  EXPECT_NEAR(spread.z_m, predicted->z_m, 1e-12);
  EXPECT_NEAR(spread.t_flight_s, predicted->t_flight_s, 1e-12);
}

TEST(CrossingSpread, HeightSpreadOfAStraightKickIsThatOfTheHeightSensitivities) {
  RobotModel robot;
  robot.spreads = {0.02, radians(0.5), 0.0, 0.0, 0.0, 0.0};
  const KickAtLine line{7.6, radians(36.78), 1.0, 6.0};
  const CrossingSpread spread =
      crossing_spread(at(0, 3, 0, {0, 1, 0}), {7.6, Elevation(radians(36.78))}, robot, {0, 0, 0.0, 0}, kGoal.y_m);
  const InsideProbability known = p_inside(line, {0.02, radians(0.5), 0.0, 0.1}, 0.0, kGoal);
  EXPECT_NEAR(spread.z_m, known.z_m, 1e-12);
  EXPECT_NEAR(spread.sd_z_m, known.sd_z_m, 1e-12);
}

TEST(CrossingSpread, MirrorsLeftAndRight) {
  const RobotModel robot;
  const StateSpread state{0.1, 0.01, 0.05, 0.05};
  const CrossingSpread left =
      crossing_spread(at(-1, 3, -0.2, {-0.4, 1.0, -0.9}), {7.5, Elevation(0.64)}, robot, state, 9.0);
  const CrossingSpread right =
      crossing_spread(at(1, 3, 0.2, {0.4, 1.0, 0.9}), {7.5, Elevation(0.64)}, robot, state, 9.0);
  EXPECT_NEAR(left.x_m, -right.x_m, 1e-12);
  EXPECT_NEAR(left.sd_x_m, right.sd_x_m, 1e-12);
  EXPECT_NEAR(left.z_m, right.z_m, 1e-12);
  EXPECT_NEAR(left.sd_z_m, right.sd_z_m, 1e-12);
}

TEST(CrossingSpread, KicksAwayFromTheGoalAreWorthNothing) {
  const CrossingSpread away = crossing_spread(at(0, 3, 3.0), {8.0, Elevation(0.64)}, {}, {}, 9.0);
  EXPECT_TRUE(std::isnan(away.x_m));
  EXPECT_EQ(p_on_target(away, kBounce, kGoal), 0.0);
}

TEST(BestHeight, IsTheMaximumOverASweep) {
  for (const double sd : {0.05, 0.1, 0.18, 0.25}) {
    const auto p = [&](double z) { return p_on_target({0.0, z, 0.9, 0.2, sd}, kBounce, kGoal); };
    const double best = BestHeight(kBounce, kGoal)(sd);
    for (double z = 0.0; z < 1.0; z += 0.005) EXPECT_LE(p(z), p(best) + 1e-9) << "sd " << sd << " z " << z;
  }
}

TEST(BestHeight, IsTheMiddleWhereABounceIsAMissAndTheFloorWhereItCountsInFull) {
  EXPECT_NEAR(BestHeight(0.0, kGoal)(0.2), 0.5 * (0.89 + 0.11), 1e-12);
  EXPECT_EQ(BestHeight(1.0, kGoal)(0.2), 0.11);
  EXPECT_GT(BestHeight(0.9, kGoal)(0.1), BestHeight(0.9, kGoal)(0.2));
}

}  // namespace
}  // namespace trivela::kicking
