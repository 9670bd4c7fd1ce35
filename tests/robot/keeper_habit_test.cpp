#include "robot/decision/keeper_habit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "kicking/random/draws.hpp"
#include "robot/belief/opponent_tracks.hpp"
#include "sim/guard.hpp"

namespace trivela::robot {
namespace {

using kicking::KeeperPlace;

constexpr std::int64_t kCycle_ns = 20'000'000, kRelease_ns = 1'000'000'000;

/// A kick past a keeper that is known to sd_m: at -0.05 m at the release, `gone_m` farther 0.55 s later. The ball is
/// expected to cross so far from where the keeper stood.
void kick(KeeperHabit& habit, double gone_m, double way_m = 0.0, double sd_m = 0.1) {
  const auto see = [&](int cycle, double x_m) { habit.see(kRelease_ns + cycle * kCycle_ns, KeeperPlace{x_m, sd_m}); };
  habit.kicked(kRelease_ns, way_m - 0.05);
  see(-1, 0.3);
  see(0, -0.05);
  see(27, 0.6);  // too early
  see(28, gone_m - 0.05);
  see(29, 0.6);  // another kick's
}

/// m = 4.5 0.38^2 / 2 = 0.3249 m, sd^2 = 0.01 m2. Of a keeper 0.3 m from where it stood: it waits 0.0111, it guesses
/// 0.4847; it follows a ball to there from 0.75 m away 0.3294, each and 0.01. Before the kick 0.63, 0.27 and 0.1. Of
/// what comes out a hundredth is given back to these.
TEST(KeeperHabit, WeighsTheWaysOfPlayingByHowFarTheKeeperWasSeenToGo) {
  const auto after = [](double gone_m, double way_m) {
    KeeperHabit habit{{}};
    EXPECT_NEAR(habit.p_guesses(), 0.1, 1e-12);
    kick(habit, gone_m, way_m);
    return habit.p_guesses();
  };
  for (const double side : {-1.0, 1.0}) {
    EXPECT_NEAR(after(0.3 * side, 0.0), 0.7163, 1e-3) << "the ball comes to where it stood";
    EXPECT_NEAR(after(0.3 * side, 0.75 * side), 0.3182, 1e-3) << "it went to the ball's side";
    EXPECT_NEAR(after(0.3 * side, -0.75 * side), 0.7491, 1e-3) << "it went to the other one";
    EXPECT_LT(after(0.6 * side, 0.75 * side), 0.06) << "nobody jumps so far so soon";
    EXPECT_LT(after(0.05 * side, 0.75 * side), 0.01);
  }
}

TEST(KeeperHabit, AKeeperOutOfSightTellsNothing) {
  KeeperHabit habit{{}};
  kick(habit, 0.3, 0.0, 0.15);
  EXPECT_EQ(habit.p_guesses(), 0.1);
  habit.kicked(kRelease_ns, 0.0);
  habit.see(kRelease_ns, KeeperPlace{0.0, 0.1});
  habit.see(kRelease_ns + 28 * kCycle_ns, KeeperPlace{0.3, 0.2});
  EXPECT_EQ(habit.p_guesses(), 0.1);
}

TEST(KeeperHabit, LearnsNothingWithoutAKickOrWithoutAKeeper) {
  KeeperHabit habit{{}};
  habit.see(kRelease_ns, KeeperPlace{0.0, 0.1});
  habit.see(kRelease_ns + 28 * kCycle_ns, KeeperPlace{0.3, 0.1});
  habit.kicked(kRelease_ns, 0.0);
  for (int i = 0; i < 60; ++i) habit.see(kRelease_ns + i * kCycle_ns, std::nullopt);
  habit.kicked(kRelease_ns, 0.0);
  habit.see(kRelease_ns, KeeperPlace{0.0, 0.1});
  habit.forget_kick();
  habit.see(kRelease_ns + 28 * kCycle_ns, KeeperPlace{0.3, 0.1});
  EXPECT_EQ(habit.p_guesses(), 0.1);
}

TEST(KeeperHabit, ACycleThatComesLateTellsNothing) {
  for (const auto& [first, second] : {std::pair{10, 28}, std::pair{0, 40}}) {
    KeeperHabit habit{{}};
    habit.kicked(kRelease_ns, 0.0);
    habit.see(kRelease_ns + first * kCycle_ns, KeeperPlace{0.0, 0.1});
    habit.see(kRelease_ns + second * kCycle_ns, KeeperPlace{0.3, 0.1});
    EXPECT_EQ(habit.p_guesses(), 0.1) << first;
  }
}

TEST(KeeperHabit, WithoutAPriorItIsNeverBelieved) {
  KeeperHabit habit{{.guess_prior = 0.0}};
  for (int i = 0; i < 50; ++i) kick(habit, 0.3);
  EXPECT_EQ(habit.p_guesses(), 0.0);
}

TEST(KeeperHabit, AKeeperMayChangeItsMind) {
  KeeperHabit habit{{}};
  for (int i = 0; i < 100; ++i) kick(habit, 0.3);
  ASSERT_TRUE(habit.guesses());
  for (int i = 0; i < 3; ++i) kick(habit, 0.0);
  EXPECT_FALSE(habit.guesses());
  for (int i = 0; i < 100; ++i) kick(habit, 0.0);
  for (int i = 0; i < 3; ++i) kick(habit, 0.3);
  EXPECT_TRUE(habit.guesses());
}

TEST(KeeperHabit, WhatNoKeeperDoesTellsNothing) {
  KeeperHabit habit{{}};
  kick(habit, 1e6, 0.0, 1e-6);
  EXPECT_NEAR(habit.p_guesses(), 0.1, 1e-9);
}

/// A keeper that the simulator moves, seen through its camera's noise by the robot's own track: how many of 300 robots
/// believe after so many kicks that it guesses. Some of the pictures are missing.
int believers(const sim::Guard& guard, double guess_m, int kicks, double flown_s = 1.0) {
  int believe = 0;
  for (std::uint32_t robot = 0; robot < 300; ++robot) {
    KeeperTrack track;
    KeeperHabit habit{{}};
    std::uint32_t picture = 0;
    for (int kick = 0; kick < kicks; ++kick) {
      const auto luck = kicking::Draws{7, robot}.normals(kicking::Role::kKeeper, static_cast<std::uint32_t>(kick));
      const sim::GuardedBall ball{{std::copysign(0.7, luck[1]), 0.5}, flown_s};
      sim::Misjudgement misjudged{luck[0], 0.0};
      if (guess_m > 0.0) misjudged.guessed_m = std::copysign(guess_m, luck[2]);
      const std::int64_t release_ns = (4 * kick + 2) * std::int64_t{1'000'000'000};
      habit.kicked(release_ns, ball.crossing.x_m);
      for (std::int64_t t_ns = release_ns - 1'500'000'000; t_ns < release_ns + 700'000'000; t_ns += kCycle_ns) {
        const double exposed_s = 1e-9 * static_cast<double>(t_ns - release_ns) - 0.06;
        const sim::GuardedBall until{ball.crossing, std::min(exposed_s, flown_s)};
        const double x_m = sim::guard_place_m(guard, 0.0, until, misjudged);
        const auto noise = kicking::Draws{8, robot}.normals(kicking::Role::kKeeperSight, ++picture);
        if (noise[1] < 1.5) track.observe(t_ns - 60'000'000, x_m + 0.15 * noise[0], 0.17);
        habit.see(t_ns, track.at(t_ns));
      }
    }
    believe += habit.guesses();
  }
  return believe;
}

TEST(KeeperHabit, AKeeperThatJumpsIsFoundOutByTheFirstKicks) {
  EXPECT_GT(believers({}, 0.6, 1), 120) << "of half of them it went to the ball's side";
  EXPECT_GT(believers({}, 0.6, 4), 270);
  EXPECT_GT(believers({}, 0.9, 4), 270);
  EXPECT_GT(believers({}, 0.4, 4), 270);
}

TEST(KeeperHabit, AKeeperThatLooksIsNotTakenForOneThatJumps) {
  const auto waits = [](double reaction_s, double acceleration_mps2) {
    sim::Guard guard;
    guard.reaction_s = reaction_s;
    guard.acceleration_mps2 = acceleration_mps2;
    return guard;
  };
  for (const int kicks : {1, 5}) {
    EXPECT_LE(believers(waits(0.25, 4.5), 0.0, kicks), 3) << kicks;
    EXPECT_LE(believers(waits(0.25, 4.5), 0.0, kicks, 0.6), 3) << kicks;
    EXPECT_LE(believers(waits(0.5, 4.5), 0.0, kicks), 3) << kicks;
    EXPECT_LE(believers(waits(0.15, 4.5), 0.0, kicks), 15) << kicks << ": quicker than is assumed";
    EXPECT_LE(believers(waits(0.25, 6.0), 0.0, kicks), 3) << kicks;
  }
}

}  // namespace
}  // namespace trivela::robot
