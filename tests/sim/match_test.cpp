#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/kicker/kicker.hpp"
#include "sim/opportunity.hpp"
#include "tests/sim/played_match.hpp"

namespace trivela::sim {
namespace {

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
      EXPECT_EQ(s.t_ns - stopped_since, 400'000'000);
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
  const Record record = play({}, 5, 1, 0.6, idle);
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

TEST(Match, TheRefereeStopsWhoCarriesTheBallTooFar) {
  Scenario s = alone();
  s.rules.carry_limit_m = 1.5;
  s.possession.goal_distance_min_m = 6.0;
  const auto ahead = [](const Sensors&) { return Commands{.drive = {0.0, 2.0, 0.0}, .fire = {}}; };
  const Record record = play(s, 5, 1, 0.3, ahead);
  ASSERT_GT(record.possessions.size(), 3U);
  for (const auto& p : record.possessions) {
    EXPECT_EQ(p.ending, PossessionEnd::kStopped);
    // From at most 2 m/s in any direction to 2 m/s ahead, then 1.5 m in a straight line: not at once, not late.
    EXPECT_GT(p.t_ns - p.start_t_ns, 700'000'000);
    EXPECT_LT(p.t_ns - p.start_t_ns, 2'500'000'000);
  }
  s.rules.carry_limit_m = 0.0;
  for (const auto& p : play(s, 5, 1, 0.3, ahead).possessions) EXPECT_NE(p.ending, PossessionEnd::kStopped);
}

TEST(Match, ABallFromTheOwnHalfIsNoGoalWhereTheRulesSaySo) {
  Scenario s = alone();
  s.possession.goal_distance_min_m = s.possession.goal_distance_max_m = s.field.goal_line_y_m + 0.5;
  s.possession.aim_error_sd_rad = s.possession.speed_min_mps = s.possession.speed_max_mps = 0.0;
  s.possession.lateral_max_m = 0.5;
  const auto goals = [&s] { return play(s, 7, 1, 1.0, fire_at_once(30)).sensors.back().referee.goals; };
  EXPECT_GT(goals(), 3U);
  s.rules.opponents_half_only = true;
  EXPECT_EQ(goals(), 0U);
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
    EXPECT_LE(kick.t_ns - kick.release_t_ns, 3'020'000'000);  // looked at once a cycle
    EXPECT_NE(kick.outcome, kicking::Outcome::kUnknown);
    EXPECT_EQ(kick.crossing.has_value(), kick.outcome != kicking::Outcome::kShort);
    EXPECT_TRUE(kick.margin_m);
  }
}

TEST(Match, TheBallLeavesAtTheRobotsPointAtTheInstantOfRelease) {
  Scenario s = alone();
  s.kicker.delay_sd_s = s.kicker.speed_sd_ratio = s.kicker.direction_sd_rad = s.kicker.drift_sd_ratio = 0.0;
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
  EXPECT_NEAR(v.z(), Kicker{}.exit_speeds_mps[2] * std::sin(Kicker{}.exit_elevations_rad[2]), 1e-9);
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

TEST(Match, TheRefereeStopsAPossessionButNoBallInTheAir) {
  Scenario s = alone();
  s.referee.stops_per_min = 60.0;
  const Record carried = play(s, 5, 1, 1.0, idle);
  int stopped = 0;
  for (const auto& p : carried.possessions) stopped += p.ending == PossessionEnd::kStopped;
  EXPECT_GT(stopped, static_cast<int>(carried.possessions.size()) * 9 / 10);
  for (const auto& p : carried.possessions) {
    if (p.ending != PossessionEnd::kStopped) continue;
    EXPECT_EQ(
        p.t_ns - p.start_t_ns,
        static_cast<std::int64_t>(std::ceil(draw_opportunity(s, kicking::Draws{5, p.possession_id}).whistle_s * 1e9)));
  }
  for (const auto& p : play(s, 5, 1, 1.0, fire_at_once(30)).possessions) {
    if (draw_opportunity(s, kicking::Draws{5, p.possession_id}).whistle_s > 0.02) {
      EXPECT_EQ(p.ending, PossessionEnd::kKicked);
    }
  }
}

TEST(Match, ASetPieceIsAnnouncedInItsStopAndTakenByARobotThatStands) {
  Scenario s = alone();
  s.referee.set_pieces = true;
  const Record record = play(s, 5, 1, 0.5, idle);
  std::set<std::uint32_t> announced;
  for (const Sensors& now : record.sensors) {
    EXPECT_FALSE(now.referee.set_piece && now.referee.playing);
    if (now.referee.set_piece) announced.insert(now.referee.possession_id);
  }
  EXPECT_EQ(announced.size(), record.possessions.size()) << "each";
  EXPECT_FALSE(record.sensors.back().referee.set_piece) << "nothing follows the half's last stop";
  Match match{s, 5, 1, 0.5};
  for (int i = 0; i < 40; ++i) {
    EXPECT_NEAR(match.true_state().twist.vy_mps, 0.0, 1e-12) << "cycle " << i;
    match.step({});
  }
}

TEST(Match, ASetPieceThatIsNotTakenInTimeIsWhistledAndOneThatIsGoesOn) {
  Scenario s = alone();
  s.referee.set_pieces = true;
  s.rules.set_piece_s = 2.0;
  const Record waited = play(s, 5, 1, 0.5, idle);
  ASSERT_GT(waited.possessions.size(), 5u);
  for (const auto& p : waited.possessions) {
    EXPECT_EQ(p.ending, PossessionEnd::kStopped);
    EXPECT_EQ(p.t_ns - p.start_t_ns, 2'000'000'000);
  }
  for (const auto& p : play(s, 5, 1, 0.5, fire_at_once(30)).possessions) EXPECT_EQ(p.ending, PossessionEnd::kKicked);
  s.referee.set_pieces = false;
  for (const auto& p : play(s, 5, 1, 0.5, idle).possessions)
    EXPECT_NE(p.ending, PossessionEnd::kStopped) << "the ball was gained on the run";
}

TEST(Match, EachPossessionBelongsToOneRobotOfTheTeamWithItsOwnKicker) {
  Scenario s = alone();
  s.kicker.speed_sd_ratio = s.kicker.delay_sd_s = s.kicker.direction_sd_rad = s.kicker.drift_sd_ratio = 0.0;
  s.team.robots = 3;
  s.team.speed_scale_ratios = {1.0, 0.9, 1.1};
  s.referee.stops_per_min = 0.0;
  Match match{s, 8, 1, 0.6};
  Policy policy = fire_at_once(25);
  std::set<int> kicked;
  while (!match.done()) {
    const Sensors sensors = match.sense();
    const auto events = match.step(policy(sensors));
    for (const auto& p : events.possessions) EXPECT_EQ(p.robot, sensors.carrier);
    for (const auto& k : events.kicks) {
      const double ratio = s.team.speed_scale_ratios[sensors.carrier - 1U];
      EXPECT_NEAR(k.release_velocity_mps.z(), ratio * 8.721521 * std::sin(0.62666896), 1e-9);
      kicked.insert(sensors.carrier);
    }
  }
  EXPECT_EQ(kicked.size(), 3U);
}

TEST(Match, AKickerDriftsOnceAMatchAndByItsSpread) {
  Scenario s;
  s.kicker.drift_sd_ratio = 0.03;
  s.team.robots = 2;
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const double first = match_kicker(s, 1, seed).speed_scale_ratio,
                 second = match_kicker(s, 2, seed).speed_scale_ratio;
    EXPECT_NE(first, second);
    EXPECT_EQ((Match{s, seed, 1, 1.0}.true_kicker(2).speed_scale_ratio), second);
    for (const double ratio : {first, second}) {
      sum += (ratio - 1.0) / 1000;
      squares += (ratio - 1.0) * (ratio - 1.0) / 1000;
    }
  }
  EXPECT_NEAR(sum, 0.0, 4 * 0.03 / std::sqrt(1000.0));
  EXPECT_NEAR(std::sqrt(squares), 0.03, 4 * 0.03 / std::sqrt(2000.0));
  EXPECT_EQ(team_kicker(s, 2).speed_scale_ratio, 1.0);
}

TEST(Match, AKickerGivesWayAfterItsOwnKicksOnce) {
  Scenario s = alone();
  s.kicker.speed_sd_ratio = s.kicker.delay_sd_s = s.kicker.direction_sd_rad = s.kicker.drift_sd_ratio = 0.0;
  s.kicker.drop_ratio = 0.03;
  s.kicker.drop_after_kicks = 3;
  s.team.robots = 2;
  Match match{s, 7, 1, 1.0};
  std::uint32_t kicked[3] = {};
  while (!match.done()) {
    const Sensors sensors = match.sense();
    for (const auto& k : match.step(fire_at_once(25)(sensors)).kicks) {
      const double ratio = ++kicked[sensors.carrier] <= 3 ? 1.0 : 0.97;
      EXPECT_NEAR(k.release_velocity_mps.z(), ratio * 8.721521 * std::sin(0.62666896), 1e-9);
    }
  }
  for (const std::uint32_t robot : {1U, 2U}) {
    EXPECT_GT(kicked[robot], 5U);
    EXPECT_NEAR(match.true_kicker(robot).speed_scale_ratio, 0.97, 1e-12);
  }
}

TEST(Match, AFullCapacitorAwaitsEachPossession) {
  const Record record = play(alone(), 7, 1, 0.3, fire_at_once(50));
  std::uint32_t id = 0;
  for (const auto& s : record.sensors) {
    if (s.referee.possession_id != id) {
      EXPECT_EQ(s.kicker.charge, 1.0);
    }
    id = s.referee.possession_id;
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

}  // namespace
}  // namespace trivela::sim
