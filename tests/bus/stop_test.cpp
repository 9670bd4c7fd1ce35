#include "bus/stop.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <csignal>
#include <future>
#include <thread>

namespace trivela::bus {
namespace {

TEST(Stop, WaitReturnsOnceItIsRequested) {
  Stop stop;
  EXPECT_FALSE(stop.requested());
  std::thread requester([&] { stop.request(); });
  stop.wait();
  requester.join();
  EXPECT_TRUE(stop.requested());
  stop.request();
  stop.wait();  // stays requested
}

TEST(Stop, AWaitWithAnEndIsOverThenOrOnceItIsRequested) {
  Stop stop;
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(20);
  EXPECT_FALSE(stop.wait_until(end));
  EXPECT_GE(std::chrono::steady_clock::now(), end);
  EXPECT_FALSE(stop.wait_until(end)) << "in the past";
  std::thread requester([&] { stop.request(); });
  EXPECT_TRUE(stop.wait_until(std::chrono::steady_clock::now() + std::chrono::hours(1)));
  requester.join();
}

TEST(Stop, ASignalRequestsItFromItsHandler) {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    Stop stop;
    {
      const StopOnSignals on_signals(stop);
      raise(signal);
    }
    EXPECT_TRUE(stop.requested());
  }
}

TEST(Stop, ASignalWakesAThreadThatWaits) {
  Stop stop;
  const StopOnSignals on_signals(stop);
  std::promise<void> begun;
  std::thread waiting([&] {
    begun.set_value();  // the thread sanitizer drops signals of a thread that has not
    stop.wait();
  });
  begun.get_future().wait();
  pthread_kill(waiting.native_handle(), SIGINT);
  waiting.join();
  EXPECT_TRUE(stop.requested());
}

TEST(StopDeathTest, AProcessThatHangsAfterASignalIsEndedAtTheLimit) {
  const auto hang = [] {
    Stop stop;
    const StopOnSignals on_signals(stop, std::chrono::seconds{1});
    raise(SIGTERM);
    for (;;) pause();
  };
  EXPECT_EXIT(hang(), testing::KilledBySignal(SIGALRM), "");
}

TEST(Stop, NoAlarmIsLeftBehindByAStopInTime) {
  Stop stop;
  {
    const StopOnSignals on_signals(stop);
    raise(SIGTERM);
  }
  EXPECT_EQ(alarm(0), 0U);
}

TEST(Stop, UnderNohupTheEndOfTheTerminalIsNoStop) {
  std::signal(SIGHUP, SIG_IGN);
  Stop stop;
  {
    const StopOnSignals on_signals(stop);
    raise(SIGHUP);
  }
  std::signal(SIGHUP, SIG_DFL);
  EXPECT_FALSE(stop.requested());
}

TEST(Stop, TheFormerHandlersComeBack) {
  struct sigaction before {
  }, after{};
  sigaction(SIGTERM, nullptr, &before);
  {
    Stop stop;
    const StopOnSignals on_signals(stop);
  }
  sigaction(SIGTERM, nullptr, &after);
  EXPECT_EQ(before.sa_handler, after.sa_handler);
}

}  // namespace
}  // namespace trivela::bus
