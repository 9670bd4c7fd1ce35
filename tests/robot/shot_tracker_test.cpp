#include "robot/observer/shot_tracker.hpp"
#include "kicking/geometry/time.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "tests/robot/flown_shot.hpp"

namespace trivela::robot {
namespace {

using kicking::Outcome;

const config::ShotObserver kSettings{};
const kicking::Goal kGoal{};

/// Shows the frames to a tracker, gives the receipt once `receipt_t_ns` has come and lets the referee stop the game at
/// the end.
std::vector<TrackedShot> watch(const FlownShot& shot, std::int64_t receipt_t_ns, bool referee_stops = true) {
  ShotTracker tracker{kSettings, kGoal};
  std::vector<TrackedShot> settled;
  const auto take = [&](const std::vector<TrackedShot>& more) {
    settled.insert(settled.end(), more.begin(), more.end());
  };
  bool told = false;
  for (const auto& frame : shot.frames) {
    if (!told && frame.t_ns >= receipt_t_ns) {
      take(tracker.release(7, shot.release_t_ns, shot.expected_speed_mps));
      told = true;
    }
    take(tracker.frame(frame.t_ns, frame.ball_m));
  }
  if (referee_stops) take(tracker.stopped(shot.frames.back().t_ns + kFrame_ns));
  return settled;
}

TrackedShot only(const std::vector<TrackedShot>& settled) {
  EXPECT_EQ(settled.size(), 1u);
  return settled.empty() ? TrackedShot{} : settled.front();
}

TrackedShot watched(const FlownShot& shot) { return only(watch(shot, shot.release_t_ns)); }

struct Aim {
  const char* what;
  double x_m, z_m;
  Outcome outcome;
};

class ShotTrackerTest : public testing::TestWithParam<Aim> {};

TEST_P(ShotTrackerTest, SeesWhereTheBallWent) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const auto shot = fly(aimed(GetParam().x_m, GetParam().z_m), airless(), seed);
    ASSERT_EQ(shot.truth.outcome, GetParam().outcome) << "of the world";
    const auto tracked = watched(shot);
    EXPECT_EQ(tracked.kick_id, 7);
    EXPECT_EQ(tracked.verdict.outcome, GetParam().outcome) << kicking::name(tracked.verdict.outcome) << seed;
    ASSERT_TRUE(tracked.verdict.x_cross_m && tracked.verdict.z_cross_m && tracked.verdict.sd_cross_m);
    EXPECT_NEAR(*tracked.verdict.x_cross_m, GetParam().x_m, 5.0 * *tracked.verdict.sd_cross_m);
    EXPECT_NEAR(*tracked.verdict.z_cross_m, GetParam().z_m, 5.0 * *tracked.verdict.sd_cross_m);
    EXPECT_LT(*tracked.verdict.sd_cross_m, 0.1);
    EXPECT_GT(tracked.sightings, 20u);
    EXPECT_GT(tracked.t_ns, shot.truth.t_ns);
    ASSERT_TRUE(tracked.verdict.exit_speed_mps && tracked.verdict.exit_elevation_rad);
    EXPECT_NEAR(*tracked.verdict.exit_speed_mps,
                std::hypot(shot.expected_speed_mps, aimed(GetParam().x_m, GetParam().z_m).velocity_mps.z()), 1.2);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Crossings, ShotTrackerTest,
    testing::Values(Aim{"Middle", 0.0, 0.5, Outcome::kOnTarget}, Aim{"InsideThePost", 0.7, 0.4, Outcome::kOnTarget},
                    Aim{"WideLeft", -2.0, 0.5, Outcome::kWideLeft}, Aim{"WideRight", 2.0, 0.5, Outcome::kWideRight},
                    Aim{"WideAndHigh", 2.0, 2.0, Outcome::kWideRight}, Aim{"Over", 0.3, 1.8, Outcome::kOver},
                    Aim{"LeftPost", -1.06, 0.45, Outcome::kPost}, Aim{"RightPost", 1.06, 0.45, Outcome::kPost},
                    Aim{"Bar", 0.2, 1.06, Outcome::kBar}),
    [](const auto& aim) { return aim.param.what; });

TEST(ShotTracker, ABallThatRollsInIsOnTarget) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Kick kick;
    kick.from_m.y() = 5.0;
    kick.velocity_mps = {0.3, 4.0, 0.0};
    kick.rolling = true;
    const auto tracked = watched(fly(kick, airless(), seed));
    EXPECT_EQ(tracked.verdict.outcome, Outcome::kOnTarget) << kicking::name(tracked.verdict.outcome);
    ASSERT_TRUE(tracked.verdict.x_cross_m);
    EXPECT_NEAR(*tracked.verdict.x_cross_m, 0.3, 0.1);
    EXPECT_LT(*tracked.verdict.sd_cross_m, 0.025) << "every frame before the line counts";
  }
}

