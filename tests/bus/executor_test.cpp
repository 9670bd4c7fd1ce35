#include "bus/executor.hpp"

#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>

#include "tests/bus/test_domain.hpp"

namespace trivela::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

// Values that a test hands to a node as if they came from a device, one at a time.
class Feed {
 public:
  void put(std::int64_t value) {
    const std::lock_guard lock(mutex_);
    values_.push_back(value);
    changed_.notify_all();
  }
  std::optional<std::int64_t> get(nanoseconds timeout) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, timeout, [&] { return !values_.empty(); })) return std::nullopt;
    const auto value = values_.front();
    values_.erase(values_.begin());
    return value;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::int64_t> values_;
};

// Sensor -> Odometry -> WorldState -> KickOrder, as three nodes that each make of x something that tells the order of
// the steps.
struct Chain {
  explicit Chain(const Participant& participant)
      : odometry(participant, "odometry", 1),
        world_state(participant, "world_state", 1),
        kick_decision(participant, "kick_decision", 1) {
    odometry.on_device(
        "wheels", [this](nanoseconds timeout) { return feed.get(timeout); },
        [out = odometry.writer<msg::Odometry>()](std::int64_t value) {
          msg::Odometry sample{};
          sample.robot_id = 1;
          sample.t_ns = value;
          sample.x_m = static_cast<double>(value) + 1;
          out.write(sample);
        },
        writes<msg::Odometry>());
    world_state.on<msg::Odometry>(
        [out = world_state.writer<msg::WorldState>()](const msg::Odometry& in) {
          msg::WorldState sample{};
          sample.robot_id = 1;
          sample.t_ns = in.t_ns;
          sample.x_m = in.x_m * 2;
          out.write(sample);
        },
        writes<msg::WorldState>());
    kick_decision.on<msg::WorldState>(
        [out = kick_decision.writer<msg::KickOrder>()](const msg::WorldState& in) {
          msg::KickOrder sample{};
          sample.robot_id = 1;
          sample.t_ns = in.t_ns;
          sample.power = in.x_m + 3;
          out.write(sample);
        },
        writes<msg::KickOrder>());
  }
  std::vector<Node*> nodes() { return {&odometry, &world_state, &kick_decision}; }

  Feed feed;
  Node odometry, world_state, kick_decision;
};

// Feeds the chain and returns the powers of the orders that come out.
std::vector<double> play(Executor::Kind kind) {
  const Participant participant(fresh_domain());
  Chain chain(participant);
  Mailbox<msg::KickOrder> orders(participant);
  Stop stop;
  Executor executor(kind, stop, chain.nodes());
  std::vector<double> powers;
  std::thread player([&] {
    for (std::int64_t t = 1; t <= 100; ++t) {
      chain.feed.put(t);
      const auto order = orders.await(t, seconds(10));
      if (!order) break;
      powers.push_back(order->power);
    }
    stop.request();
  });
  executor.run();
  player.join();
  return powers;
}

TEST(ExecutorTest, BothKindsGiveTheSameOrdersOverThreeHops) {
  const auto waitset = play(Executor::kWaitset);
  const auto listener = play(Executor::kListener);
  ASSERT_EQ(waitset.size(), 100u);
  EXPECT_EQ(waitset[9], (10 + 1) * 2 + 3);
  EXPECT_EQ(waitset, listener);
}

TEST(ExecutorTest, ListenersRunAChainToCompletionInTheWritersThread) {
  const Participant participant(fresh_domain());
  Node node(participant, "node");
  std::atomic<std::thread::id> reacted;
  node.on<msg::Odometry>([&](const msg::Odometry&) { reacted = std::this_thread::get_id(); });
  Stop stop;
  Executor executor(Executor::kListener, stop, {&node});
  Writer<msg::Odometry> writer(participant);
  std::atomic<std::thread::id> wrote;
  std::thread player([&] {
    wrote = std::this_thread::get_id();
    EXPECT_TRUE(writer.wait_for_readers(1, seconds(10)));
    for (std::int64_t t = 0; reacted.load() != wrote.load() && t < 1'000'000; ++t) {
      msg::Odometry sample{};
      sample.t_ns = t;
      writer.write(sample);  // the first few may come before the executor listens
    }
    stop.request();
  });
  executor.run();
  player.join();
  EXPECT_EQ(reacted.load(), wrote.load());
}

