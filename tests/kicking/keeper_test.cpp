#include "kicking/outcome/opponents.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/guard.hpp"

namespace trivela::kicking {
namespace {

constexpr double kBounce = 0.9;

CrossingSpread crossing(double x_m, double z_m, double t_s = 0.7, double sd_m = 0.1) {
  return {.x_m = x_m, .z_m = z_m, .t_flight_s = t_s, .sd_x_m = sd_m, .sd_z_m = sd_m};
}

double p_goal(const CrossingSpread& there, const KeeperConfig& keeper, const KeeperPlace& place = {}) {
  return goal_chance(there, kBounce, keeper, place, {}).p_goal;
}

TEST(Keeper, WithinItsReactionItHasItsOwnWidth) {
  const KeeperConfig keeper;
  for (const double t_s : {0.0, 0.1, 0.25}) EXPECT_DOUBLE_EQ(keeper_reach_m(keeper, t_s), 0.3 + 0.11);
}

TEST(Keeper, ReachByHand) {
  // h = 0.41; v / a = 0.444 s. After 0.2 s of driving at 4.5 m/s2 it is 0.09 m away and still speeds up:
  // it would brake for its own stop from 0.9^2 / 9 = 0.09 m on, less than h.
  const KeeperConfig keeper;
  EXPECT_NEAR(keeper_reach_m(keeper, 0.45), 0.41 + 0.09, 1e-12);
  // 0.5 s: at 2 m/s it would brake 0.444 m before its stop, more than h: T = 0.5 + sqrt(0.82 / 4.5) = 0.92687.
  EXPECT_NEAR(keeper_reach_m(keeper, 0.75), 2.0 * (0.92687 - 2.0 / 4.5), 1e-4);
}

TEST(Keeper, ReachGrowsWithTheFlightWithoutAStep) {
  const KeeperConfig keeper;
  double last_m = keeper_reach_m(keeper, 0.0);
  for (double t_s = 0.001; t_s < 2.0; t_s += 0.001) {
    const double reach_m = keeper_reach_m(keeper, t_s);
    EXPECT_GE(reach_m, last_m);
    EXPECT_LT(reach_m, last_m + 0.004) << t_s;
    last_m = reach_m;
  }
}

// The simulator's keeper drives in steps by another code; its eyes are perfect here.
TEST(Keeper, ReachesAsFarAsOneThatDrivesThere) {
  for (const double speed : {1.0, 2.0, 3.5}) {
    for (const double t_s : {0.3, 0.5, 0.7, 0.9, 1.2}) {
      const KeeperConfig keeper{.speed_mps = speed};
      const double reach_m = keeper_reach_m(keeper, t_s);
      sim::Guard guard;
      guard.speed_mps = speed;
      const auto stops = [&](double x_m) {
        return std::abs(sim::guard_place_m(guard, 0.0, {{x_m, 0.5}, t_s, 0.11}, {}) - x_m) <= 0.41;
      };
      EXPECT_TRUE(stops(reach_m - 0.02)) << speed << ' ' << t_s;
      EXPECT_FALSE(stops(reach_m + 0.02)) << speed << ' ' << t_s;
    }
  }
}

TEST(Keeper, AGoalIsNeverLikelierThanABallOnTarget) {
  const Goal goal;
  for (double x_m = -1.5; x_m <= 1.5; x_m += 0.25)
    for (double z_m = 0.1; z_m <= 1.2; z_m += 0.2)
      for (const double t_s : {0.2, 0.5, 0.9})
        for (const double sd_m : {0.0, 0.02, 0.2}) {
          const CrossingSpread there = crossing(x_m, z_m, t_s, sd_m);
          const double p = p_goal(there, {});
          EXPECT_GE(p, 0.0);
          EXPECT_LE(p, p_on_target(there, kBounce, goal) + 1e-9) << x_m << ' ' << z_m << ' ' << t_s << ' ' << sd_m;
        }
}

TEST(Keeper, WithoutWidthAndHeightItIsNobody) {
  const KeeperConfig nobody{.speed_mps = 0.0, .half_width_m = -0.11, .height_m = 0.0, .sd_m = 0.0, .miss_ratio = 0.0};
  for (double x_m = -1.2; x_m <= 1.2; x_m += 0.3)
    EXPECT_NEAR(p_goal(crossing(x_m, 0.5), nobody), p_on_target(crossing(x_m, 0.5), kBounce, {}), 1e-9);
}

TEST(Keeper, CornersAreWorthMoreThanTheMiddleAndTheFarOneMost) {
  const double middle = p_goal(crossing(0.0, 0.5, 0.5), {});
  const double right = p_goal(crossing(0.7, 0.5, 0.5), {});
  EXPECT_GT(right, middle + 0.2);
  EXPECT_DOUBLE_EQ(right, p_goal(crossing(-0.7, 0.5, 0.5), {})) << "it stands in the middle";
  EXPECT_GT(p_goal(crossing(0.7, 0.5, 0.5), {}, {-0.3, 0.05}), right) << "it stands on the left";
  EXPECT_LT(p_goal(crossing(0.7, 0.5, 0.5), {}, {0.3, 0.05}), right);
}

TEST(Keeper, OneThatGuessesHasOneSideAndNotTheMiddle) {
  const KeeperConfig keeper{.sd_m = 0.0, .miss_ratio = 0.0};
  const KeeperPlace guesses{.guesses = true};
  const auto p = [&](double x_m, double t_s) { return p_goal(crossing(x_m, 0.5, t_s, 0.01), keeper, guesses); };
  // From rest to rest 0.6 m at 4.5 m/s2 take 0.730 s; it reaches 0.41 m farther.
  for (const double t_s : {0.75, 1.5}) {
    EXPECT_NEAR(p(0.0, t_s), 1.0, 1e-4);
    EXPECT_NEAR(p(0.15, t_s), 1.0, 1e-4);
    EXPECT_NEAR(p(0.23, t_s), 0.5, 1e-4);
    EXPECT_NEAR(p(-0.8, t_s), 0.5, 1e-4);
  }
  EXPECT_NEAR(p(0.0, 0.3), 0.0, 1e-4) << "0.2025 m: it still has the middle";
  EXPECT_NEAR(p(0.25, 0.3), 0.5, 1e-4);
  EXPECT_NEAR(p(0.7, 0.3), 1.0, 1e-4);
  EXPECT_NEAR(p(0.0, 0.55), 1.0, 1e-4) << "0.6 - 2.25 0.18^2 = 0.527 m";
  EXPECT_NEAR(p(1.1, 1.0), 0.0, 1e-4) << "wide";
  EXPECT_EQ(p_goal(crossing(0.3, 0.5), {.speed_mps = 0.0, .acceleration_mps2 = 0.0}, guesses),
            p_goal(crossing(0.3, 0.5, 2.0), {}, guesses))
      << "of no acceleration it is there at once";
}

TEST(Keeper, TheIntegralOfOneThatGuessesIsThatOfDrawnKicksAndKeepers) {
  std::mt19937 random{7};
  std::normal_distribution<double> normal;
  const Goal goal;
  const Ball ball;
  const KeeperConfig keeper;
  const KeeperPlace place{-0.1, 0.1, true};
  for (const double x_m : {-0.5, 0.0, 0.4}) {
    constexpr int kDraws = 200'000;
    double goals = 0.0;
    for (int i = 0; i < kDraws; ++i) {
      const double x = x_m + 0.2 * normal(random), z = 0.5 + 0.2 * normal(random);
      const double stands_m =
          place.x_m + std::copysign(keeper.guess_m, normal(random)) + std::hypot(0.1, 0.1) * normal(random);
      if (std::abs(x) > goal.clean_half_width_m(ball) || z > goal.clean_height_m(ball)) continue;
      const bool beside = std::abs(x - stands_m) > keeper.half_width_m + ball.radius_m;
      const double in = z < ball.radius_m ? kBounce : 1.0;
      goals += beside || z > keeper.height_m + ball.radius_m ? in : keeper.miss_ratio * in;
    }
    EXPECT_NEAR(p_goal(crossing(x_m, 0.5, 1.0, 0.2), keeper, place), goals / kDraws, 0.02) << x_m;
  }
}

TEST(Keeper, TheIntegralIsThatOfDrawnKicksAndKeepers) {
  std::mt19937 random{7};
  std::normal_distribution<double> normal;
  const Goal goal;
  const Ball ball;
  const KeeperConfig keeper;
  for (const double x_m : {0.3, 0.6, 0.8})
    for (const double z_m : {0.4, 0.8})
      for (const double t_s : {0.35, 0.55}) {
        const CrossingSpread there = crossing(x_m, z_m, t_s, 0.15);
        const KeeperPlace place{-0.1, 0.1};
        const double sd_m = std::hypot(keeper.sd_m, place.sd_m), reach_m = keeper_reach_m(keeper, t_s);
        constexpr int kDraws = 200'000;
        double goals = 0.0;
        for (int i = 0; i < kDraws; ++i) {
          const double x = x_m + 0.15 * normal(random), z = z_m + 0.15 * normal(random), off = sd_m * normal(random);
          if (std::abs(x) > goal.clean_half_width_m(ball) || z > goal.clean_height_m(ball)) continue;
          const bool beside = x > place.x_m + reach_m + off || x < place.x_m - reach_m + off;
          const bool over = z > keeper.height_m + ball.radius_m;
          const double in = z < ball.radius_m ? kBounce : 1.0;
          goals += beside || over ? in : keeper.miss_ratio * in;
        }
        EXPECT_NEAR(p_goal(there, keeper, place), goals / kDraws, 0.02) << x_m << ' ' << z_m << ' ' << t_s;
      }
}

// A search gives the best that it knows: what is no better need not be computed.
TEST(Keeper, AChanceAboveTheLeastIsTheSameAndOneBelowIsNotMoreThanThat) {
  const Goal goal;
  const KeeperConfig keeper;
  int above = 0, below = 0;
  for (double x_m = -1.2; x_m <= 1.2; x_m += 0.1)
    for (const double z_m : {0.1, 0.5, 0.8, 1.1})
      for (const double t_s : {0.3, 0.6})
        for (const double least : {0.05, 0.3, 0.6, 0.9}) {
          const CrossingSpread there = crossing(x_m, z_m, t_s, 0.2);
          const double p = p_goal(there, keeper), on_target = p_on_target(there, kBounce, goal);
          const GoalChance asked = goal_chance(there, kBounce, keeper, {}, goal, {}, least);
          ++(p > least ? above : below);
          const double on_target_asked = p_on_target(there, kBounce, goal, {}, least);
          if (p > least) {
            EXPECT_EQ(asked.p_goal, p);
          } else {
            EXPECT_LE(asked.p_goal, least);
          }
          if (on_target > least) {
            EXPECT_EQ(on_target_asked, on_target);
          } else {
            EXPECT_LE(on_target_asked, least);
          }
        }
  EXPECT_GT(above, 50);
  EXPECT_GT(below, 50);
}

}  // namespace
}  // namespace trivela::kicking
