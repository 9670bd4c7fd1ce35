#include <fmt/core.h>

#include "bus/executor.hpp"
#include "hal/open_range_finder.hpp"
#include "hal/sim/sim_range_finder.hpp"
#include "nodes/runtime/node_main.hpp"
#include "nodes/scan_recorder/scan_recorder_node.hpp"

namespace {

std::unique_ptr<trivela::hal::RangeFinder> scanner_of(const trivela::nodes::NodeContext& context) {
  const std::string& device = context.settings.scan_recorder.device;
  if (device == "sim") return std::make_unique<trivela::hal::SimRangeFinder>(context.participant, context.robot_id());
  return trivela::hal::open_range_finder(device);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace trivela;
  return nodes::node_main(argc, argv, "scan_recorder", [](nodes::NodeContext& context) {
    nodes::ScanRecorderNode node{context, scanner_of(context)};
    bus::Executor{bus::Executor::kWaitset, context.stop, {&node.node()}}.run();
    node.finish();
    context.logger->info("recorded {} scans: {}", node.scans(), context.settings.scan_recorder.file);
  });
}
