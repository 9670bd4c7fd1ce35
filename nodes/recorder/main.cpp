#include <fmt/core.h>

#include <optional>

#include "bus/executor.hpp"
#include "nodes/recorder/log_place.hpp"
#include "nodes/recorder/recorder_node.hpp"
#include "nodes/runtime/node_main.hpp"

int main(int argc, char** argv) {
  using namespace trivela;
  // One log with what is known of it, also where the recorder joins the bus anew.
  std::optional<nodes::PlacedLog> placed;
  const auto state = std::make_shared<nodes::RecordingState>();
  return nodes::node_main(argc, argv, "recorder", [&placed, &state](nodes::NodeContext& context) {
    const config::Recorder& settings = context.settings.recorder;
    evaluator::log::WriterOptions options;
    options.queue_capacity = settings.queue_capacity;
    options.group_commit_s = settings.group_commit_s;
    options.warn_late = !context.settings.run.lockstep;  // where nobody looks at a clock
    options.warn = [logger = context.logger](const std::string& line) { logger->warn(line); };
    if (!placed) placed.emplace(nodes::place_log(context, options));
    evaluator::log::Writer& log = *placed->writer;
    nodes::RecorderNode node{context, log, state};
    // Its own thread takes the samples: the bus's receive thread must never wait for the log.
    bus::Executor{bus::Executor::kWaitset, context.stop, {&node.node()}}.run();
    node.note_silences();
    log.finalise();
    const auto stats = log.stats();
    fmt::print("recorded {} rows, {:.0f} a second, queue high-water {} of {}, {} missing: {}\n", stats.rows_written,
               stats.rows_per_s, stats.queue_high_water, settings.queue_capacity, stats.rows_missing,
               placed->path.string());
  });
}
