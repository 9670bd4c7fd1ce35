#include "robot/watch/silence_watch.hpp"

#include <gmock/gmock.h>

#include <random>

#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::int64_t kPeriod = 20 * kMs;

class SilenceWatchTest : public testing::Test {
 protected:
  /// Looks every period up to `now` and returns what was seen.
  std::vector<SilenceEdge> look_until(std::int64_t now) {
    std::vector<SilenceEdge> seen;
    for (; looked_ns <= now; looked_ns += kPeriod)
      for (const SilenceEdge& edge : watch.look(looked_ns)) seen.push_back(edge);
    return seen;
  }

  SilenceWatch watch{kPeriod};
  std::size_t odometry = watch.add(kPeriod);
  std::int64_t looked_ns = 0;
};

TEST_F(SilenceWatchTest, AStreamThatWasNeverHeardIsNotSilent) { EXPECT_THAT(look_until(10'000 * kMs), IsEmpty()); }

TEST_F(SilenceWatchTest, AStreamThatComesOnTimeIsNotSilent) {
  for (std::int64_t t = 0; t < 5'000 * kMs; t += kPeriod) {
    watch.received(odometry, 1, t);
    EXPECT_THAT(look_until(t), IsEmpty());
  }
}

TEST_F(SilenceWatchTest, MoreThanThreePeriodsAreASilenceWithItsLastAndItsFirstSample) {
  look_until(80 * kMs);
  watch.received(odometry, 1, 100 * kMs);
  EXPECT_THAT(look_until(160 * kMs), IsEmpty());
  const auto began = look_until(240 * kMs);
  ASSERT_THAT(began, SizeIs(1));
  EXPECT_EQ(began[0].robot_id, 1);
  EXPECT_EQ(began[0].from_ns, 100 * kMs);
  EXPECT_FALSE(began[0].to_ns);
  EXPECT_THAT(look_until(1'000 * kMs), IsEmpty()) << "it is said once";
  watch.received(odometry, 1, 1'010 * kMs);
  const auto ended = look_until(1'020 * kMs);
  ASSERT_THAT(ended, SizeIs(1));
  EXPECT_EQ(ended[0].from_ns, 100 * kMs);
  EXPECT_EQ(ended[0].to_ns, 1'010 * kMs);
  EXPECT_FALSE(ended[0].was_delay());
}

TEST_F(SilenceWatchTest, RobotsAndStreamsAreSilentEachForItself) {
  const std::size_t referee = watch.add(5 * kPeriod);
  for (const std::uint8_t robot : {1, 2}) {
    watch.received(odometry, robot, 0);
    watch.received(referee, robot, 0);
  }
  for (std::int64_t t = 0; t < 200 * kMs; t += kPeriod) {
    watch.received(odometry, 2, t);
    for (const SilenceEdge& edge : look_until(t)) {
      EXPECT_EQ(edge.stream, odometry);
      EXPECT_EQ(edge.robot_id, 1);
    }
  }
}

TEST_F(SilenceWatchTest, AGapThatNoLookSawIsASilenceThatEnded) {
  watch.received(odometry, 1, 0);
  watch.received(odometry, 1, 80 * kMs);
  const auto seen = watch.look(80 * kMs);
  ASSERT_THAT(seen, SizeIs(1));
  EXPECT_EQ(seen[0].from_ns, 0);
  EXPECT_EQ(seen[0].to_ns, 80 * kMs);
}

TEST_F(SilenceWatchTest, TheLastSampleOnceMoreIsNoNews) {
  watch.received(odometry, 1, 0);
  ASSERT_THAT(look_until(200 * kMs), SizeIs(1));
  watch.received(odometry, 1, 0);
  EXPECT_THAT(look_until(400 * kMs), IsEmpty());
  watch.received(odometry, 1, 410 * kMs);
  EXPECT_EQ(watch.look(420 * kMs).at(0).from_ns, 0);
}

TEST_F(SilenceWatchTest, SamplesThatCameLateButAllAreADelay) {
  watch.received(odometry, 1, 0);
  ASSERT_THAT(look_until(200 * kMs), SizeIs(1));
  for (int i = 1; i <= 10; ++i) watch.received(odometry, 1, i * kPeriod);
  const auto ended = watch.look(220 * kMs);
  ASSERT_THAT(ended, SizeIs(1));
  EXPECT_TRUE(ended[0].was_delay());
}

TEST_F(SilenceWatchTest, AProcessThatStoodStillCallsNobodySilent) {
  watch.received(odometry, 1, 0);
  look_until(0);
  EXPECT_THAT(watch.look(5'000 * kMs), IsEmpty());
  watch.received(odometry, 1, 5'000 * kMs - 10 * kMs);
  EXPECT_THAT(watch.look(5'020 * kMs), SizeIs(1)) << "what did not arrive meanwhile is missing all the same";
}

/// A stream each 10 ms, looked at no sooner than is said.
class SparseLooksTest : public SilenceWatchTest {
 protected:
  static constexpr std::int64_t kCycle = 10 * kMs, kMost = 100 * kMs;

  /// Samples until `end`; the instants of the looks.
  std::vector<std::int64_t> hear_until(std::int64_t end) {
    std::vector<std::int64_t> looks;
    for (; now_ns < end; now_ns += kMs) {
      if (now_ns % kCycle == 0) watch.received(odometry, 1, now_ns, now_ns);
      if (now_ns < due_ns) continue;
      EXPECT_THAT(watch.look(now_ns), IsEmpty());
      looks.push_back(now_ns);
      due_ns = now_ns + watch.pause_ns(kMost);
    }
    return looks;
  }

  std::int64_t now_ns = 0, due_ns = 0;
};

TEST_F(SparseLooksTest, WhileAStreamGoesOnThereIsHardlyALookInThreePeriods) {
  EXPECT_LE(hear_until(1'000 * kMs).size(), 20u);
}

TEST_F(SparseLooksTest, WhenItEndsThatIsSeenWithinThreePeriodsAndAStep) {
  for (std::int64_t end = 500 * kMs; end < 560 * kMs; end += kMs) {
    hear_until(end);
    const std::int64_t last_ns = (end - 1) / kCycle * kCycle;
    std::vector<SilenceEdge> seen;
    std::int64_t noticed_ns = 0;
    for (; seen.empty(); due_ns += watch.pause_ns(kMost)) seen = watch.look(noticed_ns = due_ns);
    EXPECT_EQ(seen[0].from_ns, last_ns);
    EXPECT_GT(noticed_ns - last_ns, 3 * kPeriod);
    EXPECT_LE(noticed_ns - last_ns, 4 * kPeriod);
    watch = SilenceWatch{kPeriod};
    watch.add(kPeriod);
    now_ns = due_ns = 0;
  }
}

TEST_F(SparseLooksTest, AProcessThatStoodStillCallsNobodySilent) {
  hear_until(500 * kMs);
  EXPECT_THAT(watch.look(due_ns + 5'000 * kMs), IsEmpty());
  EXPECT_EQ(watch.pause_ns(kMost), kPeriod) << "what did not arrive meanwhile is missing soon";
}

// Any gaps, looks that are never later than two steps: what lasts longer than three periods and the looks' grain is
// seen to begin and to end at its own samples, what is shorter than three periods never.
TEST(SilenceWatch, SeesEveryLongGapAndNoShortOne) {
  std::mt19937_64 random{7};
  for (int run = 0; run < 200; ++run) {
    SilenceWatch watch{kPeriod};
    const std::size_t stream = watch.add(kPeriod);
    std::int64_t now = 0, look = 0, received = -1;
    std::optional<std::int64_t> open;
    for (int sample = 0; sample < 100; ++sample) {
      const std::int64_t gap =
          std::uniform_int_distribution<std::int64_t>{1, (random() % 4 == 0 ? 20 : 3) * kPeriod}(random);
      const std::int64_t next = received < 0 ? 0 : received + gap;
      bool began = open.has_value(), ended = false;
      const auto take = [&](const std::vector<SilenceEdge>& edges) {
        for (const SilenceEdge& edge : edges) {
          EXPECT_EQ(edge.from_ns, received);
          if (!edge.to_ns) {
            EXPECT_FALSE(began);
            began = true;
          } else {
            EXPECT_EQ(*edge.to_ns, next);
            ended = true;
          }
        }
      };
      for (; look < next; look += 1 + static_cast<std::int64_t>(random() % (2 * kPeriod))) take(watch.look(look));
      watch.received(stream, 1, next);
      now = std::max(look, next);
      if (received >= 0) {
        take(watch.look(now));
        EXPECT_EQ(ended, gap > kSilentPeriods * kPeriod);
        if (gap > (kSilentPeriods + 4) * kPeriod) {
          EXPECT_TRUE(began);
        }
        if (began) {
          EXPECT_TRUE(ended);
        }
      }
      open.reset();
      received = next;
    }
  }
}

class SilenceLinesTest : public testing::Test {
 protected:
  void began(std::int64_t from_ms) { lines.note({0, 1, 60 * kMs, from_ms * kMs, {}}, "odometry"); }
  void ended(std::int64_t from_ms, std::int64_t to_ms) {
    lines.note({0, 1, 60 * kMs, from_ms * kMs, to_ms * kMs}, "odometry");
  }
  SilenceLines lines;
};

TEST_F(SilenceLinesTest, ASilenceHasALineAtEachEndWithItsAge) {
  began(1'000);
  EXPECT_THAT(lines.due(1'064 * kMs), ElementsAre("no odometry for 0.06 s"));
  EXPECT_THAT(lines.due(1'100 * kMs), IsEmpty());
  ended(1'000, 2'240);
  EXPECT_THAT(lines.due(2'250 * kMs), ElementsAre("odometry back after 1.24 s"));
}

TEST_F(SilenceLinesTest, AStreamThatComesAndGoesMakesTwoLinesASecondAtMost) {
  std::size_t said = 0;
  for (std::int64_t t = 0; t < 10'000; t += 100) {
    began(t);
    said += lines.due((t + 70) * kMs).size();
    ended(t, t + 80);
    said += lines.due((t + 90) * kMs).size();
  }
  EXPECT_LE(said, 22u);
  EXPECT_GE(said, 18u);
}

TEST_F(SilenceLinesTest, ASilenceThatWasKeptQuietIsSaidWhereItLasts) {
  began(0);
  EXPECT_THAT(lines.due(70 * kMs), SizeIs(1));
  ended(0, 100);
  EXPECT_THAT(lines.due(110 * kMs), SizeIs(1));
  began(110);
  EXPECT_THAT(lines.due(200 * kMs), IsEmpty());
  ended(110, 200);
  began(200);
  EXPECT_THAT(lines.due(300 * kMs), IsEmpty());
  EXPECT_THAT(lines.due(1'200 * kMs), ElementsAre("no odometry for 1.00 s, and 1 shorter silences before"));
}

TEST_F(SilenceLinesTest, AnEndWithoutABeginningIsNotSaid) {
  ended(0, 500);
  EXPECT_THAT(lines.due(500 * kMs), IsEmpty());
}

}  // namespace
}  // namespace trivela::robot
