// `trivela calibrate run --in field` by somebody at a pseudo-terminal: rehearsed in the simulator, and a drive in real
// time by the nodes of a robot, whose bridge, vision, cameras and scanner are the simulator.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <memory>
#include <random>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/e2e/typed_terminal.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using testing::HasSubstr;
using testing::Not;

class CalibrateInField : public testing::Test {
 protected:
  std::unique_ptr<Program> start(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"calibrate", "run",    "--in",    "field", "--rehearse", "--robot", "newcomer",
                                       "--out-dir", "drives", "--kicks", "2",     "--lobs",     "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<Program>("trivela", arguments, folder_.path(), [this] { person_.become_input(); });
  }

  /// Waits for the question, of the drive that is named before it, then types the answer.
  void answer(const Program& run, const std::string& question, const std::string& text,
              const std::string& drive = {}) const {
    ASSERT_TRUE(wait_for_change(
        folder_.path(), run.watch(),
        [&] { return run.output().ends_with(question) && run.output().find(drive) != std::string::npos; }))
        << run.output() << run.errors();
    person_.type(text + "\n");
  }

  bool exists(const std::string& record) const { return std::filesystem::exists(folder_.path() / "drives" / record); }

  tests::Folder folder_;
  TypedTerminal person_;
};

TEST_F(CalibrateInField, ASecondStartGoesOnWhereTheFirstOneEnded) {
  const auto first = start();
  answer(*first, "[12.000]: ", "far");
  answer(*first, "'far' is no length from 2.0 to 12.0 m.\nStanding kicks: ball to goal line, m [12.000]: ", "");
  answer(*first, "behind it), m [4.000]: ", "4.0");
  answer(*first, "floor, m [0.050]: ", "");
  answer(*first, "leave for today: ", "go", "1_standing\n");
  answer(*first, "'go' begins nothing.\nEnter: begin; q: leave for today: ", "");
  answer(*first, "leave for today: ", " quit ", "1_standing_2\n");
  EXPECT_EQ(first->wait(), 1);
  EXPECT_THAT(first->output(), HasSubstr("A REHEARSAL"));
  EXPECT_THAT(first->output(), HasSubstr("left for today"));
  EXPECT_TRUE(exists("1_standing.db"));

  const auto second = start();
  answer(*second, "Enter: begin; q: leave for today: ", "");
  EXPECT_THAT(second->output(), HasSubstr("floor, m: 0.050 (measured before)"));
  EXPECT_THAT(second->output(), HasSubstr("1_standing: played before, from its records"));
  EXPECT_TRUE(wait_for_change(folder_.path() / "drives", second->watch(), [&] { return exists("1_standing_2.db"); }));
  second->signal(SIGINT);
  EXPECT_EQ(second->wait(), 1);

  const auto third = start();
  answer(*third, "Enter: begin; q: leave for today: ", "q");
  EXPECT_EQ(third->wait(), 1);
  EXPECT_THAT(third->output(), HasSubstr("1_standing_2: what was recorded of an earlier start is kept"));
  EXPECT_TRUE(exists("1_standing_2.partial-1.scenario.toml"));
  EXPECT_FALSE(exists("newcomer.toml"));
}

