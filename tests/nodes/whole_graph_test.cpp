// All nodes of a robot in one process.
#include <algorithm>
#include <limits>
#include <type_traits>

#include "bus/reactions.hpp"
#include "log/read/reader.hpp"
#include "nodes/kick_decision/kick_decision_node.hpp"
#include "nodes/kicker_drift/kicker_drift_node.hpp"
#include "nodes/kicker_driver/kicker_driver_node.hpp"
#include "nodes/odometry/odometry_node.hpp"
#include "nodes/recorder/recorder_node.hpp"
#include "nodes/runtime/readers.hpp"
#include "nodes/shot_observer/shot_observer_node.hpp"
#include "nodes/world_state/world_state_node.hpp"
#include "security/rights.hpp"
#include "tests/instants.hpp"
#include "tests/nodes/node_fixture.hpp"
#include "tests/support/folder.hpp"

namespace trivela::nodes {
namespace {

using ::testing::Contains;

class WholeGraphTest : public NodeTest {
 protected:
  std::vector<bus::Node*> chain() {
    odometry.emplace(context, fake_wheels());
    world_state.emplace(context);
    kick_decision.emplace(context);
    const std::int64_t now_ns = clock_ns.exchange(0);  // it has rested, whoever fired before it
    kicker_driver.emplace(context, fake_kicker());
    clock_ns = now_ns;
    return {&odometry->node(), &world_state->node(), &kick_decision->node(), &kicker_driver->node()};
  }
  std::vector<bus::Node*> whole() {
    auto nodes = chain();
    shot_observer.emplace(context);
    log::WriterOptions options;
    options.warn = [](const std::string&) {};
    log.emplace(folder / "match.db", log::Session{}, options);
    recorder.emplace(context, *log);
    nodes.push_back(&shot_observer->node());
    nodes.push_back(&recorder->node());
    return nodes;
  }

