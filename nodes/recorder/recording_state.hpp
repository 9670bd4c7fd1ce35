#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "bus/writer_watch.hpp"
#include "nodes/recorder/silence_record.hpp"
#include "robot/watch/fire_watch.hpp"
#include "robot/watch/instant_watch.hpp"
#include "robot/watch/sequence_watch.hpp"

namespace trivela::nodes {

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

}  // namespace trivela::nodes