TEST(ShotTracker, ABallThatBouncesInIsJudgedByItsLastBounce) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Kick kick;
    kick.velocity_mps = {0.4, 4.5, 4.0};  // lands before the line, and again
    const auto shot = fly(kick, airless(), seed);
    ASSERT_TRUE(shot.truth.crossing);
    const auto tracked = watched(shot);
    EXPECT_EQ(tracked.verdict.outcome, Outcome::kOnTarget) << kicking::name(tracked.verdict.outcome);
    ASSERT_TRUE(tracked.verdict.x_cross_m);
    EXPECT_NEAR(*tracked.verdict.x_cross_m, shot.truth.crossing->x_m, 5 * *tracked.verdict.sd_cross_m);
    EXPECT_NEAR(*tracked.verdict.z_cross_m, shot.truth.crossing->z_m, 5 * *tracked.verdict.sd_cross_m + 0.02);
  }
}

TEST(ShotTracker, ABallThatRestsBeforeTheLineIsShort) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Kick kick;
    kick.from_m.y() = 1.0;
    kick.velocity_mps = {0.0, 2.5, 2.5};
    const auto shot = fly(kick, airless(), seed);
    ASSERT_EQ(shot.truth.outcome, Outcome::kShort);
    const auto tracked = watched(shot);
    EXPECT_EQ(tracked.verdict.outcome, Outcome::kShort) << kicking::name(tracked.verdict.outcome) << seed;
    EXPECT_FALSE(tracked.verdict.x_cross_m);
  }
}

TEST(ShotTracker, ABallTurnedAwayByAnOpponentIsBlocked) {
  for (const double opponent_y_m : {5.0, 5.5, 8.2}) {
    for (const double opponent_x_m : {0.0, 0.15, 0.3}) {
      for (unsigned seed = 1; seed <= 8; ++seed) {
        Kick kick = aimed(0.0, 0.5);
        kick.opponent = {opponent_x_m, opponent_y_m};
        const auto shot = fly(kick, airless(), seed);
        if (shot.truth.outcome != Outcome::kBlocked) continue;  // it flies over him
        const auto tracked = watched(shot);
        EXPECT_EQ(tracked.verdict.outcome, Outcome::kBlocked)
            << kicking::name(tracked.verdict.outcome) << " at " << opponent_x_m << ", " << opponent_y_m << " seed "
            << seed;
        EXPECT_FALSE(tracked.verdict.x_cross_m);
      }
    }
  }
}

/// The file's delay is wrong by so much: the tracker expects the release earlier, or later, than it is.
FlownShot expected_early(FlownShot shot, double early_s) {
  shot.release_t_ns -= kicking::nanoseconds(early_s);
  return shot;
}

TEST(ShotTracker, ABallThatLeavesAtAnotherInstantThanTheFileSaysIsJudgedAsItFlies) {
  for (const double late_s : {-0.06, -0.03, 0.04, 0.08, 0.14, 0.2}) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
      for (const Aim& aim : {Aim{"in", 0.3, 0.5, Outcome::kOnTarget}, Aim{"over", 0.0, 1.6, Outcome::kOver}}) {
        const auto tracked = watched(expected_early(fly(aimed(aim.x_m, aim.z_m), airless(), seed), late_s));
        EXPECT_EQ(tracked.verdict.outcome, aim.outcome) << late_s << " s, seed " << seed;
        ASSERT_TRUE(tracked.verdict.release_late_s) << late_s;
        EXPECT_NEAR(*tracked.verdict.release_late_s, late_s, 0.025) << "seed " << seed;
      }
    }
  }
}

