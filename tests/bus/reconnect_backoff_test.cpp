#include "bus/reconnect_backoff.hpp"

#include <gtest/gtest.h>

namespace trivela::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const ReconnectBackoff::Time kStart{seconds{1000}};

/// Looks ten times a second from `from` on; whether it was due at any look before `to`, and at `to` itself.
struct Due {
  bool before = false;
  bool then = false;
};
Due due_between(ReconnectBackoff& watch, ReconnectBackoff::Time from, ReconnectBackoff::Time to) {
  Due due;
  for (auto now = from; now < to; now += milliseconds{100}) due.before = watch.due(now) || due.before;
  due.then = watch.due(to);
  return due;
}

TEST(ReconnectBackoff, IsDueAfterHalfASecondAndThenEachTimeAfterTwiceAsLongUpToTenSeconds) {
  ReconnectBackoff watch{ReconnectBackoff::of_period(milliseconds{20})};
  auto now = kStart;
  for (const auto wait : {milliseconds{500}, milliseconds{1000}, milliseconds{2000}, milliseconds{4000},
                          milliseconds{8000}, milliseconds{10'000}, milliseconds{10'000}}) {
    const Due due = due_between(watch, now, now + wait);
    EXPECT_FALSE(due.before) << wait.count();
    EXPECT_TRUE(due.then) << wait.count();
    now += wait;
  }
  EXPECT_EQ(watch.attempts(), 7u);
  EXPECT_EQ(watch.silent_for(now), now - kStart);
}

TEST(ReconnectBackoff, BeginsAnewOnceSomethingIsHeard) {
  ReconnectBackoff watch{ReconnectBackoff::of_period(milliseconds{20})};
  EXPECT_TRUE(due_between(watch, kStart, kStart + milliseconds{500}).then);
  watch.received(kStart + milliseconds{600});
  EXPECT_EQ(watch.attempts(), 0u);
  const Due due = due_between(watch, kStart + milliseconds{600}, kStart + milliseconds{1100});
  EXPECT_FALSE(due.before);
  EXPECT_TRUE(due.then);
}

TEST(ReconnectBackoff, WaitsForManyPeriodsOfASlowTopic) {
  ReconnectBackoff watch{ReconnectBackoff::of_period(milliseconds{200})};
  const Due due = due_between(watch, kStart, kStart + milliseconds{5000});
  EXPECT_FALSE(due.before);
  EXPECT_TRUE(due.then);
}

TEST(ReconnectBackoff, TimeInWhichThisProcessStoodStillIsNobodysSilence) {
  ReconnectBackoff watch{ReconnectBackoff::of_period(milliseconds{20})};
  EXPECT_FALSE(watch.due(kStart));
  EXPECT_FALSE(watch.due(kStart + milliseconds{100}));
  EXPECT_FALSE(watch.due(kStart + seconds{3})) << "nobody looked for 2.9 s";
  EXPECT_TRUE(watch.due(kStart + milliseconds{3100})) << "and still nothing comes";
}

TEST(ReconnectBackoff, ANodeThatHasNotBegunToLookHasHeardNothingYet) {
  ReconnectBackoff watch{ReconnectBackoff::of_period(milliseconds{20})};
  EXPECT_FALSE(watch.due(kStart)) << "whenever that is";
  EXPECT_FALSE(watch.due(kStart + milliseconds{300}));
  EXPECT_FALSE(watch.due(kStart + milliseconds{499}));
  EXPECT_TRUE(watch.due(kStart + milliseconds{500}));
}

}  // namespace
}  // namespace trivela::bus