// A state that was published before the node came must not be overlooked, whichever thread brings it.
TEST(ExecutorTest, BothKindsReactToTheStateOfAWriterThatWasThereBefore) {
  for (const auto kind : {Executor::kWaitset, Executor::kListener}) {
    const Participant participant(fresh_domain());
    Writer<msg::Referee> writer(participant);
    msg::Referee referee{};
    referee.t_ns = 20;
    writer.write(referee);
    Node node(participant, "node");
    Stop stop;
    std::int64_t seen = 0;
    node.on<msg::Referee>([&](const msg::Referee& sample) {
      seen = sample.t_ns;
      stop.request();
    });
    Executor(kind, stop, {&node}).run();
    EXPECT_EQ(seen, 20);
  }
}

TEST(ExecutorTest, ANodeReactsToItsRobotOnly) {
  const Participant participant(fresh_domain());
  Node node(participant, "node", 2);
  Stop stop;
  std::vector<int> robots;
  node.on<msg::Odometry>([&](const msg::Odometry& sample) {
    robots.push_back(sample.robot_id);
    stop.request();
  });
  Writer<msg::Odometry> writer(participant);
  for (const std::uint8_t robot : {1, 2, 3}) {
    msg::Odometry sample{};
    sample.robot_id = robot;
    writer.write(sample);
  }
  Executor(Executor::kWaitset, stop, {&node}).run();
  EXPECT_EQ(robots, std::vector<int>{2});
}

TEST(ExecutorTest, ListenersRefuseACycleAndNameIt) {
  const Participant participant(fresh_domain());
  Node there(participant, "there"), back(participant, "back");
  there.on<msg::Odometry>([](const msg::Odometry&) {}, writes<msg::WorldState>());
  back.on<msg::WorldState>([](const msg::WorldState&) {}, writes<msg::Odometry>());
  Stop stop;
  try {
    Executor(Executor::kListener, stop, {&there, &back}).run();
    FAIL() << "ran a cycle";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("odometry -> world_state -> odometry"));
  }
}

// The same two nodes may run with a thread each: nobody waits for anybody.
TEST(ExecutorTest, WaitsetsRunACycle) {
  const Participant participant(fresh_domain());
  Node there(participant, "there"), back(participant, "back");
  Stop stop;
  there.on<msg::Odometry>(
      [out = there.writer<msg::WorldState>()](const msg::Odometry& in) {
        msg::WorldState sample{};
        sample.t_ns = in.t_ns + 1;
        out.write(sample);
      },
      writes<msg::WorldState>());
  back.on<msg::WorldState>(
      [out = back.writer<msg::Odometry>(), &stop](const msg::WorldState& in) {
        if (in.t_ns >= 100) return stop.request();
        msg::Odometry sample{};
        sample.t_ns = in.t_ns + 1;
        out.write(sample);
      },
      writes<msg::Odometry>());
  Writer<msg::Odometry> first(participant);
  first.write({});
  Executor(Executor::kWaitset, stop, {&there, &back}).run();
  EXPECT_TRUE(stop.requested());
}

TEST(ExecutorTest, AWriteThatWasNotDeclaredIsRefused) {
  for (const auto kind : {Executor::kWaitset, Executor::kListener}) {
    const Participant participant(fresh_domain());
    Writer<msg::Odometry> writer(participant);
    writer.write({});
    Node node(participant, "sneaky");
    const auto order = node.writer<msg::KickOrder>();
    node.on<msg::Odometry>([&](const msg::Odometry&) { order.write({}); }, writes<msg::WorldState>());
    Stop stop;
    try {
      Executor(kind, stop, {&node}).run();
      FAIL() << "wrote what it had not declared";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("kick_order"));
      EXPECT_THAT(error.what(), HasSubstr("sneaky/odometry"));
    }
    EXPECT_NO_THROW(order.write({})) << "outside of reactions nothing is declared";
  }
}

TEST(ExecutorTest, AnExceptionInAReactionEndsTheRunAndComesOut) {
  for (const auto kind : {Executor::kWaitset, Executor::kListener}) {
    const Participant participant(fresh_domain());
    Chain chain(participant);
    Node broken(participant, "broken", 1);
    broken.on<msg::KickOrder>([](const msg::KickOrder& order) {
      throw std::runtime_error("cannot take power " + std::to_string(static_cast<int>(order.power)));
    });
    auto nodes = chain.nodes();
    nodes.push_back(&broken);
    chain.feed.put(1);
    Stop stop;
    Executor executor(kind, stop, nodes);
    try {
      executor.run();
      FAIL() << "swallowed it";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "cannot take power 7");
    }
    EXPECT_TRUE(stop.requested());
  }
}

