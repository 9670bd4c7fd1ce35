#include "sim/match.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>

namespace trivela::sim {
namespace {

using Policy = std::function<Commands(const Sensors&)>;

/// Everything that a match said.
struct Record {
  std::vector<Sensors> sensors;
  std::vector<KickTruth> kicks;
  std::vector<PossessionTruth> possessions;
};

Record play(const Scenario& scenario, std::uint64_t seed, int halves, double minutes, const Policy& policy) {
  Match match{scenario, seed, halves, minutes};
  Record record;
  while (!match.done()) {
    record.sensors.push_back(match.sense());
    const StepEvents events = match.step(policy(record.sensors.back()));
    record.kicks.insert(record.kicks.end(), events.kicks.begin(), events.kicks.end());
    record.possessions.insert(record.possessions.end(), events.possessions.begin(), events.possessions.end());
  }
  return record;
}

Commands idle(const Sensors&) { return {}; }

/// Drives on and fires in the first cycle of each possession.
Policy fire_at_once(double power) {
  return [power, last = std::uint32_t{0}](const Sensors& s) mutable {
    Commands commands{.drive = {0.2, 1.0, 0.3}, .fire = {}};
    if (s.referee.playing && s.referee.possession_id != last) {
      last = s.referee.possession_id;
      commands.fire = Fire{s.t_ns, static_cast<std::int64_t>(1000 + last), power};
    }
    return commands;
  };
}

/// Nobody disturbs.
Scenario alone() {
  Scenario s;
  s.opponent.distance_median_m = 50.0;
  s.opponent.distance_sigma_ln = 0.0;
  return s;
}

bool same_bits(const std::optional<kicking::Pose>& a, const std::optional<kicking::Pose>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->x_m == b->x_m && a->y_m == b->y_m && a->heading_rad == b->heading_rad;
}

TEST(Match, TheSameSeedAndCommandsGiveTheSameBits) {
  const Record a = play({}, 42, 2, 0.3, fire_at_once(25)), b = play({}, 42, 2, 0.3, fire_at_once(25));
  ASSERT_EQ(a.sensors.size(), b.sensors.size());
  ASSERT_GT(a.kicks.size(), 3U);
  for (std::size_t i = 0; i < a.sensors.size(); ++i) {
    ASSERT_EQ(a.sensors[i].wheels.wheel_radps, b.sensors[i].wheels.wheel_radps);
    ASSERT_EQ(a.sensors[i].kicker.charge, b.sensors[i].kicker.charge);
    ASSERT_TRUE(same_bits(a.sensors[i].vision.pose, b.sensors[i].vision.pose));
  }
  ASSERT_EQ(a.kicks.size(), b.kicks.size());
  for (std::size_t i = 0; i < a.kicks.size(); ++i) {
    ASSERT_EQ(a.kicks[i].release_velocity_mps.x, b.kicks[i].release_velocity_mps.x);
    ASSERT_EQ(a.kicks[i].margin_m, b.kicks[i].margin_m);
  }
}

TEST(Match, AnotherSeedIsAnotherMatch) {
  EXPECT_NE((Match{Scenario{}, 1, 1, 1.0}.sense().wheels.wheel_radps[0]),
            (Match{Scenario{}, 2, 1, 1.0}.sense().wheels.wheel_radps[0]));
}

TEST(Match, EveryPolicyAndHalfMeetsTheSameOpportunities) {
  const Record still = play({}, 42, 2, 0.5, idle), kicking = play({}, 42, 1, 0.5, fire_at_once(30));
  std::map<std::uint32_t, PossessionTruth> first;
  for (const auto& p : kicking.possessions) first[p.possession_id] = p;
  int compared = 0;
  for (const auto& p : still.possessions) {
    const auto match = first.find(p.possession_id);
    if (match == first.end()) continue;
    EXPECT_EQ(p.start.x_m, match->second.start.x_m);
    EXPECT_EQ(p.start.heading_rad, match->second.start.heading_rad);
    ++compared;
  }
  EXPECT_GT(compared, 6);
  // The noise too: the first sample of each possession, before the policies differ.
  const auto noise = [](const Record& record, int half) {
    std::map<std::uint32_t, double> gyro;
    for (const auto& s : record.sensors) {
      if (s.referee.half == half) gyro.try_emplace(s.referee.possession_id, s.wheels.gyro_radps);
    }
    return gyro;
  };
  const auto a = noise(still, 1), b = noise(still, 2), c = noise(kicking, 1);
  for (std::uint32_t id = 1; id <= 5; ++id) {
    EXPECT_EQ(a.at(id), b.at(id));
    EXPECT_EQ(a.at(id), c.at(id));
  }
}

TEST(Match, EachPossessionBeginsWithAStopInWhichTheRobotStands) {
  const Record record = play({}, 3, 1, 0.3, [](const Sensors&) { return Commands{.drive = {1, 1, 1}, .fire = {}}; });
  std::uint32_t id = 0;
  std::int64_t stopped_since = 0;
  bool played = false;
  for (const auto& s : record.sensors) {
    if (s.referee.possession_id != id) {
      EXPECT_EQ(s.referee.possession_id, id + 1);
      EXPECT_FALSE(s.referee.playing);
      id = s.referee.possession_id;
      stopped_since = s.t_ns;
      played = false;
    }
    if (s.referee.playing && !played) {
      EXPECT_EQ(s.t_ns - stopped_since, 1'000'000'000);
    }
    if (!s.referee.playing && !played) {
      EXPECT_LT(std::abs(s.wheels.gyro_radps), 0.2);
    }
    played = played || s.referee.playing;
  }
  EXPECT_GT(id, 3U);
}

TEST(Match, GainsTheBallOnTheRun) {
  Scenario s;
  s.odometry = {0, 0, 0, 0};
  Match match{s, 1, 1, 1.0};
  while (!match.sense().referee.playing) match.step({});
  const auto w = match.sense().wheels.wheel_radps;
  EXPECT_GT(std::abs(w[0]) + std::abs(w[1]) + std::abs(w[2]), 3.0);
  EXPECT_NEAR(w[0] + w[1] + w[2], 0.0, 1e-9);  // it does not turn
}

TEST(Match, AnIdleRobotLosesTheBallToTheOpponent) {
  const Record record = play({}, 5, 1, 1.0, idle);
  ASSERT_GT(record.possessions.size(), 10U);
  EXPECT_TRUE(record.kicks.empty());
  for (const auto& p : record.possessions) EXPECT_EQ(p.ending, PossessionEnd::kDisputed);
}

TEST(Match, AnUndisturbedPossessionTimesOut) {
  const Record record = play(alone(), 5, 1, 0.3, idle);
  for (const auto& p : record.possessions) {
    EXPECT_EQ(p.ending, PossessionEnd::kTimedOut);
    EXPECT_NEAR(static_cast<double>(p.t_ns - p.start_t_ns), 8e9, 1e6);
  }
}

TEST(Match, CarryingTheBallOutEndsThePossession) {
  const Record record = play(alone(), 5, 1, 0.3, [](const Sensors& s) {
    // Drive along +y of F, over the goal line.
    const double h = s.vision.pose ? s.vision.pose->heading_rad : 0.0;
    return Commands{.drive = {2.2 * std::sin(h), 2.2 * std::cos(h), 0.0}, .fire = {}};
  });
  ASSERT_FALSE(record.possessions.empty());
  for (const auto& p : record.possessions) {
    EXPECT_EQ(p.ending, PossessionEnd::kTimedOut);
    EXPECT_LT(p.t_ns - p.start_t_ns, 8'000'000'000);
  }
}

TEST(Match, AKickEndsThePossessionAndItsTruthNamesIt) {
  const Record record = play(alone(), 7, 1, 0.5, fire_at_once(25));
  ASSERT_GT(record.kicks.size(), 5U);
  ASSERT_EQ(record.kicks.size(), record.possessions.size());
  for (std::size_t i = 0; i < record.kicks.size(); ++i) {
    const KickTruth& kick = record.kicks[i];
    const PossessionTruth& possession = record.possessions[i];
    EXPECT_EQ(possession.ending, PossessionEnd::kKicked);
    EXPECT_EQ(kick.kick_id, 1000 + static_cast<std::int64_t>(kick.possession_id));
    EXPECT_EQ(kick.possession_id, possession.possession_id);
    EXPECT_GT(kick.release_t_ns, possession.start_t_ns);
    EXPECT_LT(kick.release_t_ns - possession.start_t_ns, 150'000'000);
    EXPECT_GT(kick.t_ns, kick.release_t_ns);
    EXPECT_LE(kick.t_ns - kick.release_t_ns, 3'001'000'000);
    EXPECT_NE(kick.outcome, kicking::Outcome::kUnknown);
    EXPECT_EQ(kick.crossing.has_value(), kick.outcome != kicking::Outcome::kShort);
    EXPECT_TRUE(kick.margin_m);
  }
}

TEST(Match, TheBallLeavesAtTheRobotsPointAtTheInstantOfRelease) {
  Scenario s = alone();
  s.kicker.delay_sd_s = s.kicker.speed_sd_ratio = s.kicker.direction_sd_rad = 0.0;
  s.kicker.delay_s = 0.0333;
  Match match{s, 7, 1, 0.5};
  Sensors sensors = match.sense();
  while (!sensors.referee.playing) {
    match.step({});
    sensors = match.sense();
  }
  const std::int64_t fire_t_ns = sensors.t_ns + 7'000'123;
  Commands commands{.drive = {0, 0, 0}, .fire = Fire{fire_t_ns, 1, 25}};
  std::vector<KickTruth> kicks;
  while (kicks.empty()) {
    kicks = match.step(commands).kicks;
    commands.fire.reset();
  }
  EXPECT_EQ(kicks[0].release_t_ns, fire_t_ns + 33'300'000);
  const auto& v = kicks[0].release_velocity_mps;
  EXPECT_NEAR(v.z, Kicker{}.exit_speeds_mps[2] * std::sin(Kicker{}.exit_elevations_rad[2]), 1e-9);
}

TEST(Match, AFireWithoutABallDrainsAndHasNoTruth) {
  Match match{alone(), 7, 1, 0.02};
  // In the referee's stop.
  StepEvents events = match.step({.drive = {}, .fire = Fire{0, 1, 50}});
  EXPECT_NEAR(match.sense().kicker.charge, 0.5, 0.02);
  std::size_t kicks = 0;
  std::int64_t second_at = 0;
  while (!match.done()) {
    const Sensors s = match.sense();
    Commands commands;
    if (s.referee.playing && second_at == 0) {
      second_at = s.t_ns;
      commands.fire = Fire{s.t_ns, 2, 25};
    } else if (second_at != 0 && s.t_ns == second_at + 400'000'000) {
      commands.fire = Fire{s.t_ns, 3, 25};  // the ball is on its way
    }
    events = match.step(commands);
    for (const auto& kick : events.kicks) {
      EXPECT_EQ(kick.kick_id, 2);
      ++kicks;
    }
  }
  EXPECT_EQ(kicks, 1U);
}

TEST(Match, ACoilEnergisedBeforeTheEndWins) {
  Scenario s;
  s.opponent.distance_sigma_ln = 0.0;
  s.opponent.distance_median_m = 0.52;  // 25 ms away at 0.8 m/s: less than the kicker's delay
  s.opponent.closing_max_mps = 0.8;
  const Record record = play(s, 7, 1, 0.2, fire_at_once(25));
  ASSERT_GT(record.kicks.size(), 1U);
  for (const auto& p : record.possessions) EXPECT_EQ(p.ending, PossessionEnd::kKicked);
  for (const auto& p : play(s, 7, 1, 0.2, idle).possessions) EXPECT_EQ(p.ending, PossessionEnd::kDisputed);
}

TEST(Match, AnOrderTooLateForItsPossessionNeverKicksInTheNext) {
  Scenario s = alone();
  s.possession.time_limit_s = 0.5;
  Policy late = [](const Sensors& sensors) {
    Commands commands;
    if (!sensors.referee.playing) commands.fire = Fire{sensors.t_ns, 5, 25};
    return commands;
  };
  s.possession.stop_s = 0.1;
  const Record record = play(s, 7, 1, 0.1, late);
  EXPECT_GT(record.possessions.size(), 5U);
  EXPECT_TRUE(record.kicks.empty());
}

TEST(Match, SurvivesCommandsThatAreNoNumbers) {
  const double nan = std::nan("");
  const Record record = play({}, 5, 1, 0.1, [&](const Sensors& s) {
    return Commands{.drive = {nan, nan, nan}, .fire = Fire{s.t_ns, 1, nan}};
  });
  EXPECT_TRUE(record.kicks.empty());
  EXPECT_FALSE(record.possessions.empty());
  for (const auto& s : record.sensors) {
    for (const double w : s.wheels.wheel_radps) ASSERT_TRUE(std::isfinite(w));
    ASSERT_TRUE(std::isfinite(s.kicker.charge));
  }
}

TEST(Match, HalvesLastAsLongAsAskedAndEndWithAStop) {
  const Record record = play({}, 5, 3, 0.2, idle);
  int half = 1;
  std::int64_t start = 0;
  for (std::size_t i = 1; i < record.sensors.size(); ++i) {
    const auto& s = record.sensors[i];
    ASSERT_EQ(s.t_ns - record.sensors[i - 1].t_ns, 20'000'000);
    if (s.referee.half == half) continue;
    EXPECT_EQ(s.referee.half, half + 1);
    EXPECT_EQ(s.referee.possession_id, 1U);
    EXPECT_FALSE(record.sensors[i - 1].referee.playing);
    EXPECT_GE(s.t_ns - start, 12'000'000'000);
    EXPECT_LT(s.t_ns - start, 12'000'000'000 + 10'000'000'000);
    start = s.t_ns;
    ++half;
  }
  EXPECT_EQ(half, 3);
  EXPECT_FALSE(record.sensors.back().referee.playing);
}

TEST(Match, AStepTakesLessThanTwentyMicroseconds) {
  Match match{alone(), 1, 1, 10.0};
  for (int i = 0; i < 100; ++i) match.step({});
  double best_s = 1.0;
  for (int i = 0; i < 50; ++i) {
    const auto start = std::chrono::steady_clock::now();
    match.step({.drive = {0.5, 0.5, 0.5}, .fire = {}});
    match.sense();
    best_s = std::min(best_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
#ifdef NDEBUG
  EXPECT_LT(best_s, 20e-6);
#else
  EXPECT_LT(best_s, 500e-6);  // without optimisation, perhaps under a sanitizer
#endif
}

}  // namespace
}  // namespace trivela::sim
