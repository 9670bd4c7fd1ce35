// From an uncalibrated robot to a finished robot file, through the real nodes.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "config/robot.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::chrono::minutes kWholeRun{15};  // on a machine that does other things beside

class CalibrateRun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<tests::Folder>();
    Program run{"trivela",
                {"calibrate", "run", "--in", "simulation", "--robot", "newcomer", "--out-dir", "drives", "--json"},
                folder_->path()};
    ASSERT_TRUE(run.watch().ended(kWholeRun));
    exit_code_ = run.wait();
    errors_ = run.errors();
    ASSERT_EQ(exit_code_, 0) << errors_;
    report_ = nlohmann::json::parse(run.output());
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::filesystem::path record(const std::string& name) { return *folder_ / "drives" / name; }

  /// Calibrated figure less the world's, of the report's part on the simulator's truth.
  static double difference(const std::string& key) {
    for (const auto& figure : report_["simulator_truth"]["figures"])
      if (figure["key"] == key) return figure["difference"];
    ADD_FAILURE() << "no figure " << key;
    return 0.0;
  }

  inline static std::unique_ptr<tests::Folder> folder_;
  inline static int exit_code_ = -1;
  inline static std::string errors_;
  inline static nlohmann::json report_;
};

TEST_F(CalibrateRun, PlaysEveryDriveAndLeavesItsRecords) {
  std::vector<std::string> drives;
  for (const auto& drive : report_["drives"]) {
    drives.push_back(drive["drive"]);
    EXPECT_GE(drive["used"], 8) << drive;
    for (const auto& log : drive["logs"]) EXPECT_THAT(loose_ends_of(log.get<std::string>()), IsEmpty());
    EXPECT_THAT(errors_, HasSubstr(drive["drive"].get<std::string>() + ": ")) << "a line a drive";
  }
  EXPECT_THAT(drives, ElementsAre("standing", "delay", "direction", "lateral", "turn", "straight"));
  for (const char* file : {"1_standing.scans.db", "1_standing.scenario.toml", "3_lateral.db", "4_turn.db",
                           "5_straight.db", "6_check.db", "newcomer.toml"})
    EXPECT_TRUE(std::filesystem::exists(record(file))) << file;
  EXPECT_THAT(folder_->files(".toml"), IsEmpty()) << "configurations of the nodes";
}

TEST_F(CalibrateRun, TheNodesRecordWhichDriveWasInCharge) {
  const Reader log{record("4_turn.db")};
  EXPECT_EQ(log.sessions().front().policies.front().policy, "turn_drive");
  EXPECT_GT(number_of(log, "SELECT count(*) FROM kick_decisions WHERE policy = 'turn_drive' AND fire = 1"), 50);
  EXPECT_THAT(gaps_of(log), IsEmpty());
}

// By what the robot saw, and by the match log itself.
TEST_F(CalibrateRun, ItsRobotHitsWhatItAimsAtFromThreeToEightMetres) {
  EXPECT_GE(report_["check"]["kicks"], 25);
  EXPECT_LE(report_["check"]["median_height_error_m"], 0.10);
  EXPECT_LE(report_["check"]["median_sideways_error_m"], 0.15);
  std::vector<double> height_m, sideways_m;
  double nearest_m = 100.0, farthest_m = 0.0;
  const Reader log{record("6_check.db")};
  for (const auto& kick : log.kicks()) {
    EXPECT_EQ(kick.policy, "stopped");
    ASSERT_TRUE(kick.truth && kick.truth->x_cross_m);
    height_m.push_back(std::abs(*kick.truth->z_cross_m - 0.7));
    sideways_m.push_back(std::abs(*kick.truth->x_cross_m));
  }
  log.query("SELECT min(distance_m), max(distance_m) FROM kick_decisions WHERE fire = 1",
            [&](std::span<const log::Value> row) {
              nearest_m = std::get<double>(row[0]);
              farthest_m = std::get<double>(row[1]);
            });
  EXPECT_LT(nearest_m, 3.8);
  EXPECT_GT(farthest_m, 6.9);
  const auto median = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  EXPECT_LE(median(height_m), 0.10);
  EXPECT_LE(median(sideways_m), 0.15);
}

TEST_F(CalibrateRun, FindsTheWorldsFiguresAndSaysHowFarItIsFromThem) {
  for (const int power : {15, 20, 25, 30, 35, 40, 45, 50})
    EXPECT_NEAR(difference(fmt::format("exit_speed_{}_mps", power)), 0.0, 0.3) << "three standard errors";
  EXPECT_NEAR(difference("exit_angle_deg"), 0.0, 0.3);
  EXPECT_NEAR(difference("delay_s"), 0.0, 0.006);
  EXPECT_NEAR(difference("alpha_slope_deg_per_mps"), 0.0, 1.0);
  EXPECT_NEAR(difference("beta_slope_s"), 0.0, 0.025);
  EXPECT_NEAR(difference("transfer_lateral_ratio"), 0.0, 0.2);
  EXPECT_NEAR(difference("transfer_forward_ratio"), 0.0, 0.5);
  EXPECT_NEAR(difference("transfer_backward_ratio"), 0.0, 0.5);
}

