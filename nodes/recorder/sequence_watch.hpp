#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>

namespace trivela::nodes {

/// Finds what a stream lost from its sequence numbers, robot by robot, and keeps them unique when a node is started
/// anew. A number that no writer can have come to in the time that passed is not believed before its successor has
/// confirmed it, nor is a robot that the writer did not speak for before.
class SequenceWatch {
 public:
  struct Finding {
    std::int64_t seq = 0;       ///< for the record: goes on rising when the writer starts again at 1
    std::int64_t gap = 0;       ///< numbers skipped right before this one
    bool out_of_order = false;  ///< not newer than its predecessor
    bool believed = true;       ///< false: not for the record
  };

  /// `writer` tells the writers of a topic apart; a new one starts a new count, which is no gap. `heard_s`: when this
  /// one came, on any clock that rises; none: as in lockstep, where any time may have passed.
  Finding see(std::uint8_t robot_id, std::uint64_t seq, std::uint64_t writer, std::optional<double> heard_s = {}) {
    const bool known_robot = robot_id != 0 && speaks_for_.try_emplace(writer, robot_id).first->second == robot_id;
    if (!known_robot || seq > kHighest) return {.believed = false};
    Stream& stream = streams_[robot_id];
    if (stream.writer != writer) stream.begin_anew(writer);
    Finding finding{.seq = static_cast<std::int64_t>(stream.offset + seq)};
    const std::uint64_t most = stream.most_numbers(heard_s);
    if (!stream.fresh && seq > stream.last && seq - stream.last > most) {
      const bool confirmed = stream.doubted && seq > *stream.doubted && seq - *stream.doubted <= most;
      if (!confirmed) {
        stream.doubted = seq;
        finding.believed = false;
        return finding;
      }
      stream.last = *stream.doubted;
    }
    stream.doubted.reset();
    if (heard_s) stream.heard_s = *heard_s;
    if (seq <= stream.last) {
      finding.out_of_order = true;
      return finding;
    }
    if (!stream.fresh) finding.gap = static_cast<std::int64_t>(seq - stream.last - 1);
    stream.last = seq;
    stream.fresh = false;
    return finding;
  }

 private:
  static constexpr std::uint64_t kHighest = std::uint64_t{1} << 40;  // a year at 10 kHz is a third of it
  static constexpr double kMostPerSecond = 10'000.0;
  static constexpr std::uint64_t kAlwaysPossible = 100;

  struct Stream {
    std::uint64_t writer = 0;
    std::uint64_t offset = 0;
    std::uint64_t last = 0;
    bool fresh = true;
    double heard_s = 0.0;
    std::optional<std::uint64_t> doubted;

    void begin_anew(std::uint64_t by) {
      offset += last;
      last = 0;
      writer = by;
      fresh = true;
      doubted.reset();
    }
    /// That may have been written since the last one that was believed.
    std::uint64_t most_numbers(std::optional<double> now_s) const {
      if (!now_s) return kHighest;
      const double written = std::clamp((*now_s - heard_s) * kMostPerSecond, 0.0, static_cast<double>(kHighest));
      return std::max(kAlwaysPossible, static_cast<std::uint64_t>(written));
    }
  };
  std::map<std::uint8_t, Stream> streams_;
  std::map<std::uint64_t, std::uint8_t> speaks_for_;  // robot of each writer
};

}  // namespace trivela::nodes
