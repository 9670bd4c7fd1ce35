#include "nodes/scan_recorder/scan_recorder_node.hpp"

#include <fstream>
#include <memory>

#include "emulators/scip/emulator.hpp"
#include "hal/bus/sim_range_finder.hpp"
#include "hal/open.hpp"
#include "tests/nodes/node_fixture.hpp"
#include "tests/support/folder.hpp"

namespace trivela::nodes {
namespace {

using bus::Executor;
using log::ScanReader;

/// The recorder of a simulated laser, whose scans the test says.
class ScanRecorderNodeTest : public NodeTest {
 protected:
  ScanRecorderNodeTest() {
    context.settings.scan_recorder.enabled = true;
    context.settings.scan_recorder.file = (folder / "scans.db").string();
    context.settings.scan_recorder.mount_x_m = 3.5;
    context.settings.run.scenario = "somewhere/calibration.toml";
  }

  void start() {
    node.emplace(context, std::make_unique<hal::SimRangeFinder>(participant, std::uint8_t{1}));
    running.emplace(Executor::kWaitset, stop, std::vector<bus::Node*>{&node->node()});
    scans.expect_reader();
    receipts.expect_reader();
  }
  /// Starts with a scanner that is a program, and waits until the record has begun.
  std::unique_ptr<hal::scip::Emulator> start_with_program() {
    Received<msg::DeviceEmulated> emulated{participant};
    const auto scan = [t_ns = std::int64_t{0}]() mutable {
      t_ns += 25'000'000;
      return kicking::lob::Scan{t_ns, std::vector<std::uint32_t>(1081, 2000)};
    };
    auto scanner = std::make_unique<hal::scip::Emulator>(hal::scip::EmulatorConfig{}, scan);
    context.settings.scan_recorder.device = config::ScipDevice{.address = scanner->address(), .host = {}};
    node.emplace(context, hal::open_range_finder(scanner->address()));
    running.emplace(Executor::kWaitset, stop, std::vector<bus::Node*>{&node->node()});
    EXPECT_EQ(emulated.nth(1).part, msg::PART_RANGE_FINDER);
    return scanner;
  }
  void scan() {
    msg::SimScan said{};
    said.t_ns = 25'000'000 * static_cast<std::int64_t>(++said_scans);
    said.beam_count = 2;
    said.step_rad = 0.01;
    said.beam_period_s = 1e-5;
    said.scan_period_s = 0.025;
    said.max_range_m = 30.0;
    said.range_mm[0] = static_cast<std::uint16_t>(1000 + said_scans);
    scans(said);
  }
  void receipt(std::int64_t kick_id, bool accepted, double power, std::int64_t fired_t_ns) {
    msg::KickReceipt said{};
    said.kick_id = kick_id;
    said.accepted = accepted;
    said.power = power;
    said.fired_t_ns = fired_t_ns;
    receipts(said);
  }
  /// Stops the node and opens its record.
  ScanReader read() {
    running.reset();
    node->finish();
    return ScanReader{folder / "scans.db"};
  }

  tests::Folder folder;
  Says<msg::SimScan> scans{participant};
  Says<msg::KickReceipt> receipts{participant};
  Received<msg::StepDone> done{participant};
  std::size_t said_scans = 0;
  std::optional<ScanRecorderNode> node;
  std::optional<Running> running;
};

TEST_F(ScanRecorderNodeTest, RecordsScansAndTheSetPointOfEveryKickThatWasAccepted) {
  context.settings.run.lockstep = true;
  start();
  receipt(7, true, 15.0, 5'000'000);  // before the first scan
  for (int i = 0; i < 20; ++i) scan();
  receipt(8, false, 0.0, 0);
  receipt(9, true, 42.5, 300'000'000);
  done.first(20);
  EXPECT_EQ(done.now().back().t_ns, 500'000'000);
  EXPECT_EQ(done.now().back().node, msg::STEP_SCAN_RECORDER);
  const ScanReader record = read();
  ASSERT_EQ(record.size(), 20u);
  EXPECT_EQ(record.t_ns(0), 25'000'000);
  EXPECT_EQ(record.scan(19).range_mm, (std::vector<std::uint32_t>{1020, 0}));
  EXPECT_TRUE(record.session().simulated);
  EXPECT_EQ(record.session().source, "synthetic: scenario calibration");
  EXPECT_EQ(record.session().mount.x_m, 3.5);
  EXPECT_EQ(record.session().geometry.beams, 2u);
  const auto tested = record.set_points();
  ASSERT_EQ(tested.size(), 2u);
  EXPECT_EQ(tested[0].kick_id, 7);
  EXPECT_EQ(tested[0].t_ns, 5'000'000);
  EXPECT_EQ(tested[1].power, 42.5);
  EXPECT_EQ(tested[1].t_ns, 300'000'000);
  EXPECT_TRUE(record.warnings().empty());
}

TEST_F(ScanRecorderNodeTest, SaysThatTheScannerIsAProgramAndTheRecordDoesToo) {
  const auto scanner = start_with_program();
  const ScanReader record = read();
  EXPECT_TRUE(record.session().simulated);
  EXPECT_EQ(record.session().source, scanner->address());
}

TEST_F(ScanRecorderNodeTest, ARecordOfBeforeStaysAndTheNextHasANumber) {
  std::ofstream(folder / "scans.db") << "of before";
  const auto scanner = start_with_program();
  running.reset();
  node->finish();
  EXPECT_EQ(std::filesystem::file_size(folder / "scans.db"), 9u);
  EXPECT_EQ(node->file(), folder / "scans-2.db");
  EXPECT_TRUE(ScanReader{folder / "scans-2.db"}.session().simulated);
}

TEST_F(ScanRecorderNodeTest, WithoutAnyScanThereIsNoRecord) {
  start();
  receipt(7, true, 15.0, 5'000'000);
  running.reset();
  node->finish();
  EXPECT_FALSE(std::filesystem::exists(folder / "scans.db"));
  EXPECT_EQ(node->scans(), 0u);
}

}  // namespace
}  // namespace trivela::nodes
