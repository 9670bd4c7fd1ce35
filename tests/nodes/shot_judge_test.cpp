#include "nodes/shot_observer/shot_judge.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace trivela::nodes {
namespace {

using kicking::Outcome;

const config::ShotObserver kSettings{};
const kicking::Goal kGoal{};

/// Sightings of a flight that would cross the goal line at x, z after 0.5 s, up to `until_s`.
std::vector<Sighting> towards(double x_cross_m, double z_cross_m, double until_s = 0.49) {
  constexpr double kFlight_s = 0.5;
  std::vector<Sighting> seen;
  for (int i = 0; i * 0.02 <= until_s; ++i) {
    const double t_s = i * 0.02, left_s = kFlight_s - t_s;
    const double vz_end_mps = -2.0;
    seen.push_back(
        {i * 20'000'000,
         {x_cross_m, kGoal.y_m - 8.0 * left_s, z_cross_m - vz_end_mps * left_s - 9.81 * left_s * left_s / 2.0}});
  }
  return seen;
}

Outcome judged(const std::vector<Sighting>& seen, FlightEnd end) {
  return judge_shot(seen, end, 8.0, kGoal, kSettings).outcome;
}

TEST(ShotJudge, ABallThrownBackHitTheNearerOfPostAndBar) {
  // By a hair it would have gone in, or past: it came back, so it met the frame.
  EXPECT_EQ(judged(towards(0.88, 0.4), FlightEnd::kThrownBack), Outcome::kPost);
  EXPECT_EQ(judged(towards(-0.88, 0.4), FlightEnd::kThrownBack), Outcome::kPost);
  EXPECT_EQ(judged(towards(-1.25, 0.4), FlightEnd::kThrownBack), Outcome::kPost);
  EXPECT_EQ(judged(towards(0.2, 0.88), FlightEnd::kThrownBack), Outcome::kBar);
  EXPECT_EQ(judged(towards(0.2, 1.25), FlightEnd::kThrownBack), Outcome::kBar);
}

TEST(ShotJudge, TheSameBallBeyondTheLineIsJudgedByItsCrossing) {
  EXPECT_EQ(judged(towards(0.88, 0.4), FlightEnd::kBeyondLine), Outcome::kOnTarget);
  EXPECT_EQ(judged(towards(-1.25, 0.4), FlightEnd::kBeyondLine), Outcome::kWideLeft);
  EXPECT_EQ(judged(towards(0.2, 0.88), FlightEnd::kBeyondLine), Outcome::kOnTarget);
  EXPECT_EQ(judged(towards(0.2, 1.25), FlightEnd::kBeyondLine), Outcome::kOver);
}

TEST(ShotJudge, ABallTakenAwayInFullFlightWasBlockedAndALostOneIsUnknown) {
  EXPECT_EQ(judged(towards(0.0, 0.5, 0.3), FlightEnd::kTakenAway), Outcome::kBlocked);
  EXPECT_EQ(judged(towards(0.0, 0.5, 0.3), FlightEnd::kLost), Outcome::kUnknown);
}

TEST(ShotJudge, AHandfulOfSightingsTellNothing) {
  for (const auto end :
       {FlightEnd::kBeyondLine, FlightEnd::kThrownBack, FlightEnd::kAtRest, FlightEnd::kTakenAway, FlightEnd::kLost}) {
    const auto verdict = judge_shot(towards(0.0, 0.5, 0.06), end, 8.0, kGoal, kSettings);
    EXPECT_EQ(verdict.outcome, Outcome::kUnknown);
    EXPECT_FALSE(verdict.x_cross_m || verdict.exit_speed_mps);
  }
}

TEST(ShotJudge, AGoalOfAnotherSizeIsJudgedByItsSize) {
  kicking::Goal wide = kGoal;
  wide.half_width_m = 1.2;
  EXPECT_EQ(judge_shot(towards(1.05, 0.4), FlightEnd::kBeyondLine, 8.0, wide, kSettings).outcome, Outcome::kOnTarget);
  EXPECT_EQ(judged(towards(1.05, 0.4), FlightEnd::kBeyondLine), Outcome::kPost);
}

}  // namespace
}  // namespace trivela::nodes
