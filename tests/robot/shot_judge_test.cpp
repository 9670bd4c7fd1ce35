#include "robot/observer/shot_judge.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "robot/observer/shot_tracker.hpp"

namespace trivela::robot {
namespace {

using kicking::Outcome;

const config::ShotObserver kSettings{};
const kicking::Goal kGoal{};

/// Sightings of a flight that would cross the goal line at x, z after 0.5 s, up to `until_s`.
std::vector<kicking::Sighting> towards(double x_cross_m, double z_cross_m, double until_s = 0.49) {
  constexpr double kFlight_s = 0.5;
  std::vector<kicking::Sighting> seen;
  for (int i = 0; i * 0.02 <= until_s; ++i) {
    const double t_s = i * 0.02, left_s = kFlight_s - t_s;
    const double vz_end_mps = -2.0;
    seen.push_back(
        {i * 20'000'000,
         {x_cross_m, kGoal.y_m - 8.0 * left_s, z_cross_m - vz_end_mps * left_s - 9.81 * left_s * left_s / 2.0}});
  }
  return seen;
}

ShotVerdict verdict_of(const std::vector<kicking::Sighting>& seen, FlightEnd end, const kicking::Goal& goal = kGoal) {
  const ShotTrack track{.sightings = seen,
                        .end = end,
                        .release_t_ns = seen.front().t_ns,
                        .end_t_ns = seen.back().t_ns + 20'000'000,
                        .expected_speed_mps = 8.0,
                        .expected_climb_mps = std::nullopt,
                        .ball_sd_m = 0.01};
  return judge_shot(track, goal, kSettings);
}

Outcome judged(const std::vector<kicking::Sighting>& seen, FlightEnd end) { return verdict_of(seen, end).outcome; }

TEST(ShotJudge, ABallThrownBackHitTheNearerOfPostAndBar) {
  // By a hair it would have gone in, or past: it came back, so it met the frame.
  EXPECT_EQ(judged(towards(0.88, 0.4), FlightEnd::kThrownBack), Outcome::kPost);
  EXPECT_EQ(judged(towards(-0.88, 0.4), FlightEnd::kThrownBack), Outcome::kPost);
  EXPECT_EQ(judged(towards(-1.25, 0.4), FlightEnd::kThrownBack), Outcome::kPost);
  EXPECT_EQ(judged(towards(0.2, 0.88), FlightEnd::kThrownBack), Outcome::kBar);
  EXPECT_EQ(judged(towards(0.2, 1.25), FlightEnd::kThrownBack), Outcome::kBar);
}

TEST(ShotJudge, WhereAKeeperSavesABallThatComesBackFromNearThePostMayBeASave) {
  const auto seen = towards(0.88, 0.4);
  ShotTrack track{.sightings = seen,
                  .end = FlightEnd::kThrownBack,
                  .end_t_ns = seen.back().t_ns + 20'000'000,
                  .expected_speed_mps = 8.0,
                  .ball_sd_m = 0.01};
  const auto p_on_target = [&](double save_ratio) {
    track.save_ratio = save_ratio;
    return judge_shot(track, kGoal, kSettings).probabilities->front();
  };
  EXPECT_LT(p_on_target(0.005), 0.3);
  EXPECT_GT(p_on_target(0.9), 0.6);
  const ShotVerdict back = judge_shot(track, kGoal, kSettings);
  EXPECT_GT(*back.p_saved, 0.99 * back.probabilities->front()) << "of what is on target and came back";
  track.end = FlightEnd::kBeyondLine;
  EXPECT_LT(*judge_shot(track, kGoal, kSettings).p_saved, 0.01);
}

// The sightings of a flight that somebody turned `before_m` before the line, and what came of it.
ShotVerdict turned(double before_m, double x_cross_m, double z_cross_m, double save_ratio) {
  auto seen = towards(x_cross_m, z_cross_m, 0.5 - before_m / 8.0);
  for (int i = 0; i < 8; ++i) {
    const kicking::Sighting last = seen.back();
    seen.push_back({last.t_ns + 20'000'000, last.ball_m + Eigen::Vector3d{0.01, i == 0 ? 0.02 : -0.05, -0.01}});
  }
  const ShotTrack track{.sightings = seen,
                        .end = FlightEnd::kTakenAway,
                        .end_t_ns = seen.back().t_ns + 20'000'000,
                        .expected_speed_mps = 8.0,
                        .ball_sd_m = 0.01,
                        .save_ratio = save_ratio};
  return judge_shot(track, kGoal, kSettings);
}

TEST(ShotJudge, ABallThatIsStoppedRightBeforeTheLineOnItsWayInIsSaved) {
  const ShotVerdict saved = turned(0.5, 0.5, 0.4, 0.5);
  EXPECT_EQ(saved.outcome, Outcome::kOnTarget);
  EXPECT_GT(*saved.p_saved, 0.9);
  EXPECT_NEAR(*saved.x_cross_m, 0.5, 0.1) << "where it was to cross";
  EXPECT_FALSE(saved.parabola) << "it was touched";
  EXPECT_EQ(turned(0.5, 1.6, 0.4, 0.5).outcome, Outcome::kBlocked) << "it was to go wide";
  EXPECT_EQ(turned(1.5, 0.5, 0.4, 0.5).outcome, Outcome::kBlocked) << "no keeper stands there";
  EXPECT_EQ(turned(0.5, 0.5, 0.4, 0.005).outcome, Outcome::kUnknown) << "the first one of a match";
}

TEST(SaveWatch, TakesTheShareOfSavesFromTheProbabilitiesOfAllShots) {
  SaveWatch watch;
  EXPECT_DOUBLE_EQ(watch.ratio(), 0.005);
  ShotVerdict shot;
  shot.probabilities.emplace();
  watch.learn(ShotVerdict{});
  EXPECT_DOUBLE_EQ(watch.ratio(), 0.005) << "one of which nothing is known";
  shot.probabilities->front() = 1.0;
  shot.p_saved = 1.0;
  watch.learn(shot);
  EXPECT_NEAR(watch.ratio(), 1.01 / 3.0, 1e-12);
  shot.p_saved = 0.0;
  for (int i = 0; i < 1000; ++i) watch.learn(shot);
  EXPECT_NEAR(watch.ratio(), 1.01 / 1003.0, 1e-12);
}

TEST(ShotJudge, TheSameBallBeyondTheLineIsJudgedByItsCrossing) {
  EXPECT_EQ(judged(towards(0.88, 0.4), FlightEnd::kBeyondLine), Outcome::kOnTarget);
  EXPECT_EQ(judged(towards(-1.25, 0.4), FlightEnd::kBeyondLine), Outcome::kWideLeft);
  EXPECT_EQ(judged(towards(0.2, 0.88), FlightEnd::kBeyondLine), Outcome::kOnTarget);
  EXPECT_EQ(judged(towards(0.2, 1.25), FlightEnd::kBeyondLine), Outcome::kOver);
}

// A stop alone says nothing of the ball: with a goal two metres off its place every kick would have been blocked.
TEST(ShotJudge, ABallThatFliesFreelyUntilTheStopOrIsLostIsUnknown) {
  EXPECT_EQ(judged(towards(0.0, 0.5, 0.3), FlightEnd::kTakenAway), Outcome::kUnknown);
  EXPECT_EQ(judged(towards(0.0, 0.5, 0.3), FlightEnd::kLost), Outcome::kUnknown);
}

TEST(ShotJudge, ABallThatSomethingTurnedBeforeTheStopWasBlocked) {
  auto seen = towards(0.0, 0.5, 0.3);
  for (int i = 0; i < 6; ++i) {
    const kicking::Sighting last = seen.back();
    seen.push_back({last.t_ns + 20'000'000, last.ball_m + Eigen::Vector3d{0.05, -0.04, -0.03}});
  }
  const auto verdict = verdict_of(seen, FlightEnd::kTakenAway);
  EXPECT_EQ(verdict.outcome, Outcome::kBlocked);
  ASSERT_TRUE(verdict.probabilities);
  EXPECT_GT((*verdict.probabilities)[static_cast<std::size_t>(Outcome::kBlocked)], 0.99);
  EXPECT_FALSE(verdict.x_cross_m);
}

// Its way alone leaves it open whether it touched the bar; what it did behind the line does not.
TEST(ShotJudge, WhatFollowsTheCrossingDecidesAtTheEdge) {
  for (const double z_cross_m : {0.88, 0.89, 0.91}) {
    auto passed = towards(0.0, z_cross_m), back = passed;
    for (int i = 1; i <= 6; ++i) {
      const double t_s = 0.02 * i;
      const std::int64_t t_ns = 500'000'000 + i * 20'000'000;
      passed.push_back({t_ns, {0.0, kGoal.y_m + 8.0 * t_s, z_cross_m - 2.0 * t_s}});
      back.push_back({t_ns, {0.0, kGoal.y_m - 4.0 * t_s, z_cross_m - 1.0 * t_s}});
    }
    EXPECT_EQ(judged(passed, FlightEnd::kBeyondLine), Outcome::kOnTarget) << z_cross_m;
    EXPECT_EQ(judged(back, FlightEnd::kThrownBack), Outcome::kBar) << z_cross_m;
  }
}

TEST(ShotJudge, ABallThatComesBackFromTheMiddleOfTheGoalWasSaved) {
  auto seen = towards(0.1, 0.4);
  for (int i = 1; i <= 8; ++i)
    seen.push_back({500'000'000 + i * 20'000'000, {0.1, kGoal.y_m - 0.05 * i, 0.4 - 0.01 * i}});
  EXPECT_EQ(judged(seen, FlightEnd::kThrownBack), Outcome::kOnTarget);
}

TEST(ShotJudge, WhatIsLessCertainThanTheSettingIsUnknown) {
  config::ShotObserver sure = kSettings;
  const auto seen = towards(0.885, 0.885);  // between post and bar
  const ShotTrack track{.sightings = seen,
                        .end = FlightEnd::kThrownBack,
                        .release_t_ns = 0,
                        .end_t_ns = 500'000'000,
                        .expected_speed_mps = 8.0,
                        .expected_climb_mps = std::nullopt,
                        .ball_sd_m = 0.05};
  EXPECT_EQ(judge_shot(track, kGoal, sure).outcome, Outcome::kUnknown);
  const auto p = *judge_shot(track, kGoal, sure).probabilities;
  EXPECT_GT(p[static_cast<std::size_t>(Outcome::kPost)], 0.3);
  EXPECT_GT(p[static_cast<std::size_t>(Outcome::kBar)], 0.2);
  sure.label_probability = 0.5;
  EXPECT_EQ(judge_shot(track, kGoal, sure).outcome, Outcome::kPost);
}

TEST(ShotJudge, AHandfulOfSightingsTellNothing) {
  for (const auto end :
       {FlightEnd::kBeyondLine, FlightEnd::kThrownBack, FlightEnd::kAtRest, FlightEnd::kTakenAway, FlightEnd::kLost}) {
    const auto verdict = verdict_of(towards(0.0, 0.5, 0.06), end);
    EXPECT_EQ(verdict.outcome, Outcome::kUnknown);
    EXPECT_FALSE(verdict.x_cross_m || verdict.exit_speed_mps);
  }
}

TEST(ShotJudge, FourSightingsTellOfATurnAndOfNothingElse) {
  const auto outcome_of = [](const std::vector<kicking::Sighting>& seen) {
    const ShotTrack track{.sightings = seen,
                          .end = FlightEnd::kTakenAway,
                          .release_t_ns = 0,
                          .end_t_ns = 120'000'000,
                          .expected_speed_mps = 8.0,
                          .expected_climb_mps = std::nullopt,
                          .ball_sd_m = 0.01};
    return judge_shot(track, kGoal, kSettings).outcome;
  };
  auto straight = towards(0.0, 0.5, 0.1);
  straight.erase(straight.begin(), straight.begin() + 2);  // the dropouts' part
  auto turned = straight;
  for (int i = 2; i < 4; ++i)  // an opponent sent it back
    turned[i].ball_m = turned[1].ball_m + (i - 1) * Eigen::Vector3d{0.04, -0.08, 0.0};
  ASSERT_EQ(turned.size(), 4u);
  EXPECT_EQ(outcome_of(turned), Outcome::kBlocked);
  EXPECT_EQ(outcome_of(straight), Outcome::kUnknown);
}

TEST(ShotJudge, AGoalOfAnotherSizeIsJudgedByItsSize) {
  kicking::Goal wide = kGoal;
  wide.half_width_m = 1.2;
  EXPECT_EQ(verdict_of(towards(1.05, 0.4), FlightEnd::kBeyondLine, wide).outcome, Outcome::kOnTarget);
  EXPECT_EQ(judged(towards(1.05, 0.4), FlightEnd::kThrownBack), Outcome::kPost);
}

}  // namespace
}  // namespace trivela::robot
