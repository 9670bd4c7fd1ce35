// Matches of some possessions, each in a mode that no other one plays.
#include <gmock/gmock.h>

#include <fstream>

#include "config/scenario/scenario.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using testing::IsEmpty;

class ShortMatch : public testing::Test {
 protected:
  /// Four possessions in lockstep; what it recorded.
  Reader play(const std::vector<std::string>& settings) {
    std::vector<std::string> words{"match",
                                   "--half",
                                   "moving",
                                   "--minutes",
                                   "2",
                                   "--seed",
                                   "1",
                                   "--out",
                                   "match.db",
                                   "--set",
                                   "simulator.max_possessions=4"};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    Program match{"trivela", words, folder_.path()};
    EXPECT_EQ(match.wait(), 0) << match.errors();
    EXPECT_THAT(loose_ends_of(folder_ / "match.db"), IsEmpty());
    return Reader{folder_ / "match.db"};
  }

  tests::Folder folder_;
};

// Nobody writes team_drive: whatever moves the base while the ball is in the handler is kick_decision.
TEST_F(ShortMatch, WithBallTheDecisionDrivesAndKicksAndElseTheTeamWouldDrive) {
  const Reader log = play({"kick_decision.drive=\"with_ball\""});
  EXPECT_GE(number_of(log, "SELECT count(*) FROM kick_receipts WHERE accepted"), 1);
  EXPECT_GE(number_of(log, "SELECT count(*) FROM odometry WHERE obeyed = 'kick_decision'"), 1);
  EXPECT_GE(number_of(log, "SELECT count(*) FROM odometry WHERE obeyed = 'nobody'"), 1);
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM odometry WHERE obeyed = 'team_drive'"), 0);
  EXPECT_EQ(number_of(log,
                      "SELECT count(*) FROM odometry AS o JOIN world_states AS w USING (robot_id, t_ns) JOIN "
                      "world_states AS b ON b.robot_id = w.robot_id AND b.seq = w.seq - 1 WHERE o.obeyed = "
                      "'kick_decision' AND NOT (w.playing AND w.possession) AND NOT (b.playing AND b.possession)"),
            0);
}

TEST_F(ShortMatch, WithoutMinutesAHalfIsAsLongAsTheScenarioHasIt) {
  sim::Scenario world;
  world.referee.half_minutes = 0.05;
  std::ofstream{folder_ / "short.toml"} << config::to_toml_text(world);
  Program match{
      "trivela",
      {"match", "--half", "moving", "--half", "stopped", "--out", "match.db", "--set", "run.scenario=\"short.toml\""},
      folder_.path()};
  EXPECT_EQ(match.wait(), 0) << match.errors();
  const Reader log{folder_ / "match.db"};
  EXPECT_EQ(number_of(log, "SELECT CAST(round(planned_s) AS INTEGER) FROM sessions"), 6) << "two halves of 3 s";
}

// The robot gets the ball behind the middle line, 11 m from the goal, and carries it ahead.
TEST_F(ShortMatch, OnTheFieldOf2026NothingIsKickedFromTheOwnHalf) {
  sim::Scenario world =
      config::load_scenario(std::filesystem::path{TRIVELA_SOURCE_DIR} / "config/scenarios/msl_2026.toml");
  world.possession.goal_distance_min_m = 11.4;
  world.possession.goal_distance_max_m = 12.0;
  world.opponent.distance_median_m = 30.0;
  world.opponent.distance_sigma_ln = 0.0;
  world.referee.stops_per_min = 0.0;
  std::ofstream{folder_ / "own_half.toml"} << config::to_toml_text(world);
  const Reader log = play({"run.scenario=\"own_half.toml\""});
  EXPECT_GE(number_of(log, "SELECT count(DISTINCT possession_id) FROM kick_decisions WHERE reason = 'own_half'"), 4);
  EXPECT_GE(number_of(log, "SELECT count(*) FROM kick_receipts WHERE accepted"), 1) << "beyond it the rule ends";
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM kick_truths WHERE release_y_m <= 0"), 0);
}

}  // namespace
}  // namespace trivela::e2e