TEST(ExecutorTest, AnExceptionOfADeviceEndsTheRunAndComesOut) {
  const Participant participant(fresh_domain());
  Node node(participant, "node");
  node.on_device(
      "wheels", [](nanoseconds) -> std::optional<int> { throw std::runtime_error("unplugged"); }, [](int) {});
  Stop stop;
  Executor executor(Executor::kWaitset, stop, {&node});
  EXPECT_THROW(executor.run(), std::runtime_error);
}

TEST(ExecutorTest, ASignalStopsIt) {
  for (const auto kind : {Executor::kWaitset, Executor::kListener}) {
    const Participant participant(fresh_domain());
    Node node(participant, "node");
    Writer<msg::Odometry> writer(participant);
    writer.write({});
    node.on<msg::Odometry>([](const msg::Odometry&) { raise(SIGTERM); });
    Stop stop;
    const StopOnSignals on_signals(stop);
    Executor(kind, stop, {&node}).run();
    EXPECT_TRUE(stop.requested());
    EXPECT_EQ(alarm(0), 0U) << "a recorder may take long to close its log";
  }
}

TEST(ExecutorTest, StoppingEndsAReactionThatAwaits) {
  const Participant participant(fresh_domain());
  Node node(participant, "node");
  Stop stop;
  const auto vision = node.stores<msg::VisionFrame>();
  bool got = true;
  node.on<msg::Odometry>([&](const msg::Odometry&) {
    stop.request();
    got = vision->await(1, seconds(60)).has_value();
  });
  Writer<msg::Odometry> writer(participant);
  writer.write({});
  const auto start = std::chrono::steady_clock::now();
  Executor(Executor::kWaitset, stop, {&node}).run();
  EXPECT_FALSE(got);
  EXPECT_LT(std::chrono::steady_clock::now() - start, seconds(30));
}

// What a recorder has received it must have written down, however suddenly it is stopped.
TEST(ExecutorTest, AReactionThatKeepsAllSeesEverythingThatArrivedBeforeTheStop) {
  for (const auto kind : {Executor::kWaitset, Executor::kListener}) {
    const Participant participant(fresh_domain());
    Node recorder(participant, "recorder");
    std::vector<std::int64_t> seen;
    recorder.on<msg::KickReceipt>([&](const msg::KickReceipt& receipt) { seen.push_back(receipt.t_ns); }, {},
                                  {.keep_all = true});
    Writer<msg::KickReceipt> writer(participant);
    Stop stop;
    std::thread player([&] {
      EXPECT_TRUE(writer.wait_for_readers(1, seconds(10)));
      for (std::int64_t t = 1; t <= 100; ++t) {
        msg::KickReceipt receipt{};
        receipt.t_ns = t;
        writer.write(receipt);
      }
      stop.request();
    });
    Executor(kind, stop, {&recorder}).run();
    player.join();
    ASSERT_EQ(seen.size(), 100u);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  }
}

// Without its turn in order, the thread sanitizer sees the reader go while a listener takes from it.
TEST(ExecutorTest, RunsEndWhileSamplesPourIn) {
  const Participant participant(fresh_domain(), {.warn = {}, .stay = seconds(1000)});
  Writer<msg::Odometry> writer(participant);
  std::atomic<bool> over = false;
  std::thread sensor([&] {
    msg::Odometry sample{};
    for (; !over; ++sample.t_ns) writer.write(sample);
  });
  for (int i = 0; i < 200; ++i) {
    Node node(participant, "node");
    Stop stop;
    node.on<msg::Odometry>([](const msg::Odometry&) {});
    node.every(milliseconds(1), "end", [&] { stop.request(); });
    Executor(Executor::kListener, stop, {&node}).run();
  }
  over = true;
  sensor.join();
}

TEST(ExecutorTest, ANodesReactionsCanBeReadWithoutRunningIt) {
  const Participant participant(fresh_domain());
  Chain chain(participant);
  const auto reactions = chain.kick_decision.reactions();
  ASSERT_EQ(reactions.size(), 1u);
  EXPECT_EQ(reactions[0].name, "kick_decision/world_state");
  EXPECT_EQ(reactions[0].input, "world_state");
  EXPECT_EQ(reactions[0].outputs, std::vector<std::string>{"kick_order"});
  EXPECT_EQ(chain.odometry.reactions()[0].input, "device:wheels");
}

