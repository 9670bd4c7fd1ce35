// An experiment in process: the same rows however it is run, and the same decisions as the nodes on the bus.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/simulate_runs.hpp"

namespace trivela::e2e {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(Simulate, TheRowsDoNotDependOnTheNumberOfJobs) {
  const tests::Folder folder;
  run(folder, simulate("one.db", 5));
  run(folder, simulate("two.db", 5, {"--jobs", "2"}));
  const Reader log{folder / "one.db"};
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM sessions"), 10);
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM possession_truths"), 200);
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM assignments"), 200);
  EXPECT_GT(number_of(log, "SELECT count(*) FROM kicks WHERE outcome IS NOT NULL AND truth_outcome IS NOT NULL"), 20);
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM texts"), 3) << "two configurations and the messages";
  EXPECT_THAT(other_rows(folder, "one.db", "two.db"), IsEmpty());
  EXPECT_THAT(loose_ends_of(folder / "two.db"), IsEmpty());
}

TEST(Simulate, SaysBelowTheTableWhereTheLabelsAreWrong) {
  const tests::Folder folder;
  // Seen later than the observer allows for.
  Program late{"trivela", simulate("late.db", 10, {"--world", "flight_camera.latency_s=0.5"}), folder.path()};
  ASSERT_EQ(late.wait(), 0) << late.errors();
  EXPECT_THAT(late.output(), HasSubstr("stopped: many labels are wrong or unknown: "));
  Program right{"trivela", simulate("right.db", 10), folder.path()};
  ASSERT_EQ(right.wait(), 0) << right.errors();
  EXPECT_THAT(right.output(), Not(HasSubstr("labels are wrong or unknown")));
}

TEST(Simulate, TheReportOfALateKickerHasRightLabelsAndSaysThatItIsLate) {
  const tests::Folder folder;
  Program late{"trivela", simulate("late.db", 10, {"--world", "kicker.delay_s=0.2"}), folder.path()};
  ASSERT_EQ(late.wait(), 0) << late.errors();
  EXPECT_THAT(late.output(), Not(HasSubstr("labels are wrong or unknown")));
  Program report{"trivela", {"report", "late.db"}, folder.path()};
  ASSERT_EQ(report.wait(), 0) << report.errors();
  EXPECT_THAT(report.output(), HasSubstr("robot 1: the ball leaves 0.14 s later than its file says (median of "));
}

// The starts are the same situations; what the arms did with them is not.
TEST(Simulate, EveryArmMeetsTheSameOpportunities) {
  const tests::Folder folder;
  run(folder, simulate("ab.db", 3));
  const Reader log{folder / "ab.db"};
  const std::string starts =
      "SELECT match_id, possession_id, start_x_m, start_y_m, start_heading_rad FROM possession_truths "
      "JOIN sessions USING (session_id) WHERE arm = '{}' ORDER BY match_id, possession_id";
  const auto stopped = rows_of(log, fmt::format(fmt::runtime(starts), "stopped"));
  EXPECT_EQ(stopped.size(), 60u);
  EXPECT_EQ(stopped, rows_of(log, fmt::format(fmt::runtime(starts), "moving@old")));
  EXPECT_NE(number_of(log, "SELECT count(*) FROM kicks WHERE policy = 'stopped'"),
            number_of(log, "SELECT count(*) FROM kicks WHERE policy = 'moving'"));
}

TEST(Simulate, AStoppedRunGoesOnToTheSameFile) {
  const tests::Folder folder;
  constexpr int kMatches = 1000;  // some seconds, of which a commit holds tenths
  run(folder, simulate("whole.db", kMatches, {"--jobs", "2"}));
  for (const int signal : {SIGINT, SIGKILL}) {
    const std::string out = signal == SIGINT ? "interrupted.db" : "killed.db";
    {
      Program program{"trivela", simulate(out, kMatches), folder.path()};
      const auto wal = folder / (out + "-wal");
      ASSERT_TRUE(wait_for_change(folder.path(), program.watch(), [&] {
        std::error_code missing;
        const auto size = std::filesystem::file_size(wal, missing);
        return !missing && size > 300'000 &&
               number_of(Reader{folder / out}, "SELECT matches_done FROM experiments") > 0;
      }));
      program.signal(signal);
      EXPECT_NE(program.wait(), 0);
      if (signal == SIGINT) {
        EXPECT_THAT(program.errors(), HasSubstr("the same command goes on from there"));
      }
    }
    {
      const Reader part{folder / out};
      EXPECT_LT(number_of(part, "SELECT matches_done FROM experiments"), kMatches);
      EXPECT_GT(number_of(part, "SELECT matches_done FROM experiments"), 0);
      EXPECT_EQ(number_of(part, "SELECT count(*) FROM sessions"),
                2 * number_of(part, "SELECT matches_done FROM experiments"));
    }
    run(folder, simulate(out, kMatches));
    EXPECT_THAT(other_rows(folder, "whole.db", out), IsEmpty()) << out;
  }
}

TEST(Simulate, RefusesToGoOnWithOtherArguments) {
  const tests::Folder folder;
  run(folder, simulate("ab.db", 2));
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--seed", "2"}, std::vector<std::string>{"--set", "policy.settle_s=0.5"}}) {
    Program other{"trivela", simulate("ab.db", 2, more), folder.path()};
    EXPECT_EQ(other.wait(), 2);
    EXPECT_THAT(other.errors(), HasSubstr("other arguments"));
  }
  Program longer{"trivela", simulate("ab.db", 3), folder.path()};
  EXPECT_EQ(longer.wait(), 2);
  std::ofstream(folder / "mine.db") << "my own";
  Program foreign{"trivela", simulate("mine.db", 2), folder.path()};
  EXPECT_EQ(foreign.wait(), 2) << "as any verb whose output is there already";
  EXPECT_EQ(std::filesystem::file_size(folder / "mine.db"), 6u);
  Program device{"trivela", simulate("/dev/full", 2), folder.path()};
  EXPECT_EQ(device.wait(), 2);
  EXPECT_THAT(device.errors(), HasSubstr("/dev/full: is no file"));
  run(folder, simulate("ab.db", 2));  // there is nothing left to play
}

