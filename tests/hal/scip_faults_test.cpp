// Everything that can go wrong between a scanner and its client, on a real terminal and a real socket.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "emulators/scip/emulated_scanner.hpp"
#include "tests/hal/scip_link.hpp"

namespace trivela::hal::scip {
namespace {

using tests::Clock;
using tests::FaultyScanner;
using tests::milliseconds;
using tests::number_of;
using tests::ScipLink;

class ScipFaultsOn : public testing::TestWithParam<EmulatedPort> {
 protected:
  static EmulatorConfig config() {
    EmulatorConfig config;
    config.port = GetParam();
    config.geometry = tests::fast_geometry();
    return config;
  }
};

INSTANTIATE_TEST_SUITE_P(Scip, ScipFaultsOn, testing::Values(EmulatedPort::kTerminal, EmulatedPort::kTcp),
                         [](const auto& port) { return port.param == EmulatedPort::kTcp ? "Tcp" : "Terminal"; });

// Reads on until `counter` of the link stands at `value`, and then one scan more.
void expect_counted(ScipLink& link, std::uint64_t LinkCounters::*counter, std::uint64_t value) {
  EXPECT_TRUE(link.until([&] { return link.read(), link.finder().counters().*counter >= value; }));
  link.next();
  EXPECT_EQ(link.finder().counters().*counter, value);
}

// The next `replies` have this status and no data.
void refuse(ScipLink& link, const std::string& status, int replies) {
  link.emulator().set(&FaultyScanner::status, status);
  link.emulator().set(&FaultyScanner::statuses, replies);
}

TEST_P(ScipFaultsOn, AWrongSumCostsOneScan) {
  ScipLink link{config()};
  link.next();
  link.emulator().set(&FaultyScanner::sums_to_corrupt, 3);
  expect_counted(link, &LinkCounters::wrong_sums, 3);
  EXPECT_EQ(link.finder().counters().reconnects, 0U);
  EXPECT_EQ(link.finder().counters().torn_lines, 0U);
  EXPECT_GE(link.finder().counters().lost_scans, 3U);
}

TEST_P(ScipFaultsOn, ATornLineCostsOneScan) {
  ScipLink link{config()};
  link.next();
  link.emulator().set(&FaultyScanner::lines_to_tear, 3);
  expect_counted(link, &LinkCounters::torn_lines, 3);
  EXPECT_EQ(link.finder().counters().reconnects, 0U);
  EXPECT_EQ(link.finder().counters().wrong_sums, 0U);
  EXPECT_GE(link.finder().counters().lost_scans, 3U);
}

TEST_P(ScipFaultsOn, DamageCostsOneScanWhenAskedOneByOne) {
  ScipLink link{config(), Asking::kOneByOne};
  link.next();
  link.emulator().set(&FaultyScanner::sums_to_corrupt, 2);
  expect_counted(link, &LinkCounters::wrong_sums, 2);
  link.emulator().set(&FaultyScanner::lines_to_tear, 2);
  expect_counted(link, &LinkCounters::torn_lines, 2);
  EXPECT_EQ(link.finder().counters().reconnects, 0U);
}

TEST_P(ScipFaultsOn, AGapBetweenTheStampsIsLostScans) {
  auto slow = config();
  slow.geometry = {};
  ScipLink link{slow};
  const auto before = number_of(link.next());
  link.emulator().set(&FaultyScanner::scans_to_skip, 4);
  auto scan = link.next();
  while (number_of(scan) < before + 5) scan = link.next();
  EXPECT_EQ(number_of(scan) + 1 - link.finder().counters().scans, 4U);
  EXPECT_GE(link.finder().counters().lost_scans, 4U);
}

TEST_P(ScipFaultsOn, AStatusErrorIsCountedAndScansGoOn) {
  for (const Asking asking : {Asking::kContinuous, Asking::kOneByOne}) {
    ScipLink link{config(), asking};
    link.next();
    refuse(link, "21", 2);
    expect_counted(link, &LinkCounters::error_replies, 2);
    EXPECT_EQ(link.finder().counters().reconnects, 0U);
    EXPECT_EQ(link.finder().status(), "measuring");
  }
}

TEST_P(ScipFaultsOn, AScannerThatRefusesAtTheStartIsAskedAgain) {
  ScipLink link{config()};
  refuse(link, "0A", 4);  // QT, RS, SCIP2.0, VV
  link.next();
  EXPECT_EQ(link.finder().counters().error_replies, 3U);  // whatever a scanner says to SCIP2.0 is right
  EXPECT_EQ(link.finder().counters().reconnects, 1U);
}

TEST_P(ScipFaultsOn, APulledCableShowsWithinASecondAndThePluggedOneMeasuresAgain) {
  ScipLink link{config()};
  for (std::uint64_t times = 1; times <= 3; ++times) {
    link.next();
    link.emulator().line().pull();
    EXPECT_LE(link.until_down(), milliseconds(1000));
    EXPECT_NE(link.finder().status(), "measuring");
    for (int i = 0; i < 5; ++i) EXPECT_FALSE(link.read(milliseconds(100)));
    EXPECT_EQ(link.finder().status().find("no device " + link.emulator().address()), 0U) << link.finder().status();
    link.emulator().line().plug();
    link.next();
    EXPECT_TRUE(link.finder().up());
    EXPECT_EQ(link.finder().counters().reconnects, times);
  }
}

TEST_P(ScipFaultsOn, ACableThatIsPluggedLateIsFound) {
  EmulatorConfig emulated = config();
  ScipLink link{emulated};
  link.emulator().line().pull();
  EXPECT_FALSE(link.finder().connected(milliseconds(300)));
  link.emulator().line().plug();
  link.next();
  EXPECT_EQ(link.finder().counters().reconnects, 0U);
}

TEST_P(ScipFaultsOn, SilenceShowsWithinASecondAndEndsWithTheNextWord) {
  for (const Asking asking : {Asking::kContinuous, Asking::kOneByOne}) {
    ScipLink link{config(), asking};
    link.next();
    const auto before = link.finder().counters().time_outs;
    link.emulator().set(&FaultyScanner::silent, true);
    EXPECT_LE(link.until_down(), milliseconds(1000));
    EXPECT_EQ(link.finder().status(), link.emulator().address() + ": no scan for 0.5 s");
    EXPECT_EQ(link.finder().counters().time_outs, before + 1);
    EXPECT_TRUE(link.until([&] { return link.read(), link.finder().counters().time_outs >= before + 4; }));
    link.emulator().set(&FaultyScanner::silent, false);
    link.next();
    EXPECT_GE(link.finder().counters().reconnects, 1U);
    EXPECT_TRUE(link.finder().up());
  }
}

TEST_P(ScipFaultsOn, AReaderThatWasAwayLongerThanTheSilenceGoesOnWithoutReconnecting) {
  ScipLink link{config()};
  link.next();
  const auto sent = link.emulator().scans_sent();
  ASSERT_TRUE(link.until([&] { return link.emulator().scans_sent() > sent + 10; }));
  const auto back = Clock::now() + ScipRangeFinder::kSilence + milliseconds(100);
  ASSERT_TRUE(link.until([&] { return Clock::now() > back; }));
  for (int i = 0; i < 50; ++i) link.next();
  EXPECT_EQ(link.finder().counters().reconnects, 0U);
}

TEST(ScipFaults, AnotherScannerOnTheSameLineIsRefused) {
  EmulatorConfig emulated;
  emulated.port = EmulatedPort::kTcp;
  emulated.geometry = tests::fast_geometry();
  auto emulator = std::make_unique<Emulator>(
      emulated, [geometry = emulated.geometry] { return tests::numbered_scan(0, geometry); });
  auto finder = open_range_finder(emulator->address());
  const auto read_until = [&](auto done) {
    for (const auto end = Clock::now() + tests::kTimeout; Clock::now() < end && !done();)
      finder->read(milliseconds(50));
    return done();
  };
  ASSERT_TRUE(read_until([&] { return finder->up(); }));
  emulated.tcp_port = static_cast<std::uint16_t>(std::stoi(emulator->address().substr(16)));
  emulated.geometry.beams = 500;
  emulator.reset();
  emulator = std::make_unique<Emulator>(emulated,
                                        [geometry = emulated.geometry] { return tests::numbered_scan(0, geometry); });
  EXPECT_TRUE(read_until([&] { return finder->status().find("another scanner is there") != std::string::npos; }));
  EXPECT_EQ(finder->geometry().beams, 1081U);
}

TEST_P(ScipFaultsOn, AnswersThatAreNotOfTheProtocolAreRefusedAndAskedForAgain) {
  auto emulated = config();
  emulated.identity.vendor = std::string(300, 'v');  // a line longer than any
  ScipLink link{emulated};
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(link.read(milliseconds(300)));
  EXPECT_FALSE(link.finder().up());
  EXPECT_GE(link.finder().counters().torn_lines, 1U);
}

// A line on which anything may come, at any time, in any pieces: noise, and pieces of true replies.
class NoiseLine final : public Line {
 public:
  explicit NoiseLine(std::uint32_t seed) : random_(seed) {}

