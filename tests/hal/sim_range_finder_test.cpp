#include "hal/bus/sim_range_finder.hpp"

#include <gtest/gtest.h>

#include "bus/writer.hpp"
#include "tests/bus/test_domain.hpp"
#include "tests/hal/bus_world.hpp"

namespace trivela::hal {
namespace {

using std::chrono::milliseconds;

msg::SimScan scan_of(std::uint64_t seq, std::uint8_t robot_id = kRobot) {
  msg::SimScan scan{};
  scan.robot_id = robot_id;
  scan.seq = seq;
  scan.t_ns = static_cast<std::int64_t>(seq) * 25'000'000;
  scan.beam_count = 3;
  scan.first_angle_rad = -0.5;
  scan.step_rad = 0.25;
  scan.beam_period_s = 1e-5;
  scan.scan_period_s = 0.025;
  scan.min_range_m = 0.1;
  scan.max_range_m = 30.0;
  for (std::uint16_t i = 0; i < 3; ++i) scan.range_mm[i] = static_cast<std::uint16_t>(100 * seq + i);
  scan.range_mm[3] = 9999;  // beyond beam_count
  return scan;
}

class SimRangeFinderTest : public testing::Test {
 protected:
  SimRangeFinderTest() { EXPECT_TRUE(world.wait_for_readers(1, kPlenty)); }

  bus::DomainConfig domain = bus::fresh_domain();
  bus::Participant here{domain};
  bus::Participant there{domain};
  SimRangeFinder device{here, kRobot};
  bus::Writer<msg::SimScan> world{there};
};

TEST_F(SimRangeFinderTest, IsConnectedOnceAScanHasCome) {
  EXPECT_FALSE(device.connected(milliseconds{1}));
  EXPECT_FALSE(device.up());
  EXPECT_EQ(device.status(), "no scan of a simulated laser has come");
  world.write(scan_of(1, kRobot + 1));
  world.write(scan_of(1));
  EXPECT_TRUE(device.connected(kPlenty));
  EXPECT_TRUE(device.up());
  EXPECT_EQ(device.geometry().beams, 3u);
  EXPECT_EQ(device.geometry().first_angle_rad, -0.5);
  EXPECT_EQ(device.geometry().scan_period_s, 0.025);
  EXPECT_EQ(device.geometry().max_range_m, 30.0);
  EXPECT_NE(device.identity().product.find("synthetic"), std::string::npos);
}

TEST_F(SimRangeFinderTest, GivesEveryScanOnceInOrderHoweverLateItIsRead) {
  for (std::uint64_t seq = 1; seq <= 120; ++seq) {
    world.write(scan_of(seq, kRobot + 1));
    world.write(scan_of(seq));
  }
  for (std::uint64_t seq = 1; seq <= 120; ++seq) {
    const auto scan = device.read(kPlenty);
    ASSERT_TRUE(scan) << seq;
    EXPECT_EQ(scan->t_ns, static_cast<std::int64_t>(seq) * 25'000'000);
    ASSERT_EQ(scan->range_mm.size(), 3u);
    EXPECT_EQ(scan->range_mm[2], 100 * seq + 2);
  }
  EXPECT_FALSE(device.read(milliseconds{1}));
  EXPECT_EQ(device.counters().scans, 120u);
  EXPECT_EQ(device.counters().lost_scans, 0u);
}

TEST_F(SimRangeFinderTest, CountsGaps) {
  for (const std::uint64_t seq : {1, 2, 6}) world.write(scan_of(seq));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(device.read(kPlenty));
  EXPECT_EQ(device.counters().lost_scans, 3u);
}

}  // namespace
}  // namespace trivela::hal