TEST(Simulate, OfTwoThatStartAtOnceTheSecondSaysWhy) {
  const tests::Folder folder;
  for (int round = 0; round < 8; ++round) {
    const std::string out = fmt::format("both_{}.db", round);
    Program one{"trivela", simulate(out, 30), folder.path()};
    Program other{"trivela", simulate(out, 30), folder.path()};
    const int first = one.wait(), second = other.wait();
    EXPECT_TRUE(first == 0 || second == 0) << one.errors() << other.errors();
    if (first != 0) {
      EXPECT_THAT(one.errors(), HasSubstr("another run writes to it"));
    }
    if (second != 0) {
      EXPECT_THAT(other.errors(), HasSubstr("another run writes to it"));
    }
    EXPECT_EQ(number_of(Reader{folder / out}, "SELECT count(*) FROM sessions"), 60);
  }
}

TEST(Simulate, AReportReadsTheExperiment) {
  const tests::Folder folder;
  run(folder, simulate("ab.db", 3));
  Program report{"trivela", {"report", "ab.db"}, folder.path()};
  EXPECT_EQ(report.wait(), 0) << report.errors();
  EXPECT_THAT(report.output(), HasSubstr("stopped"));
  EXPECT_THAT(report.output(), HasSubstr("moving"));
}

TEST(Simulate, DecidesLikeTheNodesOnTheBus) {
  for (const std::string policy : {"stopped", "moving", "predictive"}) {
    const tests::Folder folder;
    run(folder, {"simulate", "--arms", policy, "--matches", "1", "--possessions", "8", "--robot", kRobot, "--shadows",
                 "--every-cycle", "--out", "in.db"});
    EXPECT_THAT(differing_on_the_bus(folder, {"--half", policy}), IsEmpty()) << policy;
  }
}

TEST(Simulate, MovesALeverAndKicksFlatLikeTheNodesOnTheBus) {
  const tests::Folder folder;
  const std::string config = TRIVELA_SOURCE_DIR "/config/";
  const std::string robot = config + "robots/lob_flat_1.toml", world = config + "scenarios/flat_keeper.toml";
  run(folder, {"simulate", "--arms", "predictive", "--matches", "1", "--possessions", "8", "--robot", robot,
               "--scenario", world, "--shadows", "--every-cycle", "--out", "in.db"});
  const Reader log{folder / "in.db"};
  EXPECT_GE(number_of(log, "SELECT count(*) FROM kicks WHERE kick_kind = 1"), 2);
  const std::string inside = "SELECT count(*) FROM kicks WHERE outcome = 'on_target' AND truth_outcome = 'on_target' ";
  EXPECT_GE(number_of(log, inside), 3);
  EXPECT_EQ(number_of(log, inside + "AND (observed_p_saved > 0.5) <> truth_saved"), 0) << "the truth is the witness";
  EXPECT_THAT(differing_on_the_bus(folder, {"--half", "predictive", "--set", fmt::format("run.robot='{}'", robot),
                                            "--set", fmt::format("run.scenario='{}'", world)}),
              IsEmpty());
  run(folder, {"replay", "bus.db", "--out", "again.db"});
  EXPECT_EQ(number_of(Reader{folder / "again.db"}, "SELECT count(*) FROM kick_orders WHERE kick_kind = 1"),
            number_of(Reader{folder / "bus.db"}, "SELECT count(*) FROM kick_orders WHERE kick_kind = 1"));
}

