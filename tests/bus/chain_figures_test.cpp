// What the chain benchmark computes of what it measured.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/bench/chain/goals.hpp"
#include "tests/bench/chain/processor_time.hpp"

namespace trivela::bench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ProcessorTime time_of(const std::string& line) {
  std::istringstream stat(line);
  return processor_time(stat);
}

Row row(const char* contender, std::int64_t ns, bool loaded = false, bool realtime = false) {
  return {.rate_hz = 100,
          .loaded = loaded,
          .realtime = realtime,
          .busy = 0.0,
          .contender = contender,
          .reference = {},
          .sent = 3,
          .latencies_ns = {ns - 1, ns, ns + 1}};
}

TEST(ProcessorTime, WaitingIsNotUsed) {
  const ProcessorTime before = time_of("cpu  100 0 50 800 40 5 5 0 0 0\ncpu0 1 2");
  EXPECT_EQ(before.used, 160);
  EXPECT_EQ(before.total, 1000);
  EXPECT_DOUBLE_EQ(busy_share(before, time_of("cpu  160 0 60 920 50 5 5 0 0 0")), 0.35);
  EXPECT_EQ(busy_share(before, before), 0.0);
}

TEST(ProcessorTime, AnotherTextIsRefused) {
  for (const char* text : {"", "cpu0 1 2 3 4 5 6 7 8", "cpu 1 2 3", "cpu a b c d e f g h"})
    EXPECT_THROW(time_of(text), std::runtime_error) << text;
  const ProcessorTime now = processor_time();
  EXPECT_GT(now.total, now.used);
}

TEST(ChainGoals, AreMetByRatiosAtTheirBounds) {
  EXPECT_THAT(missed_goals({row(kUdp, 100'000), row(kBare, 140'000), row(kListener, 150'000), row(kSecured, 225'000),
                            row(kBareOne, 10'000), row(kOne, 11'000)}),
              IsEmpty());
  EXPECT_THAT(missed_goals({row(kListener, 100'000)}), IsEmpty()) << "alone there is nothing to compare";
}

TEST(ChainGoals, EachThatIsMissedIsNamed) {
  EXPECT_THAT(missed_goals({row(kUdp, 100'000), row(kBare, 100'000), row(kListener, 160'000)}),
              ElementsAre(HasSubstr("1.60 x Cyclone, 4 processes"), HasSubstr("1.60 x UDP, 4 processes")));
  EXPECT_THAT(missed_goals({row(kListener, 100'000), row(kSecured, 151'000)}), ElementsAre(HasSubstr("1.51 x DDS")));
  EXPECT_THAT(missed_goals({row(kBareOne, 10'000), row(kOne, 11'500)}), ElementsAre(HasSubstr("1.15 x Cyclone")));
}

TEST(ChainGoals, UnderLoadCountsWithSchedFifoAlone) {
  EXPECT_THAT(missed_goals({row(kListener, 100'000), row(kListener, 900'000, true)}), IsEmpty());
  EXPECT_THAT(missed_goals({row(kListener, 100'000, false, true), row(kListener, 151'000, true, true)}),
              ElementsAre(HasSubstr("SCHED_FIFO: 1.51 x idle at quantile 0.99")));
}

TEST(ChainGoals, AChainOfWhichNothingArrivedIsNotMet) {
  Row silent = row(kListener, 1);
  silent.latencies_ns.clear();
  EXPECT_THAT(missed_goals({row(kBare, 100'000), silent}), ElementsAre(HasSubstr("nan x Cyclone")));
}

TEST(ChainTable, ARowIsComparedWithItsReference) {
  Row ours = row(kOne, 12'000);
  ours.reference = kBareOne;
  EXPECT_DOUBLE_EQ(times_reference(ours, {row(kBareOne, 10'000), ours}), 1.2);
  EXPECT_TRUE(std::isnan(times_reference(ours, {ours})));
}

}  // namespace
}  // namespace trivela::bench
