// The nodes without lockstep, each started alone: samples come in real time and nobody waits for anybody.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <deque>
#include <fstream>
#include <random>

#include "config/settings.hpp"
#include "tests/e2e/folder.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"

namespace trivela::e2e {
namespace {

using testing::IsEmpty;

config::Settings settings_for(const Folder& folder) {
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

TEST(RealTime, NodesThatAreStartedOneByOneRecordAMatchAndStopOnSigterm) {
  const Folder folder;
  std::ofstream{folder / "nodes.toml"} << config::to_toml_text(settings_for(folder));
  const std::vector<std::string> arguments{"--config", "nodes.toml"};
  Program recorder{"trivela-recorder", arguments, folder.path()};
  std::deque<Program> nodes;
  for (const char* const node : {"odometry", "world_state", "kick_decision", "kicker_driver", "shot_observer"}) {
    nodes.emplace_back("trivela-" + std::string{node}, arguments, folder.path());
  }
  // A node says that it is there, and the recorder makes the log.
  for (const Program& node : nodes) {
    ASSERT_TRUE(wait_for_change(folder.path(), node.watch(), [&] { return !node.errors().empty(); }));
  }
  ASSERT_TRUE(wait_for_change(folder.path(), recorder.watch(), [&] { return exists(folder / "match.db"); }));
  const auto started = std::chrono::steady_clock::now();
  Program simulator{"trivela-simulator", arguments, folder.path()};
  EXPECT_EQ(simulator.wait(), 0) << simulator.errors();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
  EXPECT_GE(took.count(), 6.0) << "that is not real time";
  for (Program& node : nodes) {
    node.signal(SIGTERM);
    EXPECT_EQ(node.wait(), 0) << node.errors();
  }
  recorder.signal(SIGTERM);
  EXPECT_EQ(recorder.wait(), 0) << recorder.errors();

  EXPECT_THAT(loose_ends_of(folder / "match.db"), IsEmpty());
  const Reader log{folder / "match.db"};
  EXPECT_GE(number_of(log, "SELECT count(*) FROM referee"), 250);
  EXPECT_GE(number_of(log, "SELECT count(*) FROM world_states"), 200);
  EXPECT_GT(number_of(log, "SELECT count(*) FROM kick_decisions"), 20);
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM kick_decisions WHERE policy <> 'moving'"), 0);
  // A fired decision is ordered and answered here as well.
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM kicks WHERE order_seq IS NULL OR accepted IS NULL"), 0);
}

}  // namespace
}  // namespace trivela::e2e