// Two set-points, two kicks each. The command is the referee, whom the simulated world does not hear: it has stops of
// its own, in which a coil's pulse moves no ball.
TEST_F(CalibrateInField, ADriveIsPlayedByTheNodesOfTheRobotOverItsBridge) {
  std::random_device random;
  std::ofstream{folder_ / "robot.toml"} << fmt::format(
      "[run]\nlockstep = false\nscenario = \"{}/config/scenarios/calibration.toml\"\n\n[domain]\ndomain_id = {}\n"
      "tag = \"calibration-{}-{:08x}\"\n\n[simulator]\nreferee = false\n\n[policy.test_drive]\npowers = [25.0, 35.0]\n",
      TRIVELA_SOURCE_DIR, 1 + random() % 100, getpid(), random());
  Program bridge{"trivela-simulator", {"--config", "robot.toml"}, folder_.path()};
  Program calibration{"trivela",
                      {"calibrate", "run", "--in", "field", "--config", "robot.toml", "--robot", "newcomer",
                       "--out-dir", "drives", "--kicks", "2", "--lobs", "2"},
                      folder_.path(),
                      [this] { person_.become_input(); }};
  answer(calibration, "Standing kicks: ball to goal line, m [6.000]: ", "12");
  answer(calibration, "m [4.000]: ", "");
  answer(calibration, "m [0.050]: ", "");
  answer(calibration, "leave for today: ", "", "1_standing\n");
  answer(calibration, "leave for today: ", "q", "1_standing_2\n");
  EXPECT_EQ(calibration.wait(), 1);
  EXPECT_THAT(calibration.output(), HasSubstr("kick 4 of 4, set-point 35.00"));
  EXPECT_THAT(calibration.output(), Not(HasSubstr("A REHEARSAL")));
  bridge.signal(SIGTERM);
  EXPECT_EQ(bridge.wait(), 0) << bridge.errors();
  EXPECT_TRUE(exists("1_standing.scans.db")) << "the scanner's record";
  const Reader log{folder_ / "drives" / "1_standing.db"};
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM kick_receipts WHERE accepted"), 4);
  EXPECT_EQ(number_of(log, "SELECT count(DISTINCT power) FROM kick_receipts WHERE accepted"), 2);
  EXPECT_GE(number_of(log, "SELECT count(*) FROM kick_truths"), 1) << "which the world let fly";
}

TEST_F(CalibrateInField, ADriveThatNobodyMeasuresDoesNotBeginAndSaysWhatLacks) {
  std::random_device random;
  std::ofstream{folder_ / "robot.toml"} << fmt::format("[domain]\ndomain_id = {}\ntag = \"alone-{}-{:08x}\"\n",
                                                       1 + random() % 100, getpid(), random());
  Program calibration{"trivela",
                      {"calibrate", "run", "--in", "field", "--config", "robot.toml", "--robot", "newcomer",
                       "--out-dir", "drives", "--kicks", "2", "--lobs", "2"},
                      folder_.path(),
                      [this] { person_.become_input(); }};
  answer(calibration, "Standing kicks: ball to goal line, m [6.000]: ", "");
  answer(calibration, "m [4.000]: ", "");
  answer(calibration, "m [0.050]: ", "");
  answer(calibration, "leave for today: ", "", "1_standing\n");
  EXPECT_EQ(calibration.wait(), 1);
  EXPECT_THAT(calibration.errors(),
              testing::AllOf(HasSubstr("1_standing cannot be played: nobody writes vision: start your vision"),
                             HasSubstr("nobody writes flight_camera"), HasSubstr("nobody writes device/wheels"),
                             HasSubstr("nobody writes device/kicker"), HasSubstr("set scan_recorder.device")));
  EXPECT_FALSE(exists("1_standing.db"));
}

TEST_F(CalibrateInField, ARobotsFileThatIsNotThereIsNamedBeforeTheFirstQuestion) {
  const auto run = start({"--start", "nope.toml"});
  EXPECT_EQ(run->wait(), 1);
  EXPECT_THAT(run->errors(), HasSubstr("nope.toml: cannot read the configuration"));
  EXPECT_EQ(run->output(), "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "drives"));
}

TEST_F(CalibrateInField, WhatMakesNoSenseIsRefusedBeforeAnybodyIsAsked) {
  for (const auto& [flag, says] : std::vector<std::pair<std::string, std::string>>{
           {"--json", "--json goes with --in simulation"}, {"--in-process", "a field has its nodes"}}) {
    const auto run = start({flag});
    EXPECT_EQ(run->wait(), 2);
    EXPECT_THAT(run->errors(), HasSubstr(says));
    EXPECT_THAT(run->output(), Not(HasSubstr("[")));
  }
  Program alone{"trivela", {"calibrate", "run", "--in", "field"}, folder_.path(), [] { ::close(STDIN_FILENO); }};
  EXPECT_EQ(alone.wait(), 1);
  EXPECT_THAT(alone.errors(), HasSubstr("standard input is no terminal"));
}

}  // namespace
}  // namespace trivela::e2e
