#include "nodes/runtime/supervisor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/nodes/notify_socket.hpp"
#include "tests/support/folder.hpp"

namespace trivela::nodes {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

constexpr milliseconds kAtOnce{0};  // a datagram on this machine is there when sendto returns

struct SupervisorTest : testing::Test {
  ~SupervisorTest() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) unsetenv(name);
  }
  tests::Folder folder;
  std::string path = (folder / "notify").string();
  NotifySocket socket{path};
  Supervisor::Clock::time_point start{std::chrono::hours{1}};
};

TEST_F(SupervisorTest, IsToldOfAnEndOfTheProcessesOwnAccord) {
  Supervisor{path, std::nullopt}.stopping();
  EXPECT_EQ(socket.next(kAtOnce), "STOPPING=1");
}

TEST_F(SupervisorTest, HearsReadyOnceAndThenOneWordInAQuarterOfTheWatchdogsTime) {
  Supervisor manager{path, std::chrono::seconds{2}};
  EXPECT_EQ(socket.next(kAtOnce), std::nullopt);
  manager.alive(start);
  EXPECT_EQ(socket.next(kAtOnce), "READY=1");
  for (int i = 1; i < 5; ++i) manager.alive(start + i * milliseconds{100});
  EXPECT_EQ(socket.drain(), 0u);
  manager.alive(start + milliseconds{500});
  EXPECT_EQ(socket.next(kAtOnce), "WATCHDOG=1");
  for (int i = 6; i <= 25; ++i) manager.alive(start + i * milliseconds{100});
  EXPECT_EQ(socket.drain(), 4u);
}

TEST_F(SupervisorTest, WithoutAWatchdogHearsReadyAlone) {
  Supervisor manager{path, std::nullopt};
  for (int i = 0; i < 100; ++i) manager.alive(start + i * std::chrono::seconds{1});
  EXPECT_EQ(socket.next(kAtOnce), "READY=1");
  EXPECT_EQ(socket.drain(), 0u);
}

TEST_F(SupervisorTest, AnAbstractNameIsReachedToo) {
  const std::string name = "@trivela-notify-" + std::to_string(getpid());
  NotifySocket abstract{name};
  Supervisor manager{name, std::nullopt};
  manager.alive(start);
  EXPECT_EQ(abstract.next(kAtOnce), "READY=1");
}

TEST_F(SupervisorTest, WhoListensLateHearsReadyAtTheNextCall) {
  const std::string late = (folder / "late").string();
  Supervisor manager{late, std::chrono::seconds{2}};
  manager.alive(start);
  NotifySocket there{late};
  manager.alive(start + milliseconds{1});
  EXPECT_EQ(there.next(kAtOnce), "READY=1");
}

TEST_F(SupervisorTest, AFullSocketIsNotWaitedFor) {
  Supervisor manager{path, std::chrono::microseconds{4}};
  for (int i = 0; i < 100'000; ++i) manager.alive(start + i * milliseconds{1});  // more than any queue takes
  EXPECT_EQ(socket.next(kAtOnce), "READY=1");
  EXPECT_GT(socket.drain(), 0u);
}

TEST_F(SupervisorTest, IsWhatTheEnvironmentNames) {
  EXPECT_EQ(Supervisor::of_environment(), nullptr);
  setenv("NOTIFY_SOCKET", path.c_str(), 1);
  setenv("WATCHDOG_USEC", "2000000", 1);
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  const auto manager = Supervisor::of_environment();
  ASSERT_NE(manager, nullptr);
  for (int i = 0; i < 3; ++i) manager->alive(start + i * std::chrono::seconds{1});
  EXPECT_EQ(socket.next(kAtOnce), "READY=1");
  EXPECT_EQ(socket.drain(), 2u);
}

TEST_F(SupervisorTest, SomebodyElsesWatchdogHearsNothing) {
  setenv("NOTIFY_SOCKET", path.c_str(), 1);
  setenv("WATCHDOG_USEC", "2000000", 1);
  setenv("WATCHDOG_PID", std::to_string(getpid() + 1).c_str(), 1);
  const auto manager = Supervisor::of_environment();
  for (int i = 0; i < 3; ++i) manager->alive(start + i * std::chrono::seconds{1});
  EXPECT_EQ(socket.next(kAtOnce), "READY=1");
  EXPECT_EQ(socket.drain(), 0u);
}

TEST_F(SupervisorTest, WhatIsNoSocketIsRefusedByName) {
  for (const std::string& name : {std::string{"vsock:2:1"}, std::string{"/"}, "/" + std::string(120, 'x')}) {
    try {
      const Supervisor manager{name, std::nullopt};
      ADD_FAILURE() << name;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("NOTIFY_SOCKET is " + name));
    }
  }
}

}  // namespace
}  // namespace trivela::nodes