// Its height was once fitted from the handler on, 0.15 m too low: bars became saves, and free balls were blocked.
TEST(ShotTracker, ANoisyCameraHidesNoLateRelease) {
  sim::Scenario scenario = airless();
  scenario.flight_camera.position_sd_m = 0.06;
  config::ShotObserver settings;
  settings.ball_sd_m = 0.06;
  int given = 0;
  for (const double late_s : {0.1, 0.14, 0.2, 0.3}) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      for (const Aim& aim : {Aim{"in", 0.3, 0.6, Outcome::kOnTarget}, Aim{"bar", 0.0, 1.0, Outcome::kBar}}) {
        const auto shot = expected_early(fly(aimed(aim.x_m, aim.z_m), scenario, seed), late_s);
        ShotTracker tracker{settings, kGoal};
        tracker.release(7, shot.release_t_ns, shot.expected_speed_mps, aimed(aim.x_m, aim.z_m).velocity_mps.z());
        std::vector<TrackedShot> settled;
        for (const auto& frame : shot.frames)
          for (const TrackedShot& one : tracker.frame(frame.t_ns, frame.ball_m)) settled.push_back(one);
        const auto tracked = only(settled);
        if (tracked.verdict.outcome == Outcome::kUnknown) continue;
        ++given;
        EXPECT_EQ(tracked.verdict.outcome, aim.outcome) << late_s << " s, seed " << seed;
      }
    }
  }
  EXPECT_GT(given, 130);
}

TEST(ShotTracker, ABallTurnedAwayAtOnceIsBlockedWhateverDelayTheFileHas) {
  int blocked = 0;
  for (const double late_s : {0.0, 0.08, 0.14, 0.2}) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
      Kick kick = aimed(0.0, 0.5);
      kick.opponent = {0.15, 4.6};
      const auto shot = fly(kick, airless(), seed);
      if (shot.truth.outcome != Outcome::kBlocked) continue;
      ++blocked;
      EXPECT_EQ(watched(expected_early(shot, late_s)).verdict.outcome, Outcome::kBlocked) << late_s << " s, " << seed;
    }
  }
  EXPECT_GT(blocked, 20);
}

// Nobody stops the game, and the ball flies on past the post with most of its speed. It was seen flying straight
// before.
TEST(ShotTracker, ABallThatGlancesOffAnOpponentAndPassesTheLineIsBlocked) {
  for (const double side : {-1.0, 1.0}) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
      Kick kick = aimed(0.0, 0.5);
      kick.opponent = {side * 0.3, 5.4};
      const auto shot = fly(kick, airless(), seed, 1.2);
      ASSERT_EQ(shot.truth.outcome, Outcome::kBlocked);
      const auto tracked = only(watch(shot, shot.release_t_ns, false));
      EXPECT_EQ(tracked.verdict.outcome, Outcome::kBlocked) << kicking::name(tracked.verdict.outcome) << seed;
    }
  }
}

TEST(ShotTracker, ALateReceiptGivesWhatAnEarlyOneGives) {
  const Kick kicks[] = {aimed(0.3, 0.5), aimed(-2.0, 0.6), aimed(1.06, 0.5), aimed(0.0, 1.06), aimed(0.2, 1.9)};
  for (const Kick& kick : kicks) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const auto shot = fly(kick, airless(), seed);
      const auto early = watched(shot);
      for (const std::int64_t late_ns : {20'000'000, 100'000'000, 400'000'000}) {
        const auto late = only(watch(shot, shot.release_t_ns + late_ns));
        EXPECT_EQ(late.t_ns, early.t_ns);
        EXPECT_EQ(late.sightings, early.sightings);
        EXPECT_EQ(late.verdict.outcome, early.verdict.outcome);
        EXPECT_EQ(late.verdict.x_cross_m, early.verdict.x_cross_m);
        EXPECT_EQ(late.verdict.z_cross_m, early.verdict.z_cross_m);
      }
    }
  }
}