TEST_F(CalibrateRun, ItsFileIsARobotThatSaysWhereItsFiguresComeFrom) {
  const config::Robot robot = config::load_robot(record("newcomer.toml"));
  EXPECT_EQ(robot.name, "newcomer");
  EXPECT_EQ(robot.model.table.set_points().size(), 8u);
  ASSERT_TRUE(robot.calibration);
  EXPECT_TRUE(robot.calibration->table && robot.calibration->exit_angle && robot.calibration->deflection &&
              robot.calibration->rotation && robot.calibration->transfer && robot.calibration->delay);
  EXPECT_THAT(robot.calibration->rotation->files, ElementsAre("4_turn.db"));
  EXPECT_THAT(text_of(record("newcomer.toml")), HasSubstr("trivela calibrate run"));
}

TEST_F(CalibrateRun, InProcessItIsTheSameRobot) {
  Program alone{"trivela",
                {"calibrate", "run", "--in", "simulation", "--robot", "newcomer", "--out-dir", "alone", "--in-process"},
                folder_->path()};
  EXPECT_EQ(alone.wait(), 0) << alone.errors();
  EXPECT_EQ(text_of(*folder_ / "alone" / "newcomer.toml"), text_of(record("newcomer.toml")));
}

TEST_F(CalibrateRun, DoesNotOverwriteARobotOrARecord) {
  for (const std::string more : {"newcomer", "other"}) {
    Program again{
        "trivela", {"calibrate", "run", "--in", "simulation", "--robot", more, "--out-dir", "drives"}, folder_->path()};
    EXPECT_EQ(again.wait(), 2);
    EXPECT_THAT(again.errors(), HasSubstr("exists already"));
  }
}

/// A run that has begun to record its first drive.
class RunningCalibration {
 public:
  RunningCalibration() {
    const bool begun = wait_for_change(folder_.path(), program_.watch(), [this] {
      std::error_code none_yet;
      const auto written = std::filesystem::file_size(folder_ / "1_standing.scans.db-wal", none_yet);
      return !none_yet && written > 200'000;
    });
    if (!begun) throw std::runtime_error{"it did not get going: " + program_.errors()};
    for (const pid_t child : children_of(program_.id())) nodes_.emplace(program_of(child), ProcessWatch{child});
  }
  Program& program() { return program_; }
  std::filesystem::path log() const { return folder_ / "1_standing.db"; }
  const std::map<std::string, ProcessWatch>& nodes() const { return nodes_; }
  bool all_nodes_ended() const {
    return std::all_of(nodes_.begin(), nodes_.end(),
                       [](const auto& node) { return node.second.ended(std::chrono::milliseconds{0}); });
  }

 private:
  tests::Folder folder_;
  Program program_{"trivela", {"calibrate", "run", "--in", "simulation", "--out-dir", "."}, folder_.path()};
  std::map<std::string, ProcessWatch> nodes_;
};

TEST(CalibrateRunEnding, CtrlCLeavesAValidRecordAndNoProcess) {
  RunningCalibration run;
  EXPECT_TRUE(run.nodes().contains("trivela-scan_recorder"));
  run.program().signal(SIGINT);
  EXPECT_EQ(run.program().wait(), 1);
  EXPECT_THAT(run.program().errors(), AllOf(HasSubstr("interrupted"), HasSubstr("1_standing.db")));
  EXPECT_TRUE(run.all_nodes_ended());
  EXPECT_THAT(loose_ends_of(run.log()), IsEmpty());
}

TEST(CalibrateRunEnding, ANodeThatDiesIsNamed) {
  RunningCalibration run;
  kill(run.nodes().at("trivela-scan_recorder").id(), SIGKILL);
  EXPECT_EQ(run.program().wait(), 1);
  EXPECT_THAT(run.program().errors(), HasSubstr("scan_recorder died"));
  EXPECT_TRUE(run.all_nodes_ended());
}

TEST(CalibrateRunUsage, KnowsNoWorldButTheSimulation) {
  const tests::Folder folder;
  Program run{"trivela", {"calibrate", "run", "--in", "reality"}, folder.path()};
  EXPECT_EQ(run.wait(), 2);
  EXPECT_THAT(run.errors(), HasSubstr("simulation"));
}

}  // namespace
}  // namespace trivela::e2e
