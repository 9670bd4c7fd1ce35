// Two clocks compared over a network that delays, loses and reorders; the truth is the test's own.
#include "robot/team/clock_exchange.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "robot/team/peer_table.hpp"
#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

constexpr std::int64_t kS = 1'000'000'000;

TEST(ClockExchange, TheHandCase) {
  // The other is 50 ms ahead; his message takes 3 ms, ours 5 ms.
  ClockExchange clocks;
  clocks.received({.sent_t_ns = 1050 * kMs, .received_t_ns = 1003 * kMs});
  EXPECT_FALSE(clocks.estimate(1003 * kMs)) << "one direction says nothing";
  clocks.told({.sent_t_ns = 1000 * kMs, .received_t_ns = 1055 * kMs});
  const auto estimate = clocks.estimate(1003 * kMs);
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->offset_ns, 51 * kMs) << "wrong by half the difference of the two ways";
  EXPECT_EQ(estimate->error_ns, 4 * kMs + 150) << "half the round trip, and 3 ms at 50 ppm";
}

TEST(ClockExchange, TheQuickestOfEachDirectionCounts) {
  ClockExchange clocks;
  clocks.received({.sent_t_ns = 0, .received_t_ns = 9 * kMs});
  clocks.received({.sent_t_ns = 100 * kMs, .received_t_ns = 101 * kMs});
  clocks.told({.sent_t_ns = 0, .received_t_ns = kMs});
  clocks.told({.sent_t_ns = 100 * kMs, .received_t_ns = 115 * kMs});
  const auto estimate = clocks.estimate(120 * kMs);
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->offset_ns, 0);
  EXPECT_LT(estimate->error_ns, kMs + 10'000);
  EXPECT_EQ(clocks.quickest(120 * kMs)->sent_t_ns, 100 * kMs);
}

TEST(ClockExchange, AClockThatWasSetIsForgotten) {
  ClockExchange clocks;
  clocks.received({.sent_t_ns = 1000 * kMs, .received_t_ns = 1001 * kMs});
  clocks.told({.sent_t_ns = 1000 * kMs, .received_t_ns = 1001 * kMs});
  ASSERT_TRUE(clocks.estimate(1002 * kMs));
  clocks.received({.sent_t_ns = 3000 * kMs, .received_t_ns = 1101 * kMs});  // two seconds ahead all at once
  EXPECT_FALSE(clocks.estimate(1102 * kMs));
  clocks.received({.sent_t_ns = 3100 * kMs, .received_t_ns = 1201 * kMs});
  clocks.told({.sent_t_ns = 1200 * kMs, .received_t_ns = 3100 * kMs});
  ASSERT_TRUE(clocks.estimate(1202 * kMs));
  EXPECT_EQ(clocks.estimate(1202 * kMs)->offset_ns, 1899 * kMs + kMs / 2);
}

TEST(ClockExchange, WhatIsOlderThanTheWindowCountsNoMore) {
  ClockExchange clocks;
  clocks.received({.sent_t_ns = 0, .received_t_ns = kMs});
  clocks.told({.sent_t_ns = 0, .received_t_ns = kMs});
  EXPECT_TRUE(clocks.estimate(ClockExchange::kWindow_ns));
  EXPECT_FALSE(clocks.estimate(ClockExchange::kWindow_ns + 2 * kMs));
}

TEST(ClockExchange, WhatIsNoInstantIsPassedOver) {
  ClockExchange clocks;
  constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t t_ns : {kLeast, std::int64_t{-1}, kMost}) {
    clocks.received({.sent_t_ns = t_ns, .received_t_ns = kMs});
    clocks.told({.sent_t_ns = kMs, .received_t_ns = t_ns});
  }
  EXPECT_FALSE(clocks.quickest(kMs));
  EXPECT_FALSE(clocks.estimate(kMs));
}

/// A participant with its peers and clock: reading = rate * true time + ahead.
struct Participant {
  double rate;
  std::int64_t ahead_ns;
  PeerTable peers;
  std::int64_t reads(std::int64_t true_ns) const {
    return static_cast<std::int64_t>(std::llround(rate * static_cast<double>(true_ns))) + ahead_ns;
  }
};

struct Flying {
  std::int64_t arrives_ns;
  std::size_t to;
  msg::TeamState state;
};

/// The worst that the estimates between any two of `participants` were off, after the first five seconds, half a
/// window; each must lie within its own error.
std::int64_t worst_offset(std::vector<Participant>& participants, double loss, std::int64_t jitter_ns,
                          std::int64_t length_ns, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share{0.0, 1.0};
  std::vector<Flying> air;
  std::int64_t worst_ns = 0;
  for (std::int64_t t = 0; t < length_ns; t += 5 * kMs) {
    std::erase_if(air, [&](const Flying& message) {
      if (message.arrives_ns > t) return false;
      Participant& to = participants[message.to];
      to.peers.received(message.state, to.reads(message.arrives_ns));
      return true;
    });
    for (std::size_t i = 0; i < participants.size(); ++i) {
      if ((t / (5 * kMs) + static_cast<std::int64_t>(3 * i)) % 20 != 0) continue;  // 10 Hz each
      msg::TeamState state{};
      participants[i].peers.fill(state, participants[i].reads(t));
      for (std::size_t to = 0; to < participants.size(); ++to) {
        const double taken = 0.2 * kMs + share(random) * static_cast<double>(jitter_ns);
        if (to != i && share(random) >= loss) air.push_back({t + std::llround(taken), to, state});
      }
    }
    if (t < 5 * kS) continue;
    for (Participant& one : participants)
      for (std::size_t k = 0; k < participants.size(); ++k) {
        Participant& other = participants[k];
        if (&one == &other) continue;
        const auto estimate = one.peers.offset(static_cast<std::uint8_t>(k), one.reads(t));
        if (!estimate) continue;
        const std::int64_t off_ns = std::abs(estimate->offset_ns - (other.reads(t) - one.reads(t)));
        EXPECT_LE(off_ns, estimate->error_ns) << "at " << t << " from clock to clock " << k;
        worst_ns = std::max(worst_ns, off_ns);
      }
  }
  return worst_ns;
}

TEST(ClockExchange, SixClocksFiftyMillisecondsApartAreWithinFiveAtTwentyMillisecondsOfJitterAndLoss) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    std::mt19937_64 random{seed};
    std::uniform_int_distribution<std::int64_t> skew{-50 * kMs, 50 * kMs};
    std::uniform_real_distribution<double> drift{-20e-6, 20e-6};
    std::vector<Participant> participants;
    for (std::uint8_t number = 0; number < 6; ++number) {
      Participant one{1.0 + drift(random), 100 * kS + skew(random), PeerTable{number, 0}};
      participants.push_back(std::move(one));
    }
    EXPECT_LT(worst_offset(participants, 0.1, 20 * kMs, 30 * kS, random), 5 * kMs) << "seed " << seed;
  }
}

TEST(ClockExchange, AClockHoursAheadIsAsGood) {
  std::mt19937_64 random{7};
  std::vector<Participant> participants{{1.0, kS, PeerTable{0, 0}}, {1.0, 20'000 * kS, PeerTable{1, 0}}};
  EXPECT_LT(worst_offset(participants, 0.0, 20 * kMs, 20 * kS, random), 5 * kMs);
}

}  // namespace
}  // namespace trivela::robot
