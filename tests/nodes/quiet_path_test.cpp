// The way of a decision between the instant at which the world's state is taken and the one at which order and drive
// are written, seen from outside: who asks the heap, who waits for a mutex.

#include <spdlog/sinks/null_sink.h>

#include <memory>
#include <mutex>
#include <thread>

#include "nodes/kick_decision/kick_decision_node.hpp"
#include "tests/instants.hpp"
#include "tests/nodes/node_fixture.hpp"
#include "tests/nodes/path_hooks.hpp"

namespace trivela::nodes {
namespace {

using tests::PathHooks;

std::size_t sum(const std::vector<tests::Asked>& asked) {
  std::size_t times = 0;
  for (const auto& [object, n] : asked) times += n;
  return times;
}

/// Who asked and is not the DDS library, in words; empty: nobody.
std::string of_ours(const std::vector<tests::Asked>& asked) {
  std::string out;
  for (const auto& [object, times] : asked) {
    if (object.find("libddsc") == std::string::npos) out += fmt::format("{}: {} times; ", object, times);
  }
  return out;
}

/// Delivered by a listener in the thread of who writes the world's state, so that one thread runs the whole path.
class QuietPath : public NodeTest {
 protected:
  ~QuietPath() override { PathHooks::stop(); }

  void start() {
    context.logger = std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::null_sink_mt>());
    node.emplace(context);
    running.emplace(bus::Executor::kListener, stop, std::vector<bus::Node*>{&node->node()});
    world_says.expect_reader();
    kicker_says.expect_reader();
  }

  /// One decision of every policy, the moving one in charge: off the goal's direction it holds, at rest towards it it
  /// kicks.
  void cycle(double heading_rad, double speed_mps = 1.0) {
    msg::KickerStatus status{};
    status.t_ns = t_ns;
    status.ready = true;
    kicker_says(status);
    msg::WorldState world{};
    world.t_ns = clock_ns = t_ns;
    world.half = 1;
    world.playing = world.possession = world.ball_known = true;
    world.possession_id = 1;
    world.y_m = 3.0;
    world.vx_mps = speed_mps;
    world.heading_rad = heading_rad;
    world.opponent_distance_m = 2.0;
    PathHooks::start();
    world_says(world);
    PathHooks::stop();
    t_ns += kCycle_ns;
  }

  std::int64_t t_ns = 1'000'000'000;
  Received<msg::KickDecision> decision{participant};
  Received<msg::KickOrder> order{participant};
  Says<msg::WorldState> world_says{participant};
  Says<msg::KickerStatus> kicker_says{participant};
  std::optional<KickDecisionNode> node;
  std::optional<Running> running;
};

TEST(PathHooks, SeeAnAllocationAndAMutexThatIsWaitedFor) {
  std::mutex mutex;
  std::unique_lock held(mutex);
  std::latch waits(1);
  std::thread other;
  PathHooks::clear();
  PathHooks::start();
  const auto text = std::make_unique<std::string>(100, 'x');
  PathHooks::stop();
  EXPECT_GT(sum(PathHooks::allocations()), 0u);
  EXPECT_EQ(sum(PathHooks::mutex_waits()), 0u);
  other = std::thread([&] {
    PathHooks::start();
    waits.count_down();
    const std::lock_guard lock(mutex);
    PathHooks::stop();
  });
  waits.wait();
  while (sum(PathHooks::mutex_waits()) == 0) std::this_thread::yield();
  held.unlock();
  other.join();
  EXPECT_NE(of_ours(PathHooks::mutex_waits()), "");
}

TEST_F(QuietPath, NothingOfOursAllocatesOrWaitsBetweenTakeAndWrite) {
  start();
  for (int i = 0; i < 100; ++i) cycle(0.9 + 0.001 * i);
  PathHooks::clear();
  for (int i = 0; i < 500; ++i) cycle(0.9 + 0.0005 * i);
  decision.first(600);
  EXPECT_EQ(decision.now().back().reason, msg::REASON_NOT_ALIGNED);
  EXPECT_EQ(order.now().size(), 0u);
  EXPECT_EQ(of_ours(PathHooks::allocations()), "");
  EXPECT_EQ(of_ours(PathHooks::mutex_waits()), "");
  const auto library = sum(PathHooks::allocations());
  fmt::print("libddsc: {:.1f} allocations and {:.3f} mutexes waited for a cycle (3 samples written, 1 taken)\n",
             static_cast<double>(library) / 500.0, static_cast<double>(sum(PathHooks::mutex_waits())) / 500.0);
}

TEST_F(QuietPath, NothingOfOursAllocatesWhereAKickIsOrdered) {
  start();
  for (int i = 0; i < 100; ++i) cycle(0.9);
  PathHooks::clear();
  for (int i = 0; i < 5; ++i) cycle(0.0, 0.0);
  EXPECT_EQ(order.first(1).size(), 1u);
  EXPECT_EQ(of_ours(PathHooks::allocations()), "");
}

}  // namespace
}  // namespace trivela::nodes