TEST(ShotTracker, AReceiptThatComesAfterTheCrossingStillFindsTheShot) {
  const auto shot = fly(aimed(0.0, 0.5, 0.4), airless());
  const auto tracked = only(watch(shot, shot.truth.t_ns + 60'000'000));
  EXPECT_EQ(tracked.verdict.outcome, Outcome::kOnTarget);
}

TEST(ShotTracker, SurvivesACameraThatDropsEveryThirdFrame) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    auto shot = fly(aimed(0.3, 0.5), airless(), seed);
    for (std::size_t i = seed % 3; i < shot.frames.size(); i += 3) shot.frames[i].ball_m.reset();
    const auto tracked = watched(shot);
    EXPECT_EQ(tracked.verdict.outcome, Outcome::kOnTarget) << kicking::name(tracked.verdict.outcome);
    EXPECT_NEAR(*tracked.verdict.x_cross_m, 0.3, 5 * *tracked.verdict.sd_cross_m);
  }
}

TEST(ShotTracker, ABallLostInFlightIsUnknown) {
  auto shot = fly(aimed(0.3, 0.5), airless(), 1, 1.0);
  for (auto& frame : shot.frames)
    if (frame.t_ns > shot.release_t_ns + 300'000'000) frame.ball_m.reset();
  const auto tracked = only(watch(shot, shot.release_t_ns, false));
  EXPECT_EQ(tracked.verdict.outcome, Outcome::kUnknown);
  EXPECT_NEAR(kicking::seconds(tracked.t_ns - shot.release_t_ns), 0.3 + kSettings.lost_s, 0.05);
}

TEST(ShotTracker, AShotThatNobodySawIsUnknown) {
  auto shot = fly(aimed(0.3, 0.5), airless());
  for (auto& frame : shot.frames) frame.ball_m.reset();
  const auto tracked = watched(shot);
  EXPECT_EQ(tracked.verdict.outcome, Outcome::kUnknown);
  EXPECT_EQ(tracked.sightings, 0u);
  EXPECT_FALSE(tracked.verdict.exit_speed_mps);
}

TEST(ShotTracker, ABallThatNeverLeftTheRobotIsShort) {
  ShotTracker tracker{kSettings, kGoal};
  std::vector<TrackedShot> settled;
  for (std::int64_t t_ns = 0; t_ns <= 4'000'000'000 && settled.empty(); t_ns += kFrame_ns) {
    if (t_ns == 200'000'000) settled = tracker.release(7, t_ns, 6.0);
    if (settled.empty()) settled = tracker.frame(t_ns, Eigen::Vector3d{0.0, 4.0, 0.11});
  }
  EXPECT_EQ(only(settled).verdict.outcome, Outcome::kShort);
}

