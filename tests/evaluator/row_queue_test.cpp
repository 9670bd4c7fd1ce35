// When the thread that writes is given its rows.
#include "log/write/row_queue.hpp"

#include <gtest/gtest.h>
#include <poll.h>

namespace trivela::log {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

Row row() { return {}; }

TEST(RowQueue, RowsThatCameDuringACommitHaveWaitedAlready) {
  RowQueue queue{100};
  std::vector<Row> group;
  ASSERT_TRUE(queue.push(row()));
  ASSERT_TRUE(queue.take(group, 0ms));
  const auto before = Clock::now();
  ASSERT_TRUE(queue.push(row()));  // while the group above is being committed
  const auto after = Clock::now();
  poll(nullptr, 0, 1000);  // which takes its time
  group.clear();
  const auto committed = Clock::now();
  const auto first = queue.take(group, 1s);
  EXPECT_LT(Clock::now() - committed, 900ms) << "the wait began again";
  ASSERT_TRUE(first);
  EXPECT_GE(*first, before);
  EXPECT_LE(*first, after);
  EXPECT_EQ(group.size(), 1u);
}

TEST(RowQueue, AGroupIsCollectedForTheWaitFromItsFirstRow) {
  RowQueue queue{100};
  std::vector<Row> group;
  ASSERT_TRUE(queue.push(row()));
  ASSERT_TRUE(queue.push(row()));
  const auto first = queue.take(group, 50ms);
  ASSERT_TRUE(first);
  EXPECT_GE(Clock::now() - *first, 50ms);
  EXPECT_EQ(group.size(), 2u);
}

TEST(RowQueue, AClosedQueueGivesTheRestAtOnceAndThenNothing) {
  RowQueue queue{100};
  std::vector<Row> group;
  ASSERT_TRUE(queue.push(row()));
  queue.close();
  EXPECT_FALSE(queue.push(row()));
  EXPECT_TRUE(queue.take(group, 1h));
  EXPECT_EQ(group.size(), 1u);
  group.clear();
  EXPECT_FALSE(queue.take(group, 1h));
}

}  // namespace
}  // namespace trivela::log
