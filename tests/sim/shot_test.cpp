#include "sim/shot.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace trivela::sim {
namespace {

using kicking::Outcome;

/// An opponent that stands there.
std::array<OpponentBody, 1> at(const PlanPoint& place) {
  OpponentBody body;
  body.place({place.x_m, place.y_m, 0.11}, {0.0, 0.0, 0.0});
  return {body};
}

constexpr PlanPoint kNobody{50.0, 50.0};
const auto kFarAway = at(kNobody);

/// A shot without drag from (x, 3) that crosses the goal line 6 m on after one second, at the height z.
Shot fly(const Scenario& scenario, double x_cross, double z_cross, double x_start = 0.0, PlanPoint opponent = kNobody) {
  const double vz = z_cross - 0.11 + 0.5 * scenario.ball.gravity_mps2;
  Shot shot{scenario, {{{x_start, 3.0, 0.11}, {x_cross - x_start, 6.0, vz}}}, 0};
  for (std::int64_t t = 1; t <= 4000; ++t) shot.advance_to(t * 1'000'000, at(opponent));
  return shot;
}

Scenario airless() {
  Scenario s;
  s.ball.drag_coefficient = 0.0;
  return s;
}

struct Case {
  double x, z;
  Outcome outcome;
  double margin;
};

TEST(Shot, IsJudgedByWhereItCrossesTheGoalLine) {
  const Case cases[] = {{0.0, 0.5, Outcome::kOnTarget, 0.39},   {0.85, 0.5, Outcome::kOnTarget, 0.04},
                        {-0.85, 0.8, Outcome::kOnTarget, 0.04}, {0.0, 0.85, Outcome::kOnTarget, 0.04},
                        {0.9, 0.5, Outcome::kPost, 0.01},       {-1.2, 0.5, Outcome::kPost, 0.035},
                        {0.3, 0.95, Outcome::kBar, 0.06},       {0.3, 1.3, Outcome::kOver, 0.065},
                        {1.3, 0.5, Outcome::kWideRight, 0.065}, {-2.0, 2.0, Outcome::kWideLeft, 0.765}};
  const Scenario scenario = airless();
  for (const auto& c : cases) {
    SCOPED_TRACE(testing::Message() << c.x << ", " << c.z);
    const Shot shot = fly(scenario, c.x, c.z);
    ASSERT_TRUE(shot.result());
    EXPECT_EQ(shot.result()->outcome, c.outcome);
    ASSERT_TRUE(shot.result()->crossing);
    EXPECT_NEAR(shot.result()->crossing->x_m, c.x, 1e-4);
    EXPECT_NEAR(shot.result()->crossing->z_m, c.z, 1e-4);
    ASSERT_TRUE(shot.result()->margin_m);
    EXPECT_NEAR(*shot.result()->margin_m, c.margin, 1e-4);
    EXPECT_NEAR(static_cast<double>(shot.result()->t_ns), 1e9, 2e6);
  }
}

TEST(Shot, BouncesBackFromPostAndBarAndFliesOnBehindAGoal) {
  const Scenario scenario = airless();
  EXPECT_LT(fly(scenario, 1.0, 0.5).ball().position_m.y(), 9.0);
  EXPECT_LT(fly(scenario, 0.0, 1.0).ball().position_m.y(), 9.0);
  EXPECT_GT(fly(scenario, 0.0, 0.5).ball().position_m.y(), 9.0);
}

TEST(Shot, IsShortWhenItRestsOrTakesTooLong) {
  Scenario scenario;
  Shot resting{scenario, {{{0.0, 0.0, 0.11}, {0.0, 0.5, 0.0}}, true}, 0};
  for (std::int64_t t = 1; t <= 2000; ++t) resting.advance_to(t * 1'000'000, kFarAway);
  ASSERT_TRUE(resting.result());
  EXPECT_EQ(resting.result()->outcome, Outcome::kShort);
  EXPECT_FALSE(resting.result()->crossing);
  EXPECT_NEAR(*resting.result()->margin_m, 9.0 - resting.ball().position_m.y(), 1e-9);

  Shot slow{scenario, {{{0.0, 0.0, 0.11}, {0.0, 2.5, 0.0}}, true}, 0};
  for (std::int64_t t = 1; t <= 2999; ++t) slow.advance_to(t * 1'000'000, kFarAway);
  EXPECT_FALSE(slow.result());
  slow.advance_to(3'000'000'000, kFarAway);
  EXPECT_EQ(slow.result()->outcome, Outcome::kShort);
}

TEST(Shot, RollingInCountsAsOnTarget) {
  const Scenario scenario;
  Shot shot{scenario, {{{0.2, 7.0, 0.11}, {0.0, 3.0, 0.0}}, true}, 0};
  for (std::int64_t t = 1; t <= 1500; ++t) shot.advance_to(t * 1'000'000, kFarAway);
  ASSERT_TRUE(shot.result());
  EXPECT_EQ(shot.result()->outcome, Outcome::kOnTarget);
  EXPECT_NEAR(shot.result()->crossing->z_m, 0.11, 1e-9);
}

TEST(Shot, ABallThatBarelyCrossesHasASmallMargin) {
  Scenario scenario = airless();
  const double speed = std::sqrt(2.0 * scenario.ball.rolling_deceleration_mps2 * 1.02);  // rests 2 cm behind the line
  Shot shot{scenario, {{{0.0, 8.0, 0.11}, {0.0, speed, 0.0}}, true}, 0};
  for (std::int64_t t = 1; t <= 2900; ++t) shot.advance_to(t * 1'000'000, kFarAway);
  ASSERT_TRUE(shot.result());
  EXPECT_EQ(shot.result()->outcome, Outcome::kOnTarget);
  EXPECT_NEAR(*shot.result()->margin_m, 0.02, 2e-3);
}

TEST(Shot, IsBlockedByABodyInItsWayAndPassesOverOne) {
  const Scenario scenario = airless();
  const Shot blocked = fly(scenario, 0.0, 0.5, 0.0, {0.1, 3.7});
  EXPECT_EQ(blocked.result()->outcome, Outcome::kBlocked);
  EXPECT_FALSE(blocked.result()->crossing);
  EXPECT_FALSE(blocked.result()->margin_m);
  EXPECT_LT(blocked.ball().position_m.y(), 3.7);
  EXPECT_EQ(fly(scenario, 0.0, 0.5, 0.0, {0.1, 6.0}).result()->outcome, Outcome::kOnTarget);   // 1.2 m high there
  EXPECT_EQ(fly(scenario, 0.0, 0.5, 0.0, {0.38, 3.7}).result()->outcome, Outcome::kOnTarget);  // passes beside it
}

TEST(Shot, AnyOfTheOpponentsBlocks) {
  const Scenario scenario = airless();
  for (std::size_t blocker = 0; blocker < 3; ++blocker) {
    std::array<OpponentBody, 3> bodies{at(kNobody)[0], at(kNobody)[0], at(kNobody)[0]};
    bodies[blocker] = at({0.1, 3.7})[0];
    Shot shot{scenario, {{{0.0, 3.0, 0.11}, {0.0, 6.0, 5.3}}}, 0};
    for (std::int64_t t = 1; t <= 60; ++t) shot.advance_to(t * 20'000'000, bodies);
    ASSERT_TRUE(shot.result());
    EXPECT_EQ(shot.result()->outcome, Outcome::kBlocked);
  }
}

TEST(Shot, AKeeperHasWhatItReachesInTime) {
  Scenario scenario = airless();
  EXPECT_FALSE(fly(scenario, 0.0, 0.5).result()->saved);  // none
  scenario.keeper.enabled = true;
  scenario.keeper.side_extension_m = scenario.keeper.up_extension_m = 0.0;
  Guard& guard = scenario.keeper.guard;
  guard.sight_sd_mps = guard.overlap_m = 0.0;
  guard.reaction_s = 0.8;
  guard.acceleration_mps2 = 200.0;
  guard.speed_mps = 1.0;  // 0.2 m in the second that the shot takes, plus 0.26 m and the ball's 0.11 m
  for (const double side : {-1.0, 1.0}) {
    const Shot saved = fly(scenario, side * 0.56, 0.5);
    EXPECT_EQ(saved.result()->outcome, Outcome::kOnTarget);  // Table 2 counts it
    EXPECT_TRUE(saved.result()->saved);
    EXPECT_LT(saved.ball().position_m.y(), 9.0);
    EXPECT_FALSE(fly(scenario, side * 0.58, 0.5).result()->saved);
    EXPECT_FALSE(fly(scenario, side * 1.1, 0.5).result()->saved);  // post
  }
  guard.height_m = 0.4;
  EXPECT_FALSE(fly(scenario, 0.0, 0.52).result()->saved);
  EXPECT_TRUE(fly(scenario, 0.0, 0.5).result()->saved);
}

TEST(Shot, AKeeperBeforeItsLineStopsThereWhatWouldGoIn) {
  Scenario scenario = airless();
  scenario.keeper.enabled = true;
  scenario.keeper.guard.sight_sd_mps = 0.0;
  scenario.keeper.guard.height_m = 2.0;
  scenario.keeper.advance_m = 0.6;
  const Shot saved = fly(scenario, 0.2, 0.5);
  ASSERT_TRUE(saved.result());
  EXPECT_TRUE(saved.result()->saved);
  EXPECT_EQ(saved.result()->outcome, Outcome::kOnTarget);
  EXPECT_NEAR(saved.result()->crossing->x_m, 0.2, 1e-3) << "where it would have crossed";
  EXPECT_NEAR(saved.result()->crossing->z_m, 0.5, 5e-3);
  EXPECT_NEAR(static_cast<double>(saved.result()->t_ns), 0.9e9, 2e6) << "5.4 of 6 m";
  EXPECT_LT(saved.ball().position_m.y(), 8.4) << "it came back";
  EXPECT_EQ(fly(scenario, 1.3, 0.5).result()->outcome, Outcome::kWideRight) << "it leaves that alone";
  EXPECT_EQ(fly(scenario, 0.3, 1.3).result()->outcome, Outcome::kOver);
  // Between the ball and the goal's middle: a tenth of the way.
  EXPECT_NEAR(keeper_place(scenario, {2.0, 3.0, 0.11}).x_m, 0.2, 1e-12);
  EXPECT_NEAR(keeper_place(scenario, {2.0, 3.0, 0.11}).y_m, 8.4, 1e-12);
  scenario.keeper.advance_m = 0.0;
  EXPECT_EQ(keeper_place(scenario, {2.0, 3.0, 0.11}).x_m, 0.0);
}

TEST(Shot, AKeeperThatGuessesLeavesTheMiddleWhateverTheBallDoes) {
  Scenario scenario = airless();
  scenario.keeper.enabled = true;
  scenario.keeper.guess_m = 0.6;
  int left = 0, right = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto saved = [&](double x_cross_m) {
      const double vz = 0.5 - 0.11 + 0.5 * scenario.ball.gravity_mps2;
      Shot shot{scenario, {{{0.0, 3.0, 0.11}, {x_cross_m, 6.0, vz}}}, 0, kicking::Draws{seed, 0}};
      for (std::int64_t t = 1; t <= 1100; ++t) shot.advance_to(t * 1'000'000, kFarAway);
      return shot.result()->saved;
    };
    EXPECT_FALSE(saved(0.0)) << seed;
    EXPECT_NE(saved(-0.6), saved(0.6)) << seed;
    ++(saved(-0.6) ? left : right);
  }
  EXPECT_GT(left, 8);
  EXPECT_GT(right, 8);
}

TEST(Shot, AKeeperThatGuessesIsOnItsWayFromTheReleaseOn) {
  Scenario scenario = airless();
  const auto at_s = [&](double t_s, std::uint64_t seed = 3) {
    const Shot shot{scenario, {{{2.0, 3.0, 0.11}, {0.0, 6.0, 5.0}}}, 1'000'000'000, kicking::Draws{seed, 0}};
    return shot.jumping_keeper(1'000'000'000 + kicking::nanoseconds(t_s));
  };
  scenario.keeper.guess_m = 0.6;
  EXPECT_FALSE(at_s(0.2)) << "there is none";
  scenario.keeper.enabled = true;
  EXPECT_EQ(at_s(0.0)->x_m, 0.0);
  EXPECT_EQ(at_s(0.0)->y_m, 9.0);
  EXPECT_NEAR(std::abs(at_s(0.2)->x_m), 0.5 * 4.5 * 0.04, 2e-3);
  EXPECT_NEAR(std::abs(at_s(0.8)->x_m), 0.6, 5e-3);
  EXPECT_EQ(at_s(0.8)->x_m > 0.0, at_s(0.2)->x_m > 0.0);
  int right = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) right += at_s(0.8, seed)->x_m > 0.0;
  EXPECT_GT(right, 8);
  EXPECT_LT(right, 32);
  scenario.keeper.advance_m = 0.6;
  EXPECT_NEAR(at_s(0.0)->x_m, 0.2, 1e-12) << "from where it stood";
  EXPECT_NEAR(std::abs(at_s(0.8)->x_m - 0.2), 0.6, 5e-3);
  scenario.keeper.guess_m = 0.0;
  EXPECT_FALSE(at_s(0.2)) << "it waits";
}

TEST(Shot, WhatAKeeperMistakesIsItsOwnDraw) {
  Scenario scenario = airless();
  scenario.keeper.enabled = true;
  scenario.keeper.guard.sight_sd_mps = 1.5;
  const auto saved = [&](std::uint32_t opportunity) {
    Shot shot{scenario, {{{0.0, 3.0, 0.11}, {0.8, 6.0, 5.3}}}, 0, kicking::Draws{1, opportunity}};
    for (std::int64_t t = 1; t <= 60; ++t) shot.advance_to(t * 20'000'000, at(kNobody));
    return shot.result()->saved;
  };
  int n = 0;
  for (std::uint32_t i = 1; i <= 200; ++i) {
    EXPECT_EQ(saved(i), saved(i));
    n += saved(i);
  }
  EXPECT_GT(n, 10);
  EXPECT_LT(n, 190);
}

TEST(Shot, SaysWhetherItTouchedTheFloorBeforeTheLine) {
  const Scenario scenario;
  EXPECT_FALSE(fly(scenario, 0.0, 0.7).result()->bounced);
  Shot low{scenario, {{{0.0, 3.0, 0.11}, {0.0, 7.0, 3.0}}}, 0};  // down after 0.6 s
  for (std::int64_t t = 1; t <= 150; ++t) low.advance_to(t * 20'000'000, at(kNobody));
  ASSERT_TRUE(low.result()->crossing);
  EXPECT_TRUE(low.result()->bounced);
  Shot rolling{scenario, {{{0.0, 8.0, 0.11}, {0.0, 5.0, 0.0}}, true}, 0};
  for (std::int64_t t = 1; t <= 150; ++t) rolling.advance_to(t * 20'000'000, at(kNobody));
  EXPECT_TRUE(rolling.result()->bounced);
}

/// Whether a defender stops a ball that crosses their line, 1 m before the goal's, at that height on its way to z.
TEST(Shot, DefendersStopWhatComesLow) {
  Scenario scenario = airless();
  scenario.defenders.count = 1.0;
  scenario.defenders.spread_sd_m = 0.0;
  scenario.defenders.guard.sight_sd_mps = 0.0;
  const auto outcome = [&](double vy_mps, double vz_mps, double vx_mps = 0.0) {
    Shot shot{scenario, {{{0.0, 3.0, 0.11}, {vx_mps, vy_mps, vz_mps}}}, 0};
    for (std::int64_t t = 1; t <= 200; ++t) shot.advance_to(t * 20'000'000, at(kNobody));
    return *shot.result();
  };
  const ShotResult lob = outcome(6.0, 5.4);  // a lob of a second: 1.21 m over the floor there, 0.6 m at the line
  EXPECT_EQ(lob.outcome, Outcome::kOnTarget);
  EXPECT_FALSE(lob.bounced);
  const ShotResult low = outcome(7.0, 2.0);
  EXPECT_EQ(low.outcome, Outcome::kBlocked);
  EXPECT_TRUE(low.bounced);
  EXPECT_FALSE(low.crossing);
  scenario.defenders.guard.reaction_s = 2.0;  // it never moves
  EXPECT_EQ(outcome(7.0, 2.0, 0.9).outcome, Outcome::kOnTarget) << "past its side: 0.64 m away";
  scenario.defenders.guard.reaction_s = 0.25;
  EXPECT_EQ(outcome(7.0, 2.0, 0.9).outcome, Outcome::kBlocked);
  scenario.defenders.count = 0.0;
  EXPECT_EQ(outcome(7.0, 2.0).outcome, Outcome::kOnTarget);
}

TEST(Shot, FromBehindTheLineIsJudgedWhereItStarts) {
  const Scenario scenario;
  const Shot shot{scenario, {{{3.0, 9.2, 0.11}, {0.0, 5.0, 3.0}}}, 0};
  ASSERT_TRUE(shot.result());
  EXPECT_EQ(shot.result()->outcome, Outcome::kWideRight);
}

TEST(Shot, MirroredShotsHaveMirroredResults) {
  const Scenario scenario;
  for (const double x : {0.3, 0.88, 1.1, 1.24, 2.0}) {
    const Shot right = fly(scenario, x, 0.6, 0.5), left = fly(scenario, -x, 0.6, -0.5);
    EXPECT_EQ(right.result()->crossing->x_m, -left.result()->crossing->x_m);
    EXPECT_EQ(right.result()->margin_m, left.result()->margin_m);
  }
}

TEST(Margin, IsTheLeastChangeThatChangesTheOutcome) {
  const kicking::Goal goal;
  const kicking::Ball ball;
  for (double x = -1.603; x <= 1.6; x += 0.083) {
    for (double z = 0.113; z <= 1.6; z += 0.079) {
      const double margin = margin_m({x, z}, goal, ball);
      const auto here = kicking::classify(x, z, goal, ball);
      bool changes = false;
      for (int i = 0; i < 360; ++i) {
        const double a = i * M_PI / 180.0;
        const auto at = [&](double r) {
          return kicking::classify(x + r * std::cos(a), z + r * std::sin(a), goal, ball);
        };
        EXPECT_EQ(at(margin - 1e-6), here) << x << ", " << z;
        changes = changes || at(margin + 1e-6) != here;
      }
      EXPECT_TRUE(changes) << x << ", " << z;
    }
  }
}

}  // namespace
}  // namespace trivela::sim
