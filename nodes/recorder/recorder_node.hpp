#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bus/reader.hpp"
#include "log/read/clock_offsets.hpp"
#include "log/write/writer.hpp"
#include "nodes/recorder/recording_state.hpp"
#include "nodes/runtime/node_context.hpp"
#include "robot/watch/cycle_watch.hpp"

namespace trivela::nodes {

/// Every message of the graph, of every robot in the domain, to one SQLite match log; in real time also what was
/// silent.
class RecorderNode {
 public:
  /// `state`: of the same log, which an earlier node of this process wrote to; empty: there was no such node.
  RecorderNode(NodeContext& context, log::Writer& log,
               std::shared_ptr<RecordingState> state = std::make_shared<RecordingState>());
  bus::Node& node() { return node_; }

  /// Notes what fell silent or was heard again since the last time; the node does so itself, and whoever runs it once
  /// more after the last samples.
  void note_silences();

 private:
  template <class T>
  void record(const std::string& table);
  /// The number that the sample is recorded with; none: it is there already, or cannot be true and is counted as
  /// rejected.
  template <class T>
  std::optional<std::int64_t> store(const std::string& table, log::TableId id, StreamWatch& watch, T sample,
                                    std::uint64_t writer);

  /// What a decision, recorded by the number `seq`, says of its possession and of who was not in charge.
  void store_beside(const msg::KickDecision& decision, std::int64_t seq);

  /// A writer of truth is there, or else an emulated device: the log says so, once. For any thread.
  void note_simulation(bool truth);

  void store_heard(const msg::TeamHeard& heard);

  /// Words to a coil that nobody answers for: one note.
  void note_fires(const std::vector<msg::DeviceFire>& fires);

  void report_cycle(std::size_t stream, std::int64_t t_ns);

  NodeContext& context_;
  log::Writer& log_;
  bus::Node node_;
  log::TableId shadows_, assignments_;
  log::ClockOffsetWriter clocks_;
  std::optional<bus::Output<msg::StepDone>> step_done_;
  std::optional<bus::Reader<msg::DeviceFire>> fires_;
  std::mutex mutex_;  // of cycles_
  robot::CycleWatch cycles_;
  std::shared_ptr<RecordingState> state_;
};

/// What the log says about this session before anything was heard: it is simulated where it replays what was.
log::Session session_of(const NodeContext& context);

/// The world that the configuration names, in which the session was played if there is a writer of truth.
log::Simulation simulation_of(const config::Settings& settings);

}  // namespace trivela::nodes