TEST(ExecutorTest, ATimerTicksAPeriodApartAndEndsWithTheStop) {
  const Participant participant(fresh_domain());
  Node node(participant, "node");
  Stop stop;
  std::vector<std::chrono::steady_clock::time_point> ticks;
  node.every(milliseconds(5), "clock", [&] {
    ticks.push_back(std::chrono::steady_clock::now());
    if (ticks.size() == 20) stop.request();
  });
  Executor(Executor::kListener, stop, {&node}).run();
  ASSERT_EQ(ticks.size(), 20u) << "no tick after the stop";
  // One that is late puts the next off, so that they never come in a burst.
  EXPECT_GE(ticks.back() - ticks.front(), milliseconds(5 * 19 / 2));
}

TEST(ExecutorTest, ATimerMaySayWhenItIsDueNext) {
  const Participant participant(fresh_domain());
  Node node(participant, "node");
  Stop stop;
  std::vector<std::chrono::steady_clock::time_point> ticks;
  node.when_due(milliseconds(1), "clock", [&] {
    ticks.push_back(std::chrono::steady_clock::now());
    if (ticks.size() == 3) stop.request();
    return ticks.size() == 1 ? milliseconds(2) : milliseconds(40);
  });
  Executor(Executor::kListener, stop, {&node}).run();
  ASSERT_EQ(ticks.size(), 3u);
  EXPECT_GE(ticks[2] - ticks[0], milliseconds(40));
}

TEST(ExecutorTest, ALongPeriodDoesNotHoldUpTheStop) {
  const Participant participant(fresh_domain());
  Node node(participant, "node");
  Stop stop;
  node.every(std::chrono::hours(1), "clock", [] { FAIL() << "an hour is not over"; });
  node.every(milliseconds(5), "stopper", [&] { stop.request(); });
  Executor(Executor::kWaitset, stop, {&node}).run();
}

TEST(ExecutorTest, WhatATimerThrowsEndsTheRun) {
  const Participant participant(fresh_domain());
  Node node(participant, "node");
  Stop stop;
  node.every(milliseconds(1), "clock", [] { throw std::runtime_error("out of order"); });
  EXPECT_THROW(Executor(Executor::kListener, stop, {&node}).run(), std::runtime_error);
}

TEST(ExecutorTest, AMailboxGoesWithItsOwnerAndNotWithTheNode) {
  const Participant participant(fresh_domain());
  Node node(participant, "node");
  std::weak_ptr<Mailbox<msg::Referee>> mailbox;
  {
    const auto owned = node.stores<msg::Referee>();
    mailbox = owned;
  }
  EXPECT_TRUE(mailbox.expired());
  EXPECT_EQ(node.inputs().at(0).received_ns(0), 0);
}

TEST(ExecutorTest, ANodeKnowsWhenItsInputsCameLast) {
  const Participant participant(fresh_domain());
  Node node(participant, "node", 1);
  const auto mailbox = node.stores<msg::Referee>();
  node.on<msg::Odometry>([](const msg::Odometry&) {});
  Feed feed;
  node.on_device(
      "wheels", [&](nanoseconds timeout) { return feed.get(timeout); }, [](std::int64_t) {});
  ASSERT_EQ(node.inputs().size(), 3u);
  const auto received = [&](std::size_t i) { return node.inputs()[i].received_ns(INT64_MAX); };
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(received(i), 0) << node.inputs()[i].name;
  EXPECT_EQ(node.inputs()[0].period_s, meta<msg::Referee>::period_s);
  EXPECT_EQ(node.inputs()[2].name, "device:wheels");
  Writer<msg::Referee> referee(participant);
  Writer<msg::Odometry> odometry(participant);
  Stop stop;
  const auto write = [](auto& writer, auto sample, std::uint8_t robot_id) {
    sample.robot_id = robot_id;
    writer.write(sample);
  };
  feed.put(1);
  node.every(milliseconds(2), "looks", [&] {
    write(referee, msg::Referee{}, 2);
    write(odometry, msg::Odometry{}, 2);
    EXPECT_EQ(received(0), 0) << "another robot's";
    EXPECT_EQ(received(1), 0) << "another robot's";
    if (received(2) > 0) stop.request();
  });
  Executor(Executor::kListener, stop, {&node}).run();
  write(referee, msg::Referee{}, 1);
  EXPECT_GT(received(0), 0);
}

}  // namespace
}  // namespace trivela::bus
