// The laser beside the field of a match.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kicking/geometry/time.hpp"
#include "sim/match.hpp"

namespace trivela::sim {
namespace {

/// The robot stands 12 m before the goal and faces it; the laser is 4 m before its ball.
Scenario at_the_laser() {
  Scenario scenario;
  scenario.laser.enabled = true;
  scenario.laser.range_sd_m = scenario.laser.dropout_ratio = scenario.laser.mixed_ratio = 0.0;
  scenario.kicker.direction_sd_rad = 0.0;
  scenario.possession = {.goal_distance_min_m = 12.0,
                         .goal_distance_max_m = 12.0,
                         .lateral_max_m = 0.0,
                         .aim_error_sd_rad = 0.0,
                         .speed_min_mps = 0.0,
                         .speed_max_mps = 0.0,
                         .stop_s = 0.2,
                         .flight_limit_s = 1.5};
  scenario.opponent.distance_median_m = 50.0;
  scenario.opponent.closing_min_mps = scenario.opponent.closing_max_mps = 0.0;
  return scenario;
}

struct Watched {
  std::vector<kicking::lob::Scan> scans;
  std::vector<KickTruth> kicks;
  int possessions = 0;
};

/// Plays a match that kicks half a second into each possession.
Watched watch(const Scenario& scenario, std::uint32_t max_possessions) {
  Match match{scenario, 3, 1, 10.0, max_possessions};
  Watched watched;
  std::uint32_t kicked = 0;
  double playing_s = 0.0;
  while (!match.done()) {
    const Sensors sensors = match.sense();
    watched.scans.insert(watched.scans.end(), sensors.scans.begin(), sensors.scans.end());
    playing_s = sensors.referee.playing ? playing_s + scenario.cycle_s : 0.0;
    Commands commands;
    if (playing_s > 0.5 && kicked < sensors.referee.possession_id) {
      kicked = sensors.referee.possession_id;
      commands.fire = Fire{sensors.t_ns, kicked, 30.0};
    }
    const StepEvents events = match.step(commands);
    watched.kicks.insert(watched.kicks.end(), events.kicks.begin(), events.kicks.end());
    watched.possessions += static_cast<int>(events.possessions.size());
  }
  return watched;
}

TEST(MatchLaser, GivesEveryScanOnceAndInTime) {
  const Watched watched = watch(at_the_laser(), 2);
  ASSERT_GT(watched.scans.size(), 100u);
  for (std::size_t i = 0; i < watched.scans.size(); ++i) {
    EXPECT_EQ(watched.scans[i].t_ns, std::int64_t{25'000'000} * static_cast<std::int64_t>(i));
    EXPECT_EQ(watched.scans[i].range_mm.size(), 1081u);
  }
}

TEST(MatchLaser, SeesTheBallFlyOverIt) {
  const Watched watched = watch(at_the_laser(), 1);
  ASSERT_EQ(watched.kicks.size(), 1u);
  const KickTruth& kick = watched.kicks.front();
  // A ball at 30 degrees of drag-free lob is straight above the laser, 4 m away, about when it has flown 4 m.
  const double over_s = 4.0 / kick.release_velocity_mps.y();
  const double height_m = 0.11 + kick.release_velocity_mps.z() * over_s - 0.5 * 9.81 * over_s * over_s;
  std::uint32_t nearest_mm = 100'000;
  for (const auto& scan : watched.scans) {
    const double age_s = kicking::seconds(scan.t_ns - kick.release_t_ns);
    if (std::abs(age_s - over_s) < 0.05)
      for (std::size_t beam = 520; beam <= 560; ++beam)  // within 5 degrees of straight up
        if (scan.range_mm[beam] >= kicking::lob::kFirstRange_mm) nearest_mm = std::min(nearest_mm, scan.range_mm[beam]);
  }
  EXPECT_NEAR(1e-3 * nearest_mm, height_m - 0.11 - 0.05, 0.12);
}

TEST(MatchLaser, ChangesNothingElse) {
  Scenario without = at_the_laser();
  without.laser.enabled = false;
  const Watched seen = watch(at_the_laser(), 3), unseen = watch(without, 3);
  EXPECT_TRUE(unseen.scans.empty());
  ASSERT_EQ(seen.kicks.size(), unseen.kicks.size());
  for (std::size_t i = 0; i < seen.kicks.size(); ++i) {
    EXPECT_EQ(seen.kicks[i].release_t_ns, unseen.kicks[i].release_t_ns);
    EXPECT_EQ(seen.kicks[i].release_velocity_mps.x(), unseen.kicks[i].release_velocity_mps.x());
    EXPECT_EQ(seen.kicks[i].release_velocity_mps.z(), unseen.kicks[i].release_velocity_mps.z());
  }
}

TEST(MatchLimit, AHalfEndsAfterSoManyPossessions) {
  for (const std::uint32_t possessions : {1u, 4u}) {
    EXPECT_EQ(watch(at_the_laser(), possessions).possessions, static_cast<int>(possessions));
  }
}

}  // namespace
}  // namespace trivela::sim