  Opening open(Deadline) override { return random_() % 8 == 0 ? Opening::kFailed : Opening::kOpen; }
  std::optional<std::size_t> read(std::span<char> bytes, Deadline) override {
    if (random_() % 64 == 0) return std::nullopt;
    std::string text;
    switch (random_() % 3) {
      case 0:
        for (std::uint32_t i = random_() % 300; i > 0; --i) text += static_cast<char>(random_());
        break;
      case 1:
        text = answer_;
        if (!text.empty() && random_() % 4 == 0) text[random_() % text.size()] = static_cast<char>(random_());
        break;
      default:
        text = answer_.substr(0, random_() % (answer_.size() + 1));
    }
    const std::size_t count = std::min(text.size(), bytes.size());
    std::copy_n(text.begin(), count, bytes.begin());
    return count;
  }
  bool write(std::string_view request, Deadline) override {
    answer_ = scanner_.answer(request.substr(0, request.size() - 1));
    if (scanner_.measuring()) answer_ += scanner_.next_scan(std::vector<std::uint32_t>(10, 500), random_());
    return random_() % 32 != 0;
  }
  void close() noexcept override {}
  int descriptor() const override { return -1; }
  const std::string& name() const override { return name_; }
  const std::string& why() const override { return name_; }

 private:
  std::mt19937 random_;
  EmulatedScanner scanner_{{"v", "p", "f", "SCIP 2.0", "s"}, {"m", 20, 5600, 1024, 0, 9, 5, 60000}};
  std::string answer_;
  std::string name_ = "noise";
};

TEST(ScipNoise, NoBytesBreakTheClientOrHangIt) {
  std::uint64_t scans = 0;
  std::uint64_t damaged = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    ScipRangeFinder finder{std::make_unique<NoiseLine>(seed), seed % 2 == 0 ? Asking::kContinuous : Asking::kOneByOne};
    for (const auto end = Clock::now() + milliseconds(100); Clock::now() < end;) {
      const auto start = Clock::now();
      const auto scan = finder.read(milliseconds(50));
      EXPECT_LE(Clock::now() - start, tests::kLongestCall);
      if (scan) {
        EXPECT_EQ(scan->range_mm.size(), finder.geometry().beams);
      }
    }
    const LinkCounters counters = finder.counters();
    scans += counters.scans;
    damaged += counters.torn_lines + counters.wrong_sums;
  }
  EXPECT_GT(scans, 0U);
  EXPECT_GT(damaged, 0U);
}

}  // namespace
}  // namespace trivela::hal::scip
