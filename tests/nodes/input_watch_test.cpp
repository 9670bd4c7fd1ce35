#include "nodes/runtime/input_watch.hpp"

#include "nodes/world_state/world_state_node.hpp"
#include "tests/nodes/node_fixture.hpp"

namespace trivela::nodes {
namespace {

using bus::Executor;

class InputWatchTest : public NodeTest {
 protected:
  /// Says T again and again in a thread of its own while it lives.
  template <class T>
  class Voice {
   public:
    explicit Voice(const bus::Participant& participant) : says_(participant) {
      node_ = std::make_unique<bus::Node>(participant, "writer");
      node_->every(std::chrono::milliseconds{10}, "writer", [this] { says_(T{}); });
      thread_ = std::thread{[this] { bus::Executor{Executor::kListener, stop_, {node_.get()}}.run(); }};
    }
    ~Voice() {
      stop_.request();
      thread_.join();
    }

   private:
    Says<T> says_;
    std::unique_ptr<bus::Node> node_;
    bus::Stop stop_;
    std::thread thread_;
  };

  bus::Node listener{participant, "listener", 1};
};

TEST_F(InputWatchTest, AnInputThatFallsSilentAndComesBackHasALineAtEachEnd) {
  listener.on<msg::Odometry>([](const msg::Odometry&) {});
  const auto referee = listener.stores<msg::Referee>();
  InputWatch watch{context, listener};
  const Running running{Executor::kListener, stop, {&listener}};
  for (int i = 0; i < 2; ++i) {
    {
      const Voice<msg::Odometry> odometry{participant};
      const Voice<msg::Referee> words{participant};
      if (i == 1) {
        EXPECT_TRUE(log_lines->wait_for("odometry back after 0."));
        EXPECT_TRUE(log_lines->wait_for("referee back after "));
      } else {
        Received<msg::Odometry>{participant}.first(5);
        Received<msg::Referee>{participant}.first(5);
      }
    }
    if (i == 0) {
      EXPECT_TRUE(log_lines->wait_for("no odometry for 0."));
      EXPECT_TRUE(log_lines->wait_for("no referee for 0."));
    }
  }
}

TEST_F(InputWatchTest, ADeviceIsWatchedToo) {
  std::atomic<bool> speaks = true;
  listener.on_device(
      "wheels",
      [&](std::chrono::nanoseconds timeout) -> std::optional<int> {
        context.idle(std::min<std::chrono::nanoseconds>(timeout, std::chrono::milliseconds{5}));
        return speaks ? std::optional{1} : std::nullopt;
      },
      [&, n = 0](int) mutable { speaks = ++n < 20; });
  InputWatch watch{context, listener};
  const Running running{Executor::kListener, stop, {&listener}};
  EXPECT_TRUE(log_lines->wait_for("no wheels for 0."));
}

TEST_F(InputWatchTest, WhatWasNeverHeardIsSaidOnceAfterSomeSeconds) {
  listener.on<msg::Odometry>([](const msg::Odometry&) {});
  listener.on<msg::KickOutcome>([](const msg::KickOutcome&) {});
  InputWatch watch{context, listener};
  const Running running{Executor::kListener, stop, {&listener}};
  EXPECT_TRUE(log_lines->wait_for("odometry not received yet"));
  EXPECT_EQ(log_lines->count("not received yet"), 1u) << "events have no period";
}

TEST_F(InputWatchTest, InLockstepNothingIsWatched) {
  context.settings.run.lockstep = true;
  listener.on<msg::Odometry>([](const msg::Odometry&) {});
  const std::size_t before = listener.reactions().size();
  InputWatch watch{context, listener};
  EXPECT_EQ(listener.reactions().size(), before);
}

}  // namespace
}  // namespace trivela::nodes
