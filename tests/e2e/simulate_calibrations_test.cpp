// Experiments whose robots are calibrated on several simulated calibrations, and settings that are tuned on such.
#include <gmock/gmock.h>

#include <fstream>
#include <set>

#include "config/settings.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/simulate_runs.hpp"

namespace trivela::e2e {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> calibrations(const std::string& out, int matches, std::vector<std::string> more = {},
                                      int calibrations = 3) {
  std::vector<std::string> arguments{"simulate",
                                     "--arms",
                                     "stopped,moving",
                                     "--matches",
                                     fmt::format("{}", matches),
                                     "--possessions",
                                     "20",
                                     "--out",
                                     out,
                                     "--calibrations",
                                     fmt::format("{}", calibrations)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

const std::string kRows =
    "SELECT match_id, arm, calibration_id, config_sha256, seed FROM sessions ORDER BY match_id, arm";

TEST(SimulateCalibrations, EveryMatchHasItsCalibrationInEveryArm) {
  const tests::Folder folder;
  Program program{"trivela", calibrations("one.db", 7), folder.path()};
  ASSERT_EQ(program.wait(), 0) << program.errors();
  EXPECT_THAT(program.output(), HasSubstr("3 calibrations, match m has calibration m mod 3"));
  const Reader log{folder / "one.db"};
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM sessions WHERE calibration_id = match_id % 3"), 14);
  EXPECT_EQ(number_of(log, "SELECT count(DISTINCT config_sha256) FROM sessions"), 6) << "a calibration and arm each";
  std::set<std::string> robots;
  for (const Row& row : rows_of(log, "SELECT text FROM texts WHERE text LIKE '%### robot%'")) {
    const std::string text = std::get<std::string>(row[0]);
    const auto from = text.find("### robot");
    robots.insert(text.substr(from, text.find("### scenario") - from));
  }
  EXPECT_EQ(robots.size(), 3U) << "the same calibration for both arms, and none like another";
  run(folder, calibrations("two.db", 7, {"--jobs", "2"}));
  EXPECT_EQ(rows_of(log, kRows), rows_of(Reader{folder / "two.db"}, kRows));
  Program report{"trivela", {"report", "one.db"}, folder.path()};
  EXPECT_EQ(report.wait(), 0) << report.errors();
}

TEST(SimulateCalibrations, AStoppedRunGoesOnWithTheSameCalibrations) {
  const tests::Folder folder;
  constexpr int kMatches = 1500;
  {
    Program program{"trivela", calibrations("ab.db", kMatches), folder.path()};
    ASSERT_TRUE(wait_for_change(folder.path(), program.watch(), [&] {
      std::error_code missing;
      const auto size = std::filesystem::file_size(folder / "ab.db-wal", missing);
      return !missing && size > 300'000 &&
             number_of(Reader{folder / "ab.db"}, "SELECT matches_done FROM experiments") > 0;
    }));
    program.signal(SIGINT);
    EXPECT_EQ(program.wait(), 1);
  }
  EXPECT_LT(number_of(Reader{folder / "ab.db"}, "SELECT matches_done FROM experiments"), kMatches);
  run(folder, calibrations("ab.db", kMatches));
  const Reader log{folder / "ab.db"};
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM sessions WHERE calibration_id = match_id % 3"), 2 * kMatches);
  EXPECT_EQ(number_of(log, "SELECT count(DISTINCT config_sha256) FROM sessions"), 6);
}

TEST(SimulateCalibrations, RefusesWhatMakesNoSense) {
  const tests::Folder folder;
  const auto refusal = [&](const std::vector<std::string>& arguments, int code) {
    Program program{"trivela", arguments, folder.path()};
    EXPECT_EQ(program.wait(), code) << program.errors();
    return program.errors();
  };
  EXPECT_THAT(refusal(calibrations("no.db", 2), 2), HasSubstr("--calibrations 3: more calibrations than --matches 2"));
  EXPECT_THAT(refusal(calibrations("no.db", 3, {"--robot", kRobot}), 2), HasSubstr("--robot and --calibrations"));
  EXPECT_THAT(folder.files(".db"), IsEmpty());
  run(folder, calibrations("ab.db", 3));
  EXPECT_THAT(refusal(calibrations("ab.db", 3, {}, 2), 2), HasSubstr("other arguments"));
}

std::vector<std::string> tune(const std::string& policy, const std::string& out, std::vector<std::string> more = {},
                              const std::string& matches = "12") {
  std::vector<std::string> arguments{"study", "tune",           policy, "--matches", matches, "--possessions",
                                     "10",    "--calibrations", "0",    "--robot",   kRobot,  "--out",
                                     out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Tune, WritesSettingsThatOtherVerbsTakeAndSaysNothingInAPipe) {
  const tests::Folder folder;
  for (const std::string policy : {"stopped", "moving", "predictive"}) {
    const std::string out = policy + ".toml";
    Program program{
        "trivela",
        tune(policy, out,
             {"--setting", "policy.dribble_mps=0.0|2.0", "--setting", "policy.height_law", "--rounds", "1"}),
        folder.path()};
    if (policy == "predictive") {
      EXPECT_EQ(program.wait(), 2) << "it has no height law";
      EXPECT_THAT(program.errors(), HasSubstr("write its values, too"));
      continue;
    }
    ASSERT_EQ(program.wait(), 0) << program.errors();
    EXPECT_THAT(program.errors(), IsEmpty());
    EXPECT_THAT(program.output(), HasSubstr("held out, 12 matches of 10, the robot files, seed 1002"));
    EXPECT_THAT(text_of(folder / out), HasSubstr("dribble_mps = "));
    run(folder, {"simulate", "--arms", policy, "--matches", "2", "--possessions", "5", "--robot", kRobot, "--config",
                 out, "--out", policy + ".db"});
  }
  run(folder, tune("predictive", "predictive.toml", {"--setting", "policy.predictive.threshold"}));
  const std::string world = TRIVELA_SOURCE_DIR "/config/scenarios/like_2016.toml";
  run(folder, tune("moving", "like.toml", {"--setting", "policy.dribble_mps=0.0|2.0", "--scenario", world}));
  EXPECT_THAT(text_of(folder / "like.toml"), HasSubstr(" --scenario " + world));
  EXPECT_TRUE(std::filesystem::equivalent(config::load_settings(folder / "like.toml").run.scenario, world));
  Program nowhere{"trivela", tune("moving", "nowhere/moving.toml"), folder.path()};
  EXPECT_EQ(nowhere.wait(), 1);
  EXPECT_THAT(nowhere.errors(), HasSubstr("cannot write --out nowhere/moving.toml"));
}

TEST(Tune, KeepsTheBestSoFarWhenItIsInterrupted) {
  const tests::Folder folder;
  Program program{"trivela", tune("moving", "best.toml", {"--jobs", "2"}, "3000"), folder.path()};
  // Each time that matches are played there is a new thread beside the first; the third belongs to the search.
  std::set<std::string> threads;
  const std::string own = fmt::format("/proc/{}/task", program.id());
  while (threads.size() < 4 && !program.watch().ended(std::chrono::milliseconds{5})) {
    std::error_code gone;
    for (const auto& entry : std::filesystem::directory_iterator{own, gone}) threads.insert(entry.path().filename());
  }
  program.signal(SIGINT);
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.errors(), HasSubstr("interrupted; best.toml has the best so far"));
  EXPECT_THAT(text_of(folder / "best.toml"), HasSubstr("# interrupted: the best so far\n"));
  run(folder, {"simulate", "--arms", "moving", "--matches", "2", "--possessions", "5", "--robot", kRobot, "--config",
               "best.toml", "--out", "best.db"});
}

TEST(Arms, MayHaveSettingsOfAFileOfTheirOwn) {
  const tests::Folder folder;
  std::ofstream{folder / "own.toml"} << "[policy]\nsettle_s = 0.5\n";
  std::ofstream{folder / "arms.toml"} << "[[arm]]\nname = \"a\"\npolicy = \"stopped\"\nconfig = \"own.toml\"\n"
                                         "[[arm]]\nname = \"b\"\npolicy = \"stopped\"\n";
  const std::vector<std::string> command{"simulate", "--arms",  "arms.toml", "--matches", "1",    "--possessions",
                                         "3",        "--robot", kRobot,      "--out",     "ab.db"};
  run(folder, command);
  const Reader log{folder / "ab.db"};
  EXPECT_EQ(number_of(log,
                      "SELECT count(*) FROM sessions JOIN texts ON sha256 = config_sha256 WHERE arm = 'a' AND text "
                      "LIKE '%settle_s = 0.5%'"),
            1);
  EXPECT_EQ(number_of(log,
                      "SELECT count(*) FROM sessions JOIN texts ON sha256 = config_sha256 WHERE arm = 'b' AND text "
                      "LIKE '%settle_s = 0.5%'"),
            0);
  std::ofstream{folder / "own.toml"} << "[policy]\nsettle = 0.5\n";
  Program refused{"trivela", command, folder.path()};
  EXPECT_EQ(refused.wait(), 1);
  EXPECT_THAT(refused.errors(), HasSubstr("own.toml:2: policy.settle: unknown key"));
}

}  // namespace
}  // namespace trivela::e2e
