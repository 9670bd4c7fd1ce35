#include "nodes/runtime/flood_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

namespace trivela::nodes {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

constexpr milliseconds kPollInterval{2}, kGrace{20};
constexpr std::uint32_t kNoLimit_mb = 100'000;

void tell(const std::string& why) { std::fprintf(stderr, "%s\n", why.c_str()); }

TEST(FloodWatch, EndsAProcessThatDoesNotStopWhenToldTo) {
  const auto grow = [] {
    bus::Stop stop;
    const FloodWatch watch{1, stop, tell, kPollInterval, kGrace};
    for (;;) pause();
  };
  EXPECT_EXIT(grow(), testing::ExitedWithCode(1), "takes .* MB of memory, more than run.memory_limit_mb = 1: ends");
}

TEST(FloodWatch, RequestsTheStopBeyondItsLimitAndSaysWhatTheProcessTook) {
  bus::Stop stop;
  std::string told;
  {
    const FloodWatch watch{1, stop, [&told](const std::string& why) { told = why; }, kPollInterval};
    stop.wait();
    EXPECT_TRUE(watch.ended());
  }
  EXPECT_THAT(told, HasSubstr("more than run.memory_limit_mb = 1: ends, to be started again"));
}

TEST(FloodWatch, LeavesAProcessBelowItsLimitAlone) {
  bus::Stop stop;
  const FloodWatch watch{kNoLimit_mb, stop, tell, kPollInterval, kGrace};
  EXPECT_FALSE(stop.wait_until(std::chrono::steady_clock::now() + 50 * kPollInterval));
  EXPECT_FALSE(watch.ended());
}

/// A thread that is called as that of the library's handshakes, and turns.
template <class Deadline>
std::jthread handshakes(Deadline turn) {
  return std::jthread{[turn](const std::stop_token& over) {
    pthread_setname_np(pthread_self(), FloodWatch::kHandshakes);
    while (!over.stop_requested()) turn();
  }};
}

TEST(FloodWatch, EndsAProcessWhoseHandshakesDoNotComeRound) {
  const auto turn = [] {
    bus::Stop stop;
    const FloodWatch watch{kNoLimit_mb, stop, tell, kPollInterval, kGrace};
    const std::jthread stuck = handshakes([] {});
    for (;;) pause();
  };
  EXPECT_EXIT(turn(), testing::ExitedWithCode(1), "the thread of handshakes does not come round");
}

TEST(FloodWatch, LeavesHandshakesThatWaitNowAndThenAlone) {
  bus::Stop stop;
  const FloodWatch watch{kNoLimit_mb, stop, tell, kPollInterval, kGrace};
  const std::jthread busy = handshakes([&stop] {
    const auto now = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() < now + 3 * kPollInterval) {
    }
    stop.wait_until(std::chrono::steady_clock::now() + kPollInterval);
  });
  EXPECT_FALSE(stop.wait_until(std::chrono::steady_clock::now() + 100 * kPollInterval));
  EXPECT_FALSE(watch.ended());
}

#ifndef TRIVELA_SANITIZE  // whose allocator keeps what is freed on purpose
/// All but the 32 MB from which on it is looked for.
TEST(FloodWatch, GivesBackWhatAFloodLeftInPieces) {
  constexpr std::int64_t kMb = 1 << 20;
  bus::Stop stop;
  const FloodWatch watch{kNoLimit_mb, stop, tell, kPollInterval, kGrace};
  const std::int64_t before = resident_bytes();
  std::vector<std::vector<char>> blocks;
  for (int i = 0; i < 100'000; ++i) blocks.emplace_back(1000, 'x');
  EXPECT_GT(resident_bytes(), before + 90 * kMb);
  for (std::size_t i = 0; i + 1 < blocks.size(); ++i)
    std::vector<char>().swap(blocks[i]);  // the last keeps all below it
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds{30};
  while (resident_bytes() > before + 40 * kMb && !stop.wait_until(std::chrono::steady_clock::now() + kPollInterval))
    ASSERT_LT(std::chrono::steady_clock::now(), end) << (resident_bytes() - before) / kMb << " MB stayed";
}
#endif

}  // namespace
}  // namespace trivela::nodes
