#include "bus/silence_watch.hpp"

#include <gtest/gtest.h>

namespace trivela::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const SilenceWatch::Time kStart{seconds{1000}};

TEST(SilenceWatch, IsDueAfterHalfASecondAndThenEachTimeAfterTwiceAsLongUpToTenSeconds) {
  SilenceWatch watch{milliseconds{20}, kStart};
  EXPECT_FALSE(watch.due(kStart + milliseconds{499}));
  auto now = kStart;
  for (const auto wait : {milliseconds{500}, milliseconds{1000}, milliseconds{2000}, milliseconds{4000},
                          milliseconds{8000}, milliseconds{10'000}, milliseconds{10'000}}) {
    EXPECT_FALSE(watch.due(now + wait - milliseconds{1}));
    EXPECT_TRUE(watch.due(now += wait));
  }
  EXPECT_EQ(watch.attempts(), 7u);
  EXPECT_EQ(watch.silent_for(now), now - kStart);
}

TEST(SilenceWatch, BeginsAnewOnceSomethingIsHeard) {
  SilenceWatch watch{milliseconds{20}, kStart};
  EXPECT_TRUE(watch.due(kStart + seconds{1}));
  watch.heard(kStart + seconds{2});
  EXPECT_EQ(watch.attempts(), 0u);
  EXPECT_FALSE(watch.due(kStart + seconds{2} + milliseconds{499}));
  EXPECT_TRUE(watch.due(kStart + seconds{2} + milliseconds{500}));
}

TEST(SilenceWatch, WaitsForManyPeriodsOfASlowTopic) {
  SilenceWatch watch{milliseconds{200}, kStart};
  EXPECT_FALSE(watch.due(kStart + milliseconds{4999}));
  EXPECT_TRUE(watch.due(kStart + milliseconds{5000}));
}

}  // namespace
}  // namespace trivela::bus