TEST(Simulate, LearnsThatAKeeperJumpsEarlyAndAimsAtTheMiddleLikeTheNodesOnTheBus) {
  const tests::Folder folder;
  std::ofstream{folder / "jumps.toml"} << "[keeper]\nenabled = true\nguess_m = 0.6\n";
  const std::string believes = "policy.keeper.guess_prior=0.4";
  run(folder, {"simulate", "--arms", "predictive", "--matches", "1", "--possessions", "8", "--robot", kRobot,
               "--scenario", "jumps.toml", "--shadows", "--every-cycle", "--set", believes, "--out", "in.db"});
  const Reader log{folder / "in.db"};
  const std::string aimed = "SELECT count(*) FROM kick_decisions WHERE fire = 1 AND target_x_m ";
  EXPECT_GE(number_of(log, aimed + "<> 0"), 1) << "before its first kick nobody knows";
  EXPECT_GE(number_of(log, aimed + "= 0"), 1);
  EXPECT_THAT(differing_on_the_bus(folder, {"--half", "predictive", "--set", believes, "--set",
                                            fmt::format("run.scenario='{}'", (folder / "jumps.toml").string()), "--set",
                                            fmt::format("run.robot='{}'", kRobot)}),
              IsEmpty());
}

TEST(Simulate, LearnsAKickerAndDecidesByItLikeTheNodesOnTheBus) {
  const tests::Folder folder;
  const std::string on = "self_calibration.mode='on'";
  run(folder, {"simulate", "--arms", "predictive", "--matches", "1", "--possessions", "8", "--robot", kRobot,
               "--shadows", "--every-cycle", "--set", on, "--out", "in.db"});
  const Reader log{folder / "in.db"};
  EXPECT_GE(number_of(log, "SELECT max(kicks) FROM kicker_estimates"), 3);
  EXPECT_GE(number_of(log, "SELECT count(DISTINCT estimate) FROM kick_decisions WHERE estimate > 0"), 3);
  EXPECT_THAT(differing_on_the_bus(folder, {"--half", "predictive", "--set", on}), IsEmpty());
}

TEST(Simulate, TheEstimateStandsAtAJumpWhenTheDriftWatchFindsIt) {
  const tests::Folder folder;
  run(folder, {"simulate", "--arms", "predictive", "--matches", "1", "--possessions", "200", "--seed", "7", "--world",
               "kicker.drop_ratio=0.05", "--world", "kicker.drop_after_kicks=60", "--out", "worn.db"});
  Program watch{"trivela", {"drift", "worn.db", "--json"}, folder.path()};
  ASSERT_EQ(watch.wait(), 3) << watch.errors();
  const nlohmann::json drift = nlohmann::json::parse(watch.output()).at("robots").at(0).at("drifts").at(0);
  const Reader log{folder / "worn.db"};
  // What was learned up to the kick with this number, from 1.
  const auto learned_with = [&](int kick) {
    return real_of(log, fmt::format("SELECT speed_ln FROM kicker_estimates WHERE kick_id <= (SELECT kick_id FROM kicks "
                                    "WHERE accepted = 1 ORDER BY t_ns LIMIT 1 OFFSET {}) ORDER BY seq DESC LIMIT 1",
                                    kick - 1));
  };
  const double before = learned_with(drift.at("kick").get<int>() - 1);
  const double found = learned_with(drift.at("found_with_kick").get<int>());
  EXPECT_NEAR(found - before, std::log(0.95), 0.026) << before << " before, " << found << " when it was certain";
}

