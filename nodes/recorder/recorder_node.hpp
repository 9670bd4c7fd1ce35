#pragma once

#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "evaluator/log/writer.hpp"
#include "nodes/recorder/cycle_watch.hpp"
#include "nodes/recorder/instant_watch.hpp"
#include "nodes/recorder/sequence_watch.hpp"
#include "nodes/recorder/silence_record.hpp"
#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {

/// Every message of the graph, of every robot in the domain, to one SQLite match log; in real time also what was
/// silent.
class RecorderNode {
 public:
  RecorderNode(NodeContext& context, evaluator::log::Writer& log);
  bus::Node& node() { return node_; }

  /// Notes what fell silent or was heard again since the last time; the node does so itself, and whoever runs it once
  /// more after the last samples.
  void note_silences();

 private:
  template <class T>
  void record(const std::string& table);
  void record_decisions();
  /// What is known of a stream from the samples before.
  struct Watch {
    SequenceWatch numbers;
    InstantWatch instants;
  };
  /// The number that the sample is recorded with; none: it cannot be true, and is counted as rejected.
  template <class T>
  std::optional<std::int64_t> store(const std::string& table, evaluator::log::TableId id, Watch& watch, T sample,
                                    std::uint64_t writer);

  void report_cycle(std::size_t stream, std::int64_t t_ns);

  NodeContext& context_;
  evaluator::log::Writer& log_;
  bus::Node node_;
  std::optional<bus::Output<msg::StepDone>> step_done_;
  std::mutex mutex_;  // of cycles_
  CycleWatch cycles_;
  std::optional<SilenceRecord> silences_;                   // not in lockstep
  std::set<std::tuple<int, int, std::uint32_t>> assigned_;  // robot, half, possession that a policy was noted for
};

/// What the log says about this session.
evaluator::log::Session session_of(const NodeContext& context);

}  // namespace trivela::nodes
