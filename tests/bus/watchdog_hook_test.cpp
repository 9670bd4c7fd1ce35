// What an executor says of itself while it turns, and while something in it does not.
#include <gmock/gmock.h>

#include <atomic>
#include <condition_variable>
#include <functional>

#include "bus/executor.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::bus {
namespace {

constexpr std::chrono::milliseconds kTimeout{50};

TEST(Deadline, IsLateOnceItsPatienceIsOver) {
  Deadline turn;
  const Deadline::Time now{std::chrono::hours{1}};
  EXPECT_FALSE(turn.late(now, kTimeout)) << "nothing is due";
  turn.due(now);
  EXPECT_FALSE(turn.late(now + kTimeout, kTimeout));
  EXPECT_TRUE(turn.late(now + kTimeout + std::chrono::nanoseconds{1}, kTimeout));
  turn.idle();
  EXPECT_FALSE(turn.late(now + std::chrono::hours{1}, kTimeout));
}

/// A place where a reaction hangs until it is let go.
class Hang {
 public:
  void here() {
    std::unique_lock lock(mutex_);
    go_.wait(lock, [this] { return released_; });
  }
  void release() {
    const std::lock_guard lock(mutex_);
    released_ = true;
    go_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable go_;
  bool released_ = false;
};

/// Runs a node, of which something hangs, until a beat has named it, and then until none is late.
struct PulseTest : testing::TestWithParam<Executor::Kind> {
  void run(const std::string& hung) {
    std::vector<std::string> said;
    const auto notify = [&](const std::string& late) {
      beating = true;
      if (said.empty() || said.back() != late) said.push_back(late);
      if (!late.empty()) hang.release();
      if (late.empty() && std::ranges::find(said, hung) != said.end()) stop.request();
    };
    Executor{GetParam(), stop, {&node}, {.notify = notify, .timeout = kTimeout}}.run();
    EXPECT_THAT(said, testing::Contains(hung));
    EXPECT_EQ(said.back(), "");
  }

  Participant participant{fresh_domain()};
  Node node{participant, "node"};
  Stop stop;
  Hang hang;
  std::atomic<bool> beating = false;
};

TEST_P(PulseTest, ATimerThatHangsIsNamed) {
  node.every(std::chrono::milliseconds{1}, "clock", [this] { hang.here(); });
  run("node/clock");
}

TEST_P(PulseTest, ADeviceThatHangsIsNamed) {
  node.on_device(
      "wheels",
      [this](std::chrono::nanoseconds) {
        hang.here();
        stop.wait_until(std::chrono::steady_clock::now() + std::chrono::milliseconds{1});
        return std::optional<int>{};
      },
      [](int) {});
  run("node/wheels");
}

TEST_P(PulseTest, AReactionToATopicThatHangsIsNamed) {
  node.on<msg::Referee>([this](const msg::Referee&) { hang.here(); });
  Node feeder{participant, "feeder"};
  feeder.every(
      std::chrono::milliseconds{1}, "clock",
      [this, out = feeder.writer<msg::Referee>()] {
        if (beating) out.write(msg::Referee{});  // what came before would hang where nobody watches yet
      },
      writes<msg::Referee>());
  std::thread feeding{[&] { Executor{Executor::kWaitset, stop, {&feeder}}.run(); }};
  run("node/referee");
  feeding.join();
}

TEST_P(PulseTest, WhatHasNothingToDoIsNotLate) {
  node.on<msg::Referee>([](const msg::Referee&) {});
  node.every(std::chrono::hours{1}, "clock", [] {});
  int beats = 0;
  const auto notify = [&](const std::string& late) {
    EXPECT_EQ(late, "");
    if (++beats == 3) stop.request();
  };
  Executor{GetParam(), stop, {&node}, {.notify = notify, .timeout = kTimeout}}.run();
  EXPECT_EQ(beats, 3);
}

INSTANTIATE_TEST_SUITE_P(Kinds, PulseTest, testing::Values(Executor::kWaitset, Executor::kListener));

}  // namespace
}  // namespace trivela::bus
