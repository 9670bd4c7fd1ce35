#include "hal/scip/scip_range_finder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <string_view>

#include "kicking/geometry/time.hpp"
#include "tests/hal/scip_link.hpp"

namespace trivela::hal::scip {
namespace {

using tests::Clock;
using tests::milliseconds;
using tests::number_of;
using tests::ScipLink;

struct Way {
  const char* name;
  EmulatedPort port;
  Asking asking;
};

class EveryWay : public testing::TestWithParam<Way> {
 protected:
  static EmulatorConfig config() {
    EmulatorConfig config;
    config.port = GetParam().port;
    config.geometry = tests::fast_geometry();
    return config;
  }
};

INSTANTIATE_TEST_SUITE_P(Scip, EveryWay,
                         testing::Values(Way{"TerminalMd", EmulatedPort::kTerminal, Asking::kContinuous},
                                         Way{"TerminalGd", EmulatedPort::kTerminal, Asking::kOneByOne},
                                         Way{"TcpMd", EmulatedPort::kTcp, Asking::kContinuous},
                                         Way{"TcpGd", EmulatedPort::kTcp, Asking::kOneByOne}),
                         [](const auto& way) { return way.param.name; });

TEST_P(EveryWay, ScansArriveInOrderWithTheirRangesErrorCodesAmongThem) {
  ScipLink link{config(), GetParam().asking};
  std::optional<std::uint32_t> last;
  for (int i = 0; i < 40; ++i) {
    const auto scan = link.next();
    EXPECT_EQ(scan.range_mm, tests::numbered_scan(number_of(scan), config().geometry).range_mm);
    if (last) {
      EXPECT_GT(number_of(scan), *last);
    }
    last = number_of(scan);
  }
  const LinkCounters counters = link.finder().counters();
  EXPECT_EQ(counters.scans, 40U);
  EXPECT_GT(counters.error_ranges, 0U);
  EXPECT_EQ(counters.torn_lines + counters.wrong_sums + counters.error_replies + counters.reconnects, 0U);
  EXPECT_EQ(last, 39U);
  EXPECT_TRUE(link.finder().up());
  EXPECT_EQ(link.finder().status(), "measuring");
}

TEST_P(EveryWay, IdentityAndGeometryAreTheScanners) {
  auto emulated = config();
  emulated.first_step = 44;
  emulated.identity = {"Hokuyo Automatic Co.,Ltd.", "UTM-30LX", "H1", "2.1", "SCIP 2.0"};
  emulated.geometry.beams = 682;
  ScipLink link{emulated, GetParam().asking};
  ASSERT_TRUE(link.until([&] { return link.finder().connected(milliseconds(500)); })) << link.finder().status();
  EXPECT_EQ(link.finder().identity().vendor, "Hokuyo Automatic Co.,Ltd.");
  EXPECT_EQ(link.finder().identity().product, "UTM-30LX");
  EXPECT_EQ(link.finder().identity().serial, "H1");
  EXPECT_EQ(link.finder().geometry().beams, 682U);
  EXPECT_DOUBLE_EQ(link.finder().geometry().first_angle_rad, emulated.geometry.first_angle_rad);
  EXPECT_DOUBLE_EQ(link.finder().geometry().scan_period_s, 0.010);
  EXPECT_DOUBLE_EQ(link.finder().geometry().max_range_m, 30.0);
  EXPECT_EQ(link.next().range_mm.size(), 682U);
}

TEST_P(EveryWay, ClosingStopsTheScannerAndTheNextClientGoesOn) {
  ScipLink link{config(), GetParam().asking};
  link.next();
  EXPECT_TRUE(link.emulator().laser_on());
  link.close_finder();
  EXPECT_TRUE(link.until([&] { return !link.emulator().laser_on(); }));
  link.open_finder();
  link.next();
  EXPECT_EQ(link.finder().counters().torn_lines + link.finder().counters().wrong_sums, 0U);
}

TEST_P(EveryWay, TimesAreThoseOfTheFirstBeam) {
  auto emulated = config();
  emulated.geometry = {};                       // 40 scans a second
  emulated.first_stamp_ms = (1U << 24U) - 300;  // starts over after 0.3 s
  ScipLink link{emulated, GetParam().asking};
  std::int64_t last_t_ns = 0;
  int punctual = 0;
  for (std::uint32_t n = 0; n < 30; ++n) {
    const auto scan = link.next();
    ASSERT_EQ(number_of(scan), n);
    const auto age =
        std::chrono::duration<double>(Clock::now() - Clock::time_point{std::chrono::nanoseconds{scan.t_ns}});
    EXPECT_GE(age.count(), 1081 * 0.025 / 1440 - 0.0011);  // the scan takes that long; a stamp is to the millisecond
    EXPECT_GT(scan.t_ns, last_t_ns);
    if (std::abs(kicking::seconds(scan.t_ns - last_t_ns) - 0.025) < 0.0011) ++punctual;
    last_t_ns = scan.t_ns;
  }
  EXPECT_EQ(link.finder().counters().reconnects, 0U);
  // The first ones may find out how fast the line is; one by one, a busy host asks too late for the next.
  if (GetParam().asking == Asking::kContinuous) {
    EXPECT_GE(punctual, 15);
  }
}

TEST(ScipRangeFinder, AStreamThatAnEarlierClientLeftIsEndedFirst) {
  EmulatorConfig config;
  config.geometry = tests::fast_geometry();
  ScipLink link{config};
  link.next();
  // A client that dies says no QT: here one of another make, which asks for no lock.
  const int dying = ::open(link.emulator().address().c_str(), O_RDWR | O_NOCTTY);
  ASSERT_GE(dying, 0);
  link.close_finder();
  constexpr std::string_view kAsked = "BM\nMD0000108001000\n";
  ASSERT_EQ(::write(dying, kAsked.data(), kAsked.size()), static_cast<ssize_t>(kAsked.size()));
  const auto sent = link.emulator().scans_sent();
  ASSERT_TRUE(link.until([&] { return link.emulator().scans_sent() > sent + 2; }));
  ::close(dying);
  link.open_finder();
  link.next();
  const LinkCounters counters = link.finder().counters();
  EXPECT_EQ(counters.torn_lines + counters.wrong_sums + counters.reconnects, 0U);
}

TEST(ScipRangeFinder, NoDeviceIsSaidAndNoCallHangs) {
  auto finder = open_range_finder("/dev/no-such-scanner");
  for (const int timeout_ms : {0, 50, 5000}) {
    const auto start = Clock::now();
    EXPECT_FALSE(finder->read(milliseconds(timeout_ms)));
    EXPECT_FALSE(finder->connected(milliseconds(timeout_ms)));
    EXPECT_LE(Clock::now() - start, 2 * tests::kLongestCall);
  }
  EXPECT_EQ(finder->status(), "no device /dev/no-such-scanner: no such file or directory");
  EXPECT_FALSE(finder->up());
}

TEST(ScipRangeFinder, AFileIsNoScanner) {
  auto finder = open_range_finder("/dev/null");
  EXPECT_FALSE(finder->read(milliseconds(300)));
  EXPECT_EQ(finder->status(), "no device /dev/null: inappropriate ioctl for device");
}

TEST(OpenRangeFinder, NamesAMalformedAddress) {
  for (const std::string address :
       {"", "tcp://", "tcp://host", "tcp://host:", "tcp://:10940", "tcp://host:0", "tcp://host:70000", "tcp://host:1x",
        "tcp://a:b:1", "udp://host:1", "tcp://h/x:1"}) {
    try {
      open_range_finder(address);
      ADD_FAILURE() << address;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()),
                "range finder '" + address +
                    "': an address is tcp://HOST:PORT (Hokuyo's port is 10940) or the path of a device");
    }
  }
}

TEST(OpenRangeFinder, AHostMayHaveAName) {
  EmulatorConfig config;
  config.port = EmulatedPort::kTcp;
  config.geometry = tests::fast_geometry();
  ScipLink link{config};
  auto finder = open_range_finder("tcp://localhost:" + link.emulator().address().substr(16));
  EXPECT_TRUE(link.until([&] { return finder->connected(milliseconds(500)); })) << finder->status();
}

TEST(OpenRangeFinder, TakesNamesAndAddressesOfHosts) {
  for (const std::string address : {"tcp://localhost:1", "tcp://127.0.0.1:1", "tcp://[::1]:1"}) {
    auto finder = open_range_finder(address);
    const auto start = Clock::now();
    EXPECT_FALSE(finder->read(milliseconds(300)));
    EXPECT_LE(Clock::now() - start, tests::kLongestCall);
    EXPECT_NE(finder->status().find(address), std::string::npos) << finder->status();
  }
}

}  // namespace
}  // namespace trivela::hal::scip
