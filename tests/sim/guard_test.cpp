#include "sim/guard.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kicking/random/draws.hpp"

namespace trivela::sim {
namespace {

constexpr double kRadius_m = 0.11;

/// Sees everything as it is, reaches what its body reaches.
Guard exact() {
  Guard guard;
  guard.sight_sd_mps = 0.0;
  guard.overlap_m = 0.0;
  return guard;
}

GuardedBall ball(double x_m, double z_m, double flown_s) { return {{x_m, z_m}, flown_s, kRadius_m}; }

TEST(Guard, StandsUntilItHasReacted) {
  const Guard guard = exact();
  EXPECT_EQ(guard_place_m(guard, 0.2, ball(1.0, 0.5, 0.9 * guard.reaction_s), {}), 0.2);
  EXPECT_GT(guard_place_m(guard, 0.2, ball(1.0, 0.5, 1.5 * guard.reaction_s), {}), 0.2);
}

TEST(Guard, DrivesWithItsAccelerationAndItsSpeed) {
  const Guard guard = exact();
  // Half a t^2 until it is fast: 0.1 s after its reaction 0.5 * 4.5 * 0.01; then 2 m/s.
  EXPECT_NEAR(guard_place_m(guard, 0.0, ball(5.0, 0.5, 0.35), {}), 0.0225, 1e-4);
  const double run_up_s = guard.speed_mps / guard.acceleration_mps2;
  EXPECT_NEAR(guard_place_m(guard, 0.0, ball(9.0, 0.5, guard.reaction_s + run_up_s + 1.0), {}),
              0.5 * guard.speed_mps * run_up_s + guard.speed_mps, 2e-3);
}

TEST(Guard, StopsWhereTheBallComes) {
  for (const double x_m : {-0.8, -0.1, 0.3, 0.85})
    EXPECT_NEAR(guard_place_m(exact(), 0.0, ball(x_m, 0.5, 3.0), {}), x_m, 2e-3);
}

TEST(Guard, AJumpGoesOnFromWhereItWasAskedForLast) {
  const Guard guard = exact();
  GuardMotion jump{0.1};
  for (double until_s = 0.0; until_s < 1.5; until_s += 0.0203) {
    Misjudgement guesses;
    guesses.guessed_m = 0.7;
    EXPECT_EQ(jumped_place_m(guard, 0.7, until_s, jump), guard_place_m(guard, 0.1, ball(0.0, 0.5, until_s), guesses));
  }
}

TEST(Guard, ALaterOrWiderBallIsHarder) {
  const Guard guard = exact();
  double widest_before_m = 0.0;
  for (const double flown_s : {0.2, 0.4, 0.5, 0.6, 0.7}) {
    double widest_m = 0.0;
    for (double x_m = 0.0; x_m < 1.5; x_m += 0.01) {
      if (guard_stops(guard, {}, 0.0, ball(x_m, 0.5, flown_s), {})) widest_m = x_m;
    }
    EXPECT_GE(widest_m, widest_before_m) << flown_s;
    widest_before_m = widest_m;
    if (flown_s < guard.reaction_s) {
      EXPECT_NEAR(widest_m, guard.half_width_m + kRadius_m, 0.011);
    }
  }
  EXPECT_GT(widest_before_m, 0.7);
}

TEST(Guard, MistakesTheBallLessAsItComesNear) {
  Guard guard = exact();
  guard.sight_sd_mps = 0.5;
  guard.acceleration_mps2 = 100.0;
  guard.speed_mps = 10.0;
  // What it acts on at the crossing is as old as its reaction.
  EXPECT_NEAR(guard_place_m(guard, 0.0, ball(0.0, 0.5, 1.0), {1.0, 0.0}), 0.5 * guard.reaction_s, 0.02);
  EXPECT_NEAR(guard_place_m(guard, 0.0, ball(0.0, 0.5, 1.0), {-1.0, 0.0}), -0.5 * guard.reaction_s, 0.02);
}

TEST(Guard, WithWorseEyesItStopsLess) {
  const auto stopped = [](double sight_sd_mps) {
    Guard guard;
    guard.sight_sd_mps = sight_sd_mps;
    int n = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
      const kicking::Draws draws{3, i};
      const auto noise = draws.normals(kicking::Role::kKeeper, 0);
      n += guard_stops(guard, {}, 0.0, ball(draws.uniform_in(-0.89, 0.89, kicking::Role::kStart, 0), 0.5, 0.9),
                       {noise[0], noise[1]});
    }
    return n;
  };
  EXPECT_GT(stopped(0.0), stopped(0.5) + 100);
  EXPECT_GT(stopped(0.5), stopped(1.5) + 100);
}

TEST(Guard, ABallOverItOrThatOnlyGrazesItGoesOn) {
  Guard guard = exact();
  EXPECT_TRUE(guard_stops(guard, {}, 0.0, ball(0.0, guard.height_m + 0.10, 1.0), {}));
  EXPECT_FALSE(guard_stops(guard, {}, 0.0, ball(0.0, guard.height_m + 0.12, 1.0), {}));
  guard.overlap_m = 0.05;
  EXPECT_FALSE(guard_stops(guard, {}, 0.0, ball(0.0, guard.height_m + 0.10, 1.0), {}));
  guard.reaction_s = 2.0;
  EXPECT_TRUE(guard_stops(guard, {}, 0.0, ball(0.31, 0.5, 1.0), {}));
  EXPECT_FALSE(guard_stops(guard, {}, 0.0, ball(0.33, 0.5, 1.0), {}));
}

TEST(Guard, ItsFrameGoesUpOrToTheSideOfTheBall) {
  Guard guard = exact();
  guard.speed_mps = 0.0;
  const Extension frame{0.08, 0.10, 0.1};
  const double edge_m = guard.half_width_m + kRadius_m;
  for (const double side : {-1.0, 1.0}) {
    EXPECT_FALSE(guard_stops(guard, {}, 0.0, ball(side * (edge_m + 0.07), 0.5, 1.0), {}));
    EXPECT_TRUE(guard_stops(guard, frame, 0.0, ball(side * (edge_m + 0.07), 0.5, 1.0), {}));
    EXPECT_FALSE(guard_stops(guard, frame, 0.0, ball(side * (edge_m + 0.09), 0.5, 1.0), {}));
    // Too soon for the frame.
    EXPECT_FALSE(guard_stops(guard, frame, 0.0, ball(side * (edge_m + 0.07), 0.5, guard.reaction_s + 0.05), {}));
  }
  EXPECT_TRUE(guard_stops(guard, frame, 0.0, ball(0.0, guard.height_m + 0.20, 1.0), {}));
  EXPECT_FALSE(guard_stops(guard, frame, 0.0, ball(edge_m + 0.07, guard.height_m + 0.20, 1.0), {})) << "one at a time";
}

}  // namespace
}  // namespace trivela::sim