TEST(ShotTracker, ABallCarriedOnByTheRobotIsShortWhenTimeIsUp) {
  ShotTracker tracker{kSettings, kGoal};
  std::vector<TrackedShot> settled = tracker.release(7, 0, 6.0);
  std::int64_t t_ns = 0;
  for (; t_ns <= 5'000'000'000 && settled.empty(); t_ns += kFrame_ns)
    settled = tracker.frame(t_ns, Eigen::Vector3d{kicking::seconds(t_ns), 0.0, 0.11});
  EXPECT_EQ(only(settled).verdict.outcome, Outcome::kShort);
  EXPECT_NEAR(kicking::seconds(t_ns), kSettings.time_out_s, 0.1);
}

TEST(ShotTracker, ASecondReleaseEndsAnOpenShotAsUnknown) {
  ShotTracker tracker{kSettings, kGoal};
  const auto shot = fly(aimed(0.3, 0.5), airless());
  EXPECT_TRUE(tracker.release(1, shot.release_t_ns, shot.expected_speed_mps).empty());
  std::vector<TrackedShot> settled;
  for (const auto& frame : shot.frames) {
    if (frame.t_ns > shot.release_t_ns + 200'000'000 && settled.empty()) {
      settled = tracker.release(2, shot.release_t_ns + 4 * kFrame_ns, shot.expected_speed_mps);
      const auto first = only(settled);
      EXPECT_EQ(first.kick_id, 1);
      EXPECT_EQ(first.verdict.outcome, Outcome::kUnknown);
    }
    for (const auto& more : tracker.frame(frame.t_ns, frame.ball_m)) settled.push_back(more);
  }
  ASSERT_EQ(settled.size(), 2u);
  EXPECT_EQ(settled[1].kick_id, 2);
  EXPECT_EQ(settled[1].verdict.outcome, Outcome::kOnTarget);
}

TEST(ShotTracker, TheRefereesStopSettlesWhatIsOpenAndNothingElse) {
  ShotTracker tracker{kSettings, kGoal};
  EXPECT_TRUE(tracker.stopped(0).empty());
  const auto shot = fly(aimed(0.3, 0.5), airless());
  EXPECT_TRUE(tracker.release(1, shot.release_t_ns, shot.expected_speed_mps).empty());
  EXPECT_TRUE(tracker.stopped(shot.release_t_ns - 1).empty()) << "the stop before the kick";
  for (const auto& frame : shot.frames) {
    if (frame.t_ns > shot.release_t_ns + 400'000'000) break;
    EXPECT_TRUE(tracker.frame(frame.t_ns, frame.ball_m).empty());
  }
  const auto tracked = only(tracker.stopped(shot.release_t_ns + 400'000'000));
  EXPECT_EQ(tracked.verdict.outcome, Outcome::kUnknown) << "it flew freely: nothing was seen that stopped it";
  EXPECT_TRUE(tracker.stopped(shot.release_t_ns + 500'000'000).empty());
}

TEST(ShotTracker, SightingsThatAreNotFiniteAreNone) {
  auto shot = fly(aimed(0.3, 0.5), airless());
  for (std::size_t i = 0; i < shot.frames.size(); i += 4)
    shot.frames[i].ball_m = Eigen::Vector3d{std::nan(""), 5.0, HUGE_VAL};
  EXPECT_EQ(watched(shot).verdict.outcome, Outcome::kOnTarget);
}

// Kicks of every kind into the default world with its air: wrong only where noise explains it.
TEST(ShotTracker, AgreesWithTheTruthWhereverTheCrossingIsNotWithinTheNoise) {
  const sim::Scenario scenario;
  std::mt19937_64 random{2026};
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>{low, high}(random); };
  std::map<Outcome, int> truths;
  int close_calls = 0;
  for (unsigned i = 0; i < 150; ++i) {
    Kick kick;
    kick.from_m = {in(-2.5, 2.5), in(1.0, 6.0), 0.11};
    const double speed_mps = in(3.5, 11.0), elevation_rad = in(0.60, 0.66);
    const double azimuth_rad = std::atan2(in(-1.6, 1.6) - kick.from_m.x(), 9.0 - kick.from_m.y());
    kick.velocity_mps = {speed_mps * std::cos(elevation_rad) * std::sin(azimuth_rad),
                         speed_mps * std::cos(elevation_rad) * std::cos(azimuth_rad),
                         speed_mps * std::sin(elevation_rad)};
    if (i % 5 == 0) {
      const double along = in(0.8, 2.5);
      kick.opponent = {kick.from_m.x() + along * std::sin(azimuth_rad) + in(-0.3, 0.3),
                       kick.from_m.y() + along * std::cos(azimuth_rad)};
    }
    const auto shot = fly(kick, scenario, i);
    const auto tracked = watched(shot);
    ++truths[shot.truth.outcome];
    if (tracked.verdict.outcome == shot.truth.outcome) continue;
    ++close_calls;
    EXPECT_LT(shot.truth.margin_m.value_or(9.0), 0.15)
        << i << ": " << kicking::name(shot.truth.outcome) << " seen as " << kicking::name(tracked.verdict.outcome);
  }
  for (const auto outcome :
       {Outcome::kOnTarget, Outcome::kOver, Outcome::kShort, Outcome::kPost, Outcome::kBar, Outcome::kBlocked})
    EXPECT_GT(truths[outcome], 2) << kicking::name(outcome);
  EXPECT_LT(close_calls, 15);
}

}  // namespace
}  // namespace trivela::robot
