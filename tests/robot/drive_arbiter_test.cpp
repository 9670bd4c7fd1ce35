#include "robot/odometry/drive_arbiter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>
#include <vector>

namespace trivela::robot {
namespace {

using config::DriveMode;

constexpr std::int64_t kNow_ns = 1'000'000'000;
constexpr DriveSituation kAway{}, kHeld{true, true}, kStanding{false, false}, kHeldStanding{false, true};

config::Odometry timeouts(double own_s, double team_s) {
  config::Odometry odometry;
  odometry.drive_timeout_s = own_s;
  odometry.team_drive_timeout_s = team_s;
  return odometry;
}

/// Kick_decision says 1 m/s, the team 2 m/s.
DriveArbiter told_by_both(DriveMode mode) {
  DriveArbiter arbiter{mode, timeouts(0.2, 0.2)};
  EXPECT_TRUE(arbiter.receive(msg::DRIVE_KICK_DECISION, kNow_ns, {0.0, 1.0, 0.0}, kNow_ns));
  EXPECT_TRUE(arbiter.receive(msg::DRIVE_TEAM, kNow_ns, {0.0, 2.0, 0.0}, kNow_ns));
  return arbiter;
}

TEST(DriveArbiter, DecidesByModeBallAndGame) {
  struct Row {
    DriveMode mode;
    DriveSituation situation;
    msg::DriveSource obeyed;
    double vy_mps;
  };
  const std::vector<Row> rows{{DriveMode::kAlways, kAway, msg::DRIVE_KICK_DECISION, 1.0},
                              {DriveMode::kAlways, kHeld, msg::DRIVE_KICK_DECISION, 1.0},
                              {DriveMode::kAlways, kStanding, msg::DRIVE_TEAM, 2.0},
                              {DriveMode::kAlways, kHeldStanding, msg::DRIVE_TEAM, 2.0},
                              {DriveMode::kWithBall, kAway, msg::DRIVE_TEAM, 2.0},
                              {DriveMode::kWithBall, kHeld, msg::DRIVE_KICK_DECISION, 1.0},
                              {DriveMode::kWithBall, kStanding, msg::DRIVE_TEAM, 2.0},
                              {DriveMode::kWithBall, kHeldStanding, msg::DRIVE_TEAM, 2.0},
                              {DriveMode::kAdvice, kAway, msg::DRIVE_TEAM, 2.0},
                              {DriveMode::kAdvice, kHeld, msg::DRIVE_TEAM, 2.0},
                              {DriveMode::kAdvice, kStanding, msg::DRIVE_TEAM, 2.0},
                              {DriveMode::kAdvice, kHeldStanding, msg::DRIVE_TEAM, 2.0}};
  for (const Row& row : rows) {
    const ObeyedDrive obeyed = told_by_both(row.mode).decide(kNow_ns, row.situation);
    const int mode = static_cast<int>(row.mode);
    EXPECT_EQ(obeyed.source, row.obeyed) << mode << row.situation.playing << row.situation.possession;
    EXPECT_EQ(obeyed.twist.vy_mps, row.vy_mps) << mode << row.situation.playing << row.situation.possession;
  }
}

TEST(DriveArbiter, WithoutATeamsProgramKickDecisionGoesOnWhileTheGameStands) {
  DriveArbiter arbiter{DriveMode::kAlways, timeouts(0.2, 0.2)};
  arbiter.receive(msg::DRIVE_KICK_DECISION, kNow_ns, {}, kNow_ns);
  EXPECT_EQ(arbiter.decide(kNow_ns, kStanding).source, msg::DRIVE_KICK_DECISION);
  EXPECT_FALSE(arbiter.situation_matters(kNow_ns));
}

TEST(DriveArbiter, EachGoesSilentAfterItsOwnTimeoutAndTheOtherDoesNotStepIn) {
  for (const msg::DriveSource silent : {msg::DRIVE_KICK_DECISION, msg::DRIVE_TEAM}) {
    DriveArbiter arbiter{DriveMode::kWithBall, timeouts(0.1, 0.3)};
    arbiter.receive(silent, kNow_ns, {1.0, 0.0, 0.0}, kNow_ns);
    const bool team = silent == msg::DRIVE_TEAM;
    const DriveSituation situation = team ? kAway : kHeld;
    const std::int64_t last_ns = kNow_ns + (team ? 300'000'000 : 100'000'000);
    arbiter.receive(team ? msg::DRIVE_KICK_DECISION : msg::DRIVE_TEAM, last_ns, {9.0, 0.0, 0.0}, last_ns);
    EXPECT_EQ(arbiter.decide(last_ns, situation).source, silent);
    const ObeyedDrive obeyed = arbiter.decide(last_ns + 1, situation);
    EXPECT_EQ(obeyed.source, msg::DRIVE_NOBODY);
    EXPECT_EQ(obeyed.twist.vx_mps, 0.0);
    EXPECT_NEAR(arbiter.silence_s(last_ns + 1, situation).value_or(0.0), team ? 0.3 : 0.1, 1e-6);
  }
}

TEST(DriveArbiter, WhoNeverSpokeHasNoSilence) {
  const DriveArbiter arbiter{DriveMode::kAdvice, timeouts(0.2, 0.2)};
  EXPECT_EQ(arbiter.decide(kNow_ns, kHeld).source, msg::DRIVE_NOBODY);
  EXPECT_FALSE(arbiter.silence_s(kNow_ns, kHeld));
}

TEST(DriveArbiter, ACommandThatIsNotFiniteIsStandstill) {
  DriveArbiter arbiter = told_by_both(DriveMode::kAdvice);
  EXPECT_TRUE(arbiter.receive(msg::DRIVE_TEAM, kNow_ns, {0.0, std::numeric_limits<double>::quiet_NaN(), 1.0}, kNow_ns));
  const ObeyedDrive obeyed = arbiter.decide(kNow_ns, kAway);
  EXPECT_EQ(obeyed.source, msg::DRIVE_TEAM);
  EXPECT_EQ(obeyed.twist.vy_mps, 0.0);
  EXPECT_EQ(obeyed.twist.omega_radps, 0.0);
}

TEST(DriveArbiter, NoInstantIsSoFarOffThatItCounts) {
  DriveArbiter arbiter = told_by_both(DriveMode::kAdvice);
  for (const std::int64_t t_ns :
       {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1}, std::numeric_limits<std::int64_t>::max()})
    EXPECT_FALSE(arbiter.receive(msg::DRIVE_TEAM, t_ns, {9.0, 9.0, 9.0}, kNow_ns));
  EXPECT_EQ(arbiter.decide(kNow_ns, kAway).twist.vy_mps, 2.0) << "the one before goes on";
}

TEST(DriveSituation, ABeliefThatIsOldSaysNothing) {
  msg::WorldState world{};
  world.t_ns = kNow_ns;
  world.possession = true;
  EXPECT_TRUE(drive_situation(world, kNow_ns + 200'000'000, 0.2).possession);
  EXPECT_FALSE(drive_situation(world, kNow_ns, 0.2).playing);
  const DriveSituation unknown = drive_situation(world, kNow_ns + 200'000'001, 0.2);
  EXPECT_TRUE(unknown.playing);
  EXPECT_FALSE(unknown.possession);
  EXPECT_FALSE(drive_situation({}, kNow_ns, 0.2).possession);
}

/// A command as somebody wrote it.
struct Said {
  msg::DriveSource source;
  std::int64_t t_ns;
  double vx_mps;
};

void check_obeyed(DriveMode mode, const DriveSituation& situation, const ObeyedDrive& obeyed,
                  const std::vector<Said>& said, std::int64_t now_ns) {
  constexpr std::int64_t kTimeout_ns[] = {0, 200'000'000, 300'000'000};  // of nobody, kick_decision, team
  if (obeyed.source == msg::DRIVE_NOBODY) {
    RC_ASSERT(obeyed.twist.vx_mps == 0.0);
    return;
  }
  bool was_said = false;
  for (const Said& word : said) {
    const std::int64_t age_ns = now_ns > word.t_ns ? now_ns - word.t_ns : word.t_ns - now_ns;
    was_said = was_said || (word.source == obeyed.source && word.t_ns == obeyed.t_ns &&
                            word.vx_mps == obeyed.twist.vx_mps && age_ns <= kTimeout_ns[obeyed.source]);
  }
  RC_ASSERT(was_said);
  if (obeyed.source == msg::DRIVE_TEAM) {
    RC_ASSERT(mode != DriveMode::kAlways || !situation.playing);
    RC_ASSERT(mode != DriveMode::kWithBall || !(situation.playing && situation.possession));
  } else {
    RC_ASSERT(mode != DriveMode::kAdvice);
    RC_ASSERT(mode != DriveMode::kWithBall || (situation.playing && situation.possession));
  }
}

TEST(DriveArbiter, ObeysOneOfTheTwoInItsTimeOrStandsStillWhateverComes) {
  EXPECT_TRUE(rc::check("commands, ages, balls and whistles in any order", [] {
    const auto mode = *rc::gen::element(DriveMode::kAlways, DriveMode::kWithBall, DriveMode::kAdvice);
    DriveArbiter arbiter{mode, timeouts(0.2, 0.3)};
    std::vector<Said> said;
    std::int64_t now_ns = kNow_ns;
    const auto steps = *rc::gen::inRange(1, 60);
    for (int step = 0; step < steps; ++step) {
      now_ns += *rc::gen::inRange<std::int64_t>(0, 150'000'000);
      const auto source = *rc::gen::element(msg::DRIVE_NOBODY, msg::DRIVE_KICK_DECISION, msg::DRIVE_TEAM);
      if (source != msg::DRIVE_NOBODY) {
        const Said word{source, now_ns - *rc::gen::inRange<std::int64_t>(-350'000'000, 350'000'000), step + 1.0};
        const bool taken = arbiter.receive(source, word.t_ns, {word.vx_mps, 0.0, 0.0}, now_ns);
        if (taken) said.push_back(word);
      }
      const DriveSituation situation{*rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>()};
      const ObeyedDrive obeyed = arbiter.decide(now_ns, situation);
      check_obeyed(mode, situation, obeyed, said, now_ns);
      if (!arbiter.situation_matters(now_ns)) RC_ASSERT(arbiter.decide(now_ns, {}).source == obeyed.source);
    }
  }));
}

}  // namespace
}  // namespace trivela::robot
