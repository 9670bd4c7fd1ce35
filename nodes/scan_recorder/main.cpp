#include "bus/executor.hpp"
#include "hal/open.hpp"
#include "nodes/runtime/node_main.hpp"
#include "nodes/scan_recorder/scan_recorder_node.hpp"

int main(int argc, char** argv) {
  using namespace trivela;
  return nodes::node_main(argc, argv, "scan_recorder", [](nodes::NodeContext& context) {
    nodes::ScanRecorderNode node{context, hal::open_range_finder(context.settings.scan_recorder.device,
                                                                 {context.participant, context.robot_id()})};
    bus::Executor{bus::Executor::kWaitset, context.stop, {&node.node()}}.run();
    node.finish();
    context.logger->info("recorded {} scans: {}", node.scans(), context.settings.scan_recorder.file);
  });
}
