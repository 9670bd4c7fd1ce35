// What a node says to its service manager while it runs.
#include "nodes/runtime/supervisor.hpp"
#include "tests/nodes/node_fixture.hpp"
#include "tests/nodes/notify_socket.hpp"
#include "tests/support/folder.hpp"

namespace trivela::nodes {
namespace {

struct SignsOfLife : NodeTest {
  SignsOfLife() { context.supervisor = std::make_shared<Supervisor>(path, std::chrono::milliseconds{200}); }
  tests::Folder folder;
  std::string path = (folder / "notify").string();
  NotifySocket manager{path};
  bus::Node node{participant, "node", 1};
};

TEST_F(SignsOfLife, ANodeIsReadyOnceItsReadersAreThereAndSpeaksOnlyWhileItsLoopsComeRound) {
  std::latch go{1};
  std::atomic<bool> hang = false;
  node.every(std::chrono::milliseconds{10}, "clock", [&] {
    if (hang) go.wait();
  });
  EXPECT_EQ(manager.drain(), 0u) << "nothing runs yet";
  std::thread running{[&] { bus::Executor{bus::Executor::kListener, stop, {&node}, context.watchdog_hook()}.run(); }};
  EXPECT_EQ(manager.next(kPlenty), "READY=1");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(manager.next(kPlenty), "WATCHDOG=1");

  hang = true;
  EXPECT_TRUE(log_lines->wait_for("node/clock does not come round: the service manager gets no sign of life"));
  manager.drain();
  EXPECT_EQ(manager.next(std::chrono::milliseconds{300}), std::nullopt) << "longer than the watchdog waits";
  go.count_down();
  EXPECT_EQ(manager.next(kPlenty), "WATCHDOG=1");
  stop.request();
  running.join();
}

TEST_F(SignsOfLife, WithoutAManagerAnExecutorIsToldOfNobody) {
  context.supervisor.reset();
  EXPECT_FALSE(context.watchdog_hook().notify);
  context.alive();
}

}  // namespace
}  // namespace trivela::nodes
