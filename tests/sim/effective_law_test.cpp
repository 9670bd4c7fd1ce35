#include <gtest/gtest.h>

#include <cmath>

#include "kicking/outcome/crossing_spread.hpp"
#include "sim/kicker/flight.hpp"
#include "sim/kicker/kicker.hpp"

namespace trivela::sim {
namespace {

using kicking::Elevation;

/// Where a kick of a robot that drives at (sideways, forward) crosses a line at `distance_m`: by the drag-free law with
/// the effective exit, and in the air.
struct Crossings {
  double law_x_m, law_z_m, flown_x_m, flown_z_m;
};

Crossings cross(double power, double distance_m, double sideways_mps, double forward_mps) {
  const Scenario scenario;
  const Exit exit = exit_at(scenario.kicker, power);
  const Exit seen = effective_exit(exit, scenario.ball);
  kicking::RobotModel robot;
  robot.transfer_exact = {1.0, 1.0, 1.0};
  const kicking::CrossingSpread law =
      kicking::crossing_spread({{0, 0}, {0, 1}, {sideways_mps, forward_mps}, 0.0},
                               {seen.speed_mps, Elevation(seen.elevation_rad)}, robot, {}, distance_m);
  BallMotion ball{{{0, 0, scenario.ball.radius_m},
                   {sideways_mps, exit.speed_mps * std::cos(exit.elevation_rad) + forward_mps,
                    exit.speed_mps * std::sin(exit.elevation_rad)}}};
  BallMotion before = ball;
  for (int i = 0; i < 3000 && ball.position_m.y() < distance_m; ++i) {
    before = ball;
    advance(ball, scenario.ball, 1e-3);
  }
  const double part = (distance_m - before.position_m.y()) / (ball.position_m.y() - before.position_m.y());
  return {law.x_m, law.z_m, std::lerp(before.position_m.x(), ball.position_m.x(), part),
          std::lerp(before.position_m.z(), ball.position_m.z(), part)};
}

/// The least power that crosses at 0.4 m by the law, to a quarter of a set-point.
double power_for(double distance_m, double forward_mps) {
  double power = 15.0;
  while (power < 50.0 && cross(power, distance_m, 0.0, forward_mps).law_z_m < 0.4) power += 0.25;
  return power;
}

TEST(EffectiveLaw, OfAStandingRobotHitsTheFlightWithDragToTwoCentimetres) {
  for (const double distance : {4.0, 5.0, 6.0, 7.0, 8.0, 9.0}) {
    const Crossings c = cross(power_for(distance, 0.0), distance, 0.0, 0.0);
    EXPECT_NEAR(c.flown_z_m, c.law_z_m, 0.02) << distance;
  }
}

TEST(EffectiveLaw, OfADrivingRobotIsHighByAFewCentimetresAMetreASecond) {
  for (const double distance : {4.0, 5.0, 6.0, 7.0, 8.0, 9.0}) {
    for (const double forward : {0.5, 1.0, 1.5}) {
      const Crossings c = cross(power_for(distance, forward), distance, 0.5, forward);
      EXPECT_LT(c.flown_z_m, c.law_z_m + 0.005) << distance << ' ' << forward;
      EXPECT_GT(c.flown_z_m, c.law_z_m - 0.012 * distance * forward) << distance << ' ' << forward;
      EXPECT_NEAR(c.flown_x_m, c.law_x_m, 0.04) << distance << ' ' << forward;
    }
  }
}

}  // namespace
}  // namespace trivela::sim
