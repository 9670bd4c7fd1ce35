#include "nodes/simulator/recent_receipts.hpp"

#include <gtest/gtest.h>

#include "tests/instants.hpp"

namespace trivela::nodes {
namespace {

TEST(RecentReceipts, APulseIsTheKickWhoseReceiptIsTheNearest) {
  RecentReceipts recent;
  recent.accepted(7, 1000 * kMs);
  recent.accepted(8, 1600 * kMs);
  EXPECT_EQ(recent.take(1001 * kMs), 7);
  EXPECT_EQ(recent.take(1598 * kMs), 8);
}

TEST(RecentReceipts, AReceiptIsOfOnePulse) {
  RecentReceipts recent;
  recent.accepted(7, 1000 * kMs);
  EXPECT_EQ(recent.take(1000 * kMs), 7);
  EXPECT_EQ(recent.take(1001 * kMs), std::nullopt);
}

TEST(RecentReceipts, AKickThatWasCalledOffIsNoPulses) {
  RecentReceipts recent;
  recent.accepted(7, 1000 * kMs);  // of which no pulse came
  recent.accepted(8, 1600 * kMs);
  EXPECT_EQ(recent.take(1610 * kMs), 8);
  EXPECT_EQ(recent.take(1000 * kMs), std::nullopt);
}

TEST(RecentReceipts, APulseThatIsFarFromAnyReceiptIsNobodys) {
  RecentReceipts recent;
  EXPECT_EQ(recent.take(1000 * kMs), std::nullopt);
  recent.accepted(7, 1000 * kMs);
  EXPECT_EQ(recent.take(1000 * kMs + RecentReceipts::kFarthest_ns + 1), std::nullopt);
  EXPECT_EQ(recent.take(1000 * kMs + RecentReceipts::kFarthest_ns), 7);
}

}  // namespace
}  // namespace trivela::nodes
