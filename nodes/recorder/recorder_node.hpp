#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "log/read/clock_offsets.hpp"
#include "log/write/writer.hpp"
#include "nodes/runtime/node_context.hpp"
#include "robot/watch/fire_watch.hpp"
#include "robot/watch/instant_watch.hpp"
#include "robot/watch/sequence_watch.hpp"
#include "robot/watch/silence_watch.hpp"

#include <spdlog/logger.h>

namespace trivela::nodes {

/// Writes a row for each silence of a stream to the log, when it begins and again when it ends, and warns of it. By the
/// samples' own t_ns: what merely came late to the recorder is no silence. For any thread.
class SilenceRecord {
 public:
  /// How often look() is to be called.
  static constexpr std::chrono::milliseconds kStep{20};

  /// Streams have at least the period of a cycle.
  SilenceRecord(std::shared_ptr<spdlog::logger> logger, double cycle_s, log::Writer& log)
      : logger_(std::move(logger)), cycle_s_(cycle_s), log_(log) {}

  /// The number of a stream, by the table of its samples, and with its period where it is new.
  std::size_t add(const std::string& table, double period_s);

  void received(std::size_t stream, std::uint8_t robot_id, std::int64_t t_ns);
  void look(std::int64_t now_ns);

 private:
  void write(const robot::SilenceEdge& edge);

  const std::shared_ptr<spdlog::logger> logger_;
  const double cycle_s_;
  log::Writer& log_;
  std::mutex mutex_;  // of what follows
  std::vector<std::string> tables_;
  robot::SilenceWatch watch_{std::chrono::nanoseconds{kStep}.count()};
  robot::SilenceLines lines_;
};

/// What is known of a stream from the samples before.
struct StreamWatch {
  robot::SequenceWatch numbers;
  robot::InstantWatch instants;
  std::map<std::uint8_t, bus::WriterWatch> writers{};                       ///< by robot
  std::map<std::uint8_t, std::pair<std::uint64_t, std::int64_t>> latest{};  ///< seq and t_ns of a robot's last sample
  bool events = false;  ///< without a period: what is skipped has no silence of its own

  /// A sample that a late joiner is given once more.
  bool repeats(std::uint8_t robot_id, std::uint64_t seq, std::int64_t t_ns) const {
    const auto last = latest.find(robot_id);
    return last != latest.end() && last->second == std::pair{seq, t_ns};
  }
};

/// What a recorder knows of the log that it writes: it outlives a node that joins the bus again, as the log does.
struct RecordingState {
  std::map<std::string, StreamWatch> streams;              ///< by table
  std::set<std::tuple<int, int, std::uint32_t>> assigned;  ///< robot, half, possession that a policy was noted for
  std::map<std::uint8_t, std::int64_t> clocks;             ///< when another participant's clock was noted last
  std::shared_ptr<SilenceRecord> silences;                 ///< none in lockstep
  robot::FireWatch fires;                                  ///< on a bus without keys
  std::filesystem::path log;                               ///< for notes
  std::atomic<bool> emulated = false;                      ///< the log says that the session is simulated
  std::atomic<bool> truth_told = false;                    ///< and in which world
};

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

  void store_received(const msg::TeamHeard& received);

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