TEST(Simulate, ARobotsFileComesFromItsMatches) {
  const tests::Folder folder;
  run(folder, {"simulate", "--arms", "predictive", "--matches", "3", "--possessions", "25", "--robot", kRobot,
               "--world", "kicker.speed_scale_ratio=1.1", "--out", "fast.db"});
  run(folder, {"calibrate", "from-log", "fast.db", "--robot", "fast", "--base", kRobot, "--out", "fast.toml"});
  const auto figure = [](const std::filesystem::path& file, const std::string& key) {
    std::ifstream in{file};
    for (std::string line; std::getline(in, line);)
      if (line.starts_with(key + " = ")) return line.substr(key.size() + 3);
    return std::string{"none"};
  };
  const double before = std::stod(figure(kRobot, "exit_speeds_mps").substr(1));
  const double after = std::stod(figure(folder / "fast.toml", "exit_speeds_mps").substr(1));
  EXPECT_NEAR(after / before, 1.1, 0.04);
  EXPECT_NE(figure(folder / "fast.toml", "speed_se_ratio"), "none");
  Program other{"trivela",
                {"calibrate", "from-log", "fast.db", "--robot", "other", "--robot-id", "7", "--out", "other.toml"},
                folder.path()};
  EXPECT_EQ(other.wait(), 1);
  EXPECT_THAT(other.errors(), HasSubstr("robot 7 has 0 kicks in 1 log(s), of which 0 were seen to fly, 5 are needed; "
                                        "kicks of robot(s): 1. Nothing is written"));
  EXPECT_FALSE(std::filesystem::exists(folder / "other.toml"));
}

TEST(Simulate, ReadsAHeightTableByTheSettingsLikeTheNodesOnTheBus) {
  const tests::Folder folder;
  std::ofstream{folder / "hand.toml"} << "[height_table]\ndistances_m = [3.0, 4.0, 5.0, 6.0, 7.0, 8.0]\n"
                                         "powers = [17.0, 19.0, 22.0, 25.0, 29.0, 33.0]\n";
  const std::vector<std::string> settings{"--set", "policy.height_law='paper'", "--set", "policy.motion_law='paper'",
                                          "--set", "policy.target_height_m=0.5"};
  std::vector<std::string> in_process{"simulate",      "--arms", "stopped", "--matches", "1",
                                      "--possessions", "8",      "--robot", "hand.toml", "--shadows",
                                      "--every-cycle", "--out",  "in.db"};
  in_process.insert(in_process.end(), settings.begin(), settings.end());
  run(folder, in_process);
  std::vector<std::string> on_the_bus{"--half", "stopped", "--set", "run.robot='hand.toml'"};
  on_the_bus.insert(on_the_bus.end(), settings.begin(), settings.end());
  EXPECT_THAT(differing_on_the_bus(folder, on_the_bus), IsEmpty());
  const Reader log{folder / "in.db"};
  // At rest the powers are those of the table, whatever law and height: ball-to-line distances from 3 to 8 m.
  EXPECT_EQ(number_of(log,
                      "SELECT count(*) FROM kick_decisions WHERE fire = 1 AND distance_m BETWEEN 3 AND 8 AND "
                      "power NOT BETWEEN 17 AND 33"),
            0);
}

TEST(Simulate, PlaysARobotsOwnPolicyLikeTheNodesOnTheBus) {
  const tests::Folder folder;
  const std::string own = "kick_decision.policy_by_robot=['stopped']";
  std::ofstream{folder / "arms.toml"} << fmt::format("[[arm]]\nname = \"own\"\nset = [\"{}\"]\n", own);
  run(folder, {"simulate", "--arms", "arms.toml", "--matches", "1", "--possessions", "8", "--robot", kRobot,
               "--shadows", "--every-cycle", "--out", "in.db"});
  EXPECT_EQ(number_of(Reader{folder / "in.db"}, "SELECT count(*) FROM assignments WHERE policy = 'stopped'"), 8);
  EXPECT_THAT(differing_on_the_bus(folder, {"--half", "moving", "--set", own}), IsEmpty());
}

TEST(Simulate, DrawsThePoliciesLikeTheNodesOnTheBus) {
  const tests::Folder folder;
  std::ofstream{folder / "arms.toml"} << fmt::format(
      "[[arm]]\nname = \"drawn\"\nrandom = [\"stopped\", \"moving\", \"predictive\"]\nrobots = [\"{}\"]\n", kRobot);
  run(folder, {"simulate", "--arms", "arms.toml", "--matches", "1", "--possessions", "8", "--shadows", "--every-cycle",
               "--out", "in.db"});
  const Reader log{folder / "in.db"};
  EXPECT_GE(number_of(log, "SELECT count(DISTINCT policy) FROM assignments"), 2);
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM assignments WHERE abs(probability - 1.0 / 3.0) < 1e-12"), 8);
  EXPECT_THAT(differing_on_the_bus(folder, {"--random", "stopped,moving,predictive"}), IsEmpty());
}

}  // namespace
}  // namespace trivela::e2e