  tests::Folder folder;
  std::optional<log::Writer> log;
  std::optional<OdometryNode> odometry;
  std::optional<WorldStateNode> world_state;
  std::optional<KickDecisionNode> kick_decision;
  std::optional<KickerDriverNode> kicker_driver;
  std::optional<ShotObserverNode> shot_observer;
  std::optional<RecorderNode> recorder;
};

TEST_F(WholeGraphTest, WritersWaitForThoseWhoRead) {
  const auto nodes = whole();
  bus::for_each_message([&]<class T>() {
    const auto reads = [](const bus::Node* node) {
      const auto& inputs = node->inputs();
      return std::ranges::find(inputs, bus::meta<T>::topic, &bus::Input::name) != inputs.end();
    };
    // Here the devices that read these are fakes.
    constexpr bool device = std::is_same_v<T, msg::DeviceWheels> || std::is_same_v<T, msg::DeviceKicker>;
    // The driver looks on at the world, and nobody waits for it there.
    constexpr bool looks_on = std::is_same_v<T, msg::WorldState>;
    EXPECT_EQ(readers_of<T>(context.settings), std::ranges::count_if(nodes, reads) + device - looks_on)
        << bus::meta<T>::topic;
  });
}

// On a secured bus it would be refused what its permissions leave out.
TEST_F(WholeGraphTest, ANodeReadsAndWritesWhatItsKeysAllow) {
  KickerDriftNode kicker_drift{context};
  auto nodes = whole();
  nodes.push_back(&kicker_drift.node());
  for (const bus::Node* const node : nodes) {
    const auto reactions = node->reactions();
    ASSERT_FALSE(reactions.empty());
    const std::string name = reactions.front().name.substr(0, reactions.front().name.find('/'));
    const security::Rights& rights = security::rights_of(name);
    for (const bus::Reaction& reaction : reactions)
      for (const std::string& output : reaction.outputs) EXPECT_THAT(rights.publish, Contains(output)) << name;
    for (const bus::Input& input : node->inputs()) {
      const bool topic = input.name.find(':') == std::string::npos;  // else a device or a timer
      if (topic) {
        EXPECT_THAT(rights.subscribe, Contains(input.name)) << name;
      }
    }
  }
}

TEST_F(WholeGraphTest, HasNoCycle) {
  std::vector<bus::Reaction> reactions;
  for (const auto* node : whole())
    for (auto& reaction : node->reactions()) reactions.push_back(std::move(reaction));
  const auto cycle = bus::find_cycle(reactions);
  EXPECT_FALSE(cycle) << ::testing::PrintToString(*cycle);
  // The edges that the chain is made of, so that an empty graph does not pass.
  const auto leads = [&](const std::string& from, const std::string& to) {
    for (const auto& reaction : reactions)
      if (reaction.input == from &&
          std::find(reaction.outputs.begin(), reaction.outputs.end(), to) != reaction.outputs.end())
        return true;
    return false;
  };
  EXPECT_TRUE(leads("device:wheels", "odometry"));
  EXPECT_TRUE(leads("odometry", "world_state"));
  EXPECT_TRUE(leads("world_state", "kick_order"));
  EXPECT_TRUE(leads("world_state", "drive"));
  EXPECT_TRUE(leads("kick_order", "kick_receipt"));
  EXPECT_TRUE(leads("kick_receipt", "kick_outcome"));
  EXPECT_TRUE(leads("device:kicker", "kicker_status"));
}

TEST_F(WholeGraphTest, AWheelSampleBecomesAKickInTheSensorsThread) {
  Received<msg::KickReceipt> receipt{participant};
  Received<msg::KickDecision> decision{participant};
  Received<msg::KickerStatus> status{participant};
  Says<msg::VisionFrame> camera{participant};
  Says<msg::Referee> referee{participant};
  const Running running{bus::Executor::kListener, stop, chain()};
  msg::Referee word{};
  word.t_ns = clock_ns;
  word.half = 1;
  word.playing = true;
  word.possession_id = 1;
  referee(word);
  std::size_t cycle = 0;
  while (kicker->commanded() == 0 && cycle < 10) {
    ++cycle;
    const std::int64_t t_ns = clock_ns += kCycle_ns;
    kicker->put({t_ns, 1.0, true, hal::KickerFault::kNone});
    status.first(cycle);
    msg::VisionFrame frame{};
    frame.t_ns = frame.t_exposure_ns = t_ns;
    frame.pose_seen = frame.ball_seen = true;
    frame.y_m = 3.0;
    frame.ball_y_m = 0.27;
    camera(frame);
    wheels->put({.t_ns = t_ns, .wheel_count = 3, .wheel_radps = {}, .gyro_radps = 0.0});
    ASSERT_EQ(wheels->commands(cycle).size(), cycle) << "every sample ends in a drive command";
  }
  const auto fired = kicker->commands(1);
  ASSERT_EQ(fired.size(), 1u);
  EXPECT_GE(cycle, 3u) << "the ball must have been in the handler for a while";
  EXPECT_EQ(fired[0].thread, wheels->reader());
  for (const auto& driven : wheels->commands(cycle)) EXPECT_EQ(driven.thread, wheels->reader());
  const auto answered = receipt.nth(1);
  EXPECT_TRUE(answered.accepted);
  EXPECT_EQ(answered.kick_id, fired[0].kick_id);
  EXPECT_EQ(answered.order_t_ns, 1'000'000'000 + static_cast<std::int64_t>(cycle) * kCycle_ns);
  EXPECT_EQ(decision.now().back().kick_id, fired[0].kick_id);
  EXPECT_EQ(decision.now().back().power, fired[0].power);
}

// The same with the observer and the recorder beside them.
TEST_F(WholeGraphTest, RunsToCompletionWithEveryNode) {
  const auto nodes = whole();
  clock_ns = 0;
  {
    const Running running{bus::Executor::kListener, stop, nodes};
    for (std::size_t cycle = 1; cycle <= 50; ++cycle) {
      wheels->put({.t_ns = clock_ns += kCycle_ns, .wheel_count = 3, .wheel_radps = {1.0, -1.0, 0.5}, .gyro_radps = {}});
      ASSERT_EQ(wheels->commands(cycle).size(), cycle);
    }
  }
  log->finalise();
  const log::Reader reader{folder / "match.db"};
  for (const std::string table : {"odometry", "world_states", "drive_commands"}) {
    std::int64_t rows = 0;
    reader.query("SELECT seq FROM " + table, [&](std::int64_t) { ++rows; });
    EXPECT_EQ(rows, 50) << table;
  }
}

}  // namespace
}  // namespace trivela::nodes
