// The nodes without lockstep, each started alone: samples come in real time and nobody waits for anybody.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <deque>
#include <fstream>
#include <optional>
#include <random>

#include "config/settings.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using testing::IsEmpty;

config::Settings settings_for(const tests::Folder& folder) {
  const std::filesystem::path shipped = std::filesystem::path{TRIVELA_SOURCE_DIR} / "config/default.toml";
  config::Settings settings = config::load_settings(shipped);
  std::random_device random;
  settings.run.lockstep = false;
  settings.domain.domain_id = 1 + random() % 100;
  settings.domain.tag = fmt::format("real-time-{}-{:08x}", getpid(), random());
  settings.simulator.halves = 2;
  settings.simulator.half_minutes = 0.05;
  settings.kick_decision.policy_by_half = {kicking::PolicyName::kMoving};
  settings.recorder.log = folder / "match.db";
  return settings;
}

/// The nodes of a robot, started one by one; the simulator is the test's.
class RealTime : public testing::Test {
 protected:
  RealTime() : settings_(settings_for(folder_)) {}

  void start() {
    std::ofstream{folder_ / "nodes.toml"} << config::to_toml_text(settings_);
    recorder_.emplace("trivela-recorder", kArguments, folder_.path());
    for (const char* const node : {"odometry", "world_state", "kick_decision", "kicker_driver", "shot_observer"}) {
      nodes_.emplace_back("trivela-" + std::string{node}, kArguments, folder_.path());
    }
    // A node says that it is there, and the recorder makes the log.
    for (const Program& node : nodes_) {
      ASSERT_TRUE(wait_for_change(folder_.path(), node.watch(), [&] { return !node.errors().empty(); }));
    }
    ASSERT_TRUE(wait_for_change(folder_.path(), recorder_->watch(), [&] { return exists(folder_ / "match.db"); }));
  }

  void stop() {
    for (Program& node : nodes_) {
      node.signal(SIGTERM);
      EXPECT_EQ(node.wait(), 0) << node.errors();
    }
    recorder_->signal(SIGTERM);
    EXPECT_EQ(recorder_->wait(), 0) << recorder_->errors();
  }

  /// Kicks that the driver says it has fired.
  std::size_t fired() const {
    const std::string said = nodes_[3].errors();
    std::size_t kicks = 0;
    for (std::size_t at = said.find(" fired with power"); at != said.npos; at = said.find(" fired with power", at + 1))
      ++kicks;
    return kicks;
  }

  const std::vector<std::string> kArguments{"--config", "nodes.toml"};
  const tests::Folder folder_;
  config::Settings settings_;
  std::optional<Program> recorder_;
  std::deque<Program> nodes_;
};

TEST_F(RealTime, NodesThatAreStartedOneByOneRecordAMatchAndStopOnSigterm) {
  start();
  const auto started = std::chrono::steady_clock::now();
  Program simulator{"trivela-simulator", kArguments, folder_.path()};
  EXPECT_EQ(simulator.wait(), 0) << simulator.errors();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
  EXPECT_GE(took.count(), 6.0) << "that is not real time";
  const std::string said = nodes_[3].errors();
  EXPECT_EQ(said.substr(0, said.find(" fired with power")).find("silent"), said.npos)
      << "nobody spoke before: " << said;
  stop();

  EXPECT_THAT(loose_ends_of(folder_ / "match.db"), IsEmpty());
  const Reader log{folder_ / "match.db"};
  EXPECT_GE(number_of(log, "SELECT count(*) FROM referee"), 70) << "as refbox, every 0.08 s";
  EXPECT_LT(number_of(log, "SELECT max(gap) FROM (SELECT t_ns - lag(t_ns) OVER (ORDER BY t_ns) AS gap FROM referee)"),
            1'000'000'000)
      << "a pause in which a robot would take him for silent";
  EXPECT_GE(number_of(log, "SELECT count(*) FROM world_states"), 200);
  EXPECT_GT(number_of(log, "SELECT count(*) FROM kick_decisions"), 20);
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM kick_decisions WHERE policy <> 'moving'"), 0);
  // A fired decision is ordered and answered here as well.
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM kicks WHERE order_seq IS NULL OR accepted IS NULL"), 0);
}

// The lever hears device/charge here, which has no cycle; the simulator's truth says what became of each order.
TEST_F(RealTime, ALeverStandsForTheKindOfEachOrderThatIsFired) {
  const std::filesystem::path config = std::filesystem::path{TRIVELA_SOURCE_DIR} / "config";
  settings_.run.robot = config / "robots/lob_flat_1.toml";
  settings_.run.scenario = config / "scenarios/flat_keeper.toml";
  settings_.kick_decision.policy_by_half = {kicking::PolicyName::kPredictive};
  settings_.simulator.halves = 1;
  settings_.simulator.half_minutes = 10.0;
  start();
  Program simulator{"trivela-simulator", kArguments, folder_.path()};
  ASSERT_TRUE(wait_for_change(folder_.path(), nodes_[3].watch(), [&] { return fired() >= 4; })) << nodes_[3].errors();
  simulator.signal(SIGTERM);
  simulator.wait();
  stop();
  const Reader log{folder_ / "match.db"};
  const std::string kicked = "FROM kick_orders AS o JOIN kick_truths AS t USING (session_id, robot_id, kick_id) ";
  EXPECT_GE(number_of(log, "SELECT count(*) " + kicked + "WHERE o.kick_kind = 1"), 1);
  EXPECT_EQ(number_of(log, "SELECT count(*) " + kicked + "WHERE (o.kick_kind = 1) <> (t.release_vz_mps < 2.0)"), 0);
  EXPECT_GT(number_of(log, "SELECT count(*) FROM kicker_status WHERE lever_kind = 255"), 0);
}

TEST_F(RealTime, ASimulatorThatIsStartedAnewIsPlayedWithAtOnce) {
  settings_.simulator.half_minutes = 10.0;
  start();
  std::size_t before = 0;
  for (const int run : {1, 2}) {
    Program simulator{"trivela-simulator", kArguments, folder_.path()};
    ASSERT_TRUE(wait_for_change(folder_.path(), simulator.watch(), [&] { return fired() >= before + 3; }));
    before = fired();
    simulator.signal(run == 1 ? SIGKILL : SIGTERM);
    simulator.wait();
  }
  stop();
  // Instants go on over the restart: they are the machine's, not the simulator's.
  const Reader log{folder_ / "match.db"};
  EXPECT_EQ(number_of(log,
                      "SELECT count(*) FROM referee AS a JOIN referee AS b USING (session_id, robot_id) "
                      "WHERE b.seq = a.seq + 1 AND b.t_ns <= a.t_ns"),
            0);
  EXPECT_GE(number_of(log, "SELECT count(*) FROM kick_receipts WHERE accepted"), 6);
  EXPECT_EQ(number_of(log,
                      "SELECT count(*) FROM kick_receipts WHERE accepted AND (received_steady_ns < order_t_ns OR "
                      "fired_steady_ns < received_steady_ns OR t_ns > order_t_ns + 100000000)"),
            0);
}

}  // namespace
}  // namespace trivela::e2e
