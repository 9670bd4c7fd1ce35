#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kicking/geometry/time.hpp"
#include "sim/robot_body.hpp"
#include "sim/shot.hpp"
#include "tests/sim/played_match.hpp"

// The physics takes one step a cycle. It must not matter.
namespace trivela::sim {
namespace {

/// Drives in all directions and turns, another way every fifth of a second.
kicking::Twist wild(double t_s) {
  const double phase = std::floor(t_s / 0.2);
  return {1.5 * std::sin(1.3 * phase), 1.8 * std::cos(0.7 * phase), 2.5 * std::sin(2.1 * phase + 0.5)};
}

TEST(Substep, ARobotThatFollowsAnythingIsWhereFineStepsPutIt) {
  RobotBody coarse{Robot{}}, fine{Robot{}};
  for (RobotBody* body : {&coarse, &fine}) body->place({0.0, 0.0, 0.3}, {0.4, 1.2, 0.0});
  for (int cycle = 0; cycle < 200; ++cycle) {
    const auto set_point = wild(cycle * 0.02);
    coarse.follow(set_point);
    fine.follow(set_point);
    coarse.advance(0.02);
    for (int i = 0; i < 200; ++i) fine.advance(1e-4);
    ASSERT_NEAR(coarse.pose().heading_rad, fine.pose().heading_rad, 1e-9);
    ASSERT_NEAR(coarse.pose().x_m, fine.pose().x_m, 2e-3) << cycle;
    ASSERT_NEAR(coarse.pose().y_m, fine.pose().y_m, 2e-3) << cycle;
    ASSERT_NEAR(coarse.twist().vx_mps, fine.twist().vx_mps, 5e-3) << cycle;
    ASSERT_NEAR(coarse.twist().vy_mps, fine.twist().vy_mps, 5e-3) << cycle;
  }
}

/// Drives by the clock of each possession, and kicks.
Policy clockwork(double power, double after_s) {
  return [=, start = std::int64_t{0}, fired = false](const Sensors& s) mutable {
    if (!s.referee.playing) {
      start = s.t_ns;
      fired = false;
      return Commands{};
    }
    const double t_s = kicking::seconds(s.t_ns - start);
    Commands commands{.drive = wild(t_s), .fire = {}};
    if (!fired && t_s >= after_s) {
      commands.fire = Fire{s.t_ns + 7'300'000, static_cast<std::int64_t>(s.referee.possession_id), power};
      fired = true;
    }
    return commands;
  };
}

TEST(Substep, KicksAndPossessionsComeOutAsWithFineSteps) {
  Scenario coarse, fine;
  fine.substep_s = 0.0005;
  int crossed = 0, blocked = 0, disputed = 0, compared = 0;
  for (const double power : {15.0, 25.0, 35.0, 50.0}) {
    const Record a = play(coarse, 9, 1, 1.5, clockwork(power, 0.3));
    const Record b = play(fine, 9, 1, 1.5, clockwork(power, 0.3));
    // By id: where a flight ends some microseconds over the end of a cycle, the matches' clocks part.
    ASSERT_NEAR(static_cast<double>(a.possessions.size()), static_cast<double>(b.possessions.size()), 1.0);
    for (std::size_t i = 0; i < std::min(a.possessions.size(), b.possessions.size()); ++i) {
      const PossessionTruth &p = a.possessions[i], &q = b.possessions[i];
      ASSERT_EQ(p.possession_id, q.possession_id);
      EXPECT_EQ(p.ending, q.ending);
      if (p.ending != PossessionEnd::kDisputed) continue;
      EXPECT_NEAR(static_cast<double>((p.t_ns - p.start_t_ns) - (q.t_ns - q.start_t_ns)), 0.0, 1000.0);
      ++disputed;
    }
    for (std::size_t i = 0; i < std::min(a.kicks.size(), b.kicks.size()); ++i) {
      const KickTruth &p = a.kicks[i], &q = b.kicks[i];
      ASSERT_EQ(p.possession_id, q.possession_id);
      EXPECT_NEAR(p.release_position_m.x(), q.release_position_m.x(), 1e-3);
      EXPECT_NEAR(p.release_position_m.y(), q.release_position_m.y(), 1e-3);
      EXPECT_NEAR(p.release_velocity_mps.x(), q.release_velocity_mps.x(), 3e-3);
      EXPECT_NEAR(p.release_velocity_mps.y(), q.release_velocity_mps.y(), 3e-3);
      ++compared;
      if (p.outcome != q.outcome) {  // only on an edge
        EXPECT_LT(std::min(p.margin_m.value_or(1.0), q.margin_m.value_or(1.0)), 5e-3);
        continue;
      }
      blocked += p.outcome == kicking::Outcome::kBlocked;
      ASSERT_EQ(p.crossing.has_value(), q.crossing.has_value());
      if (!p.crossing) continue;
      EXPECT_NEAR(p.crossing->x_m, q.crossing->x_m, 6e-3) << p.possession_id;
      EXPECT_NEAR(p.crossing->z_m, q.crossing->z_m, 6e-3) << p.possession_id;
      ++crossed;
    }
  }
  EXPECT_GT(compared, 40);
  EXPECT_GT(crossed, 10);
  EXPECT_GT(blocked, 0);
  EXPECT_GT(disputed, 5);
}

/// A released ball, stepped to its end.
Shot flown(const Scenario& scenario, const BallMotion& released, std::int64_t step_ns, const PlanPoint& opponent) {
  OpponentBody body;
  body.place({opponent.x_m, opponent.y_m, 0.11}, {0.0, 0.0, 0.0});
  Shot shot{scenario, released, 0};
  for (std::int64_t t_ns = step_ns; !shot.result(); t_ns += step_ns) shot.advance_to(t_ns, {&body, 1});
  return shot;
}

TEST(Substep, AShotCrossesWithinAMillimetreOfFineSteps) {
  const Scenario scenario;
  int crossed = 0, blocked = 0, bounced = 0;
  for (double speed = 3.0; speed <= 13.0; speed += 0.61) {
    for (double elevation = 0.0; elevation <= 0.9; elevation += 0.11) {
      for (const double y : {1.0, 4.2, 7.1}) {
        for (const double opponent_x : {50.0, 0.35, -0.1}) {
          const double forward = speed * std::cos(elevation);
          const BallMotion released{{{0.4, y, 0.11}, {-0.08 * forward, forward, speed * std::sin(elevation)}}};
          const PlanPoint opponent{opponent_x, y + 1.0};
          const Shot a = flown(scenario, released, 20'000'000, opponent);
          const Shot b = flown(scenario, released, 100'000, opponent);
          SCOPED_TRACE(testing::Message() << speed << " m/s, " << elevation << " rad, y " << y << ", " << opponent_x);
          ASSERT_EQ(a.result()->outcome, b.result()->outcome);
          blocked += a.result()->outcome == kicking::Outcome::kBlocked;
          if (!a.result()->crossing) continue;
          EXPECT_NEAR(a.result()->crossing->x_m, b.result()->crossing->x_m, 1e-3);
          EXPECT_NEAR(a.result()->crossing->z_m, b.result()->crossing->z_m, 1e-3);
          ++crossed;
          bounced += a.result()->crossing->z_m < 0.3;
        }
      }
    }
  }
  EXPECT_GT(crossed, 500);
  EXPECT_GT(blocked, 30);
  EXPECT_GT(bounced, 50);
}

}  // namespace
}  // namespace trivela::sim
