#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

namespace trivela::robot {

/// Finds what a stream lost from its sequence numbers, robot by robot, and keeps them unique when a node is started
/// anew. A writer that was not heard for long and is heard again goes on counting: what it wrote meanwhile is missing,
/// unless it comes late. A number that no writer can have come to in the time that passed is not believed before its
/// successor has confirmed it, nor is a robot 0.
class SequenceWatch {
 public:
  struct Finding {
    std::int64_t seq = 0;       ///< for the record: goes on rising when the writer starts again at 1
    std::int64_t gap = 0;       ///< numbers skipped right before this one
    bool out_of_order = false;  ///< not newer than its predecessor
    bool filled = false;        ///< of those that were counted as skipped before, and now it is there
    bool repeated = false;      ///< it came before
    bool believed = true;       ///< false: not for the record
  };

  /// `writer` tells the writers of a topic apart, also where one goes and comes back; a new one, of a node that was
  /// started anew, starts a new count, which is no gap. `heard_s`: when this
  /// one came, on any clock that rises; none: as in lockstep, where any time may have passed.
  Finding see(std::uint8_t robot_id, std::uint64_t seq, std::uint64_t writer, std::optional<double> heard_s = {}) {
    if (robot_id == 0 || seq > kHighest) return {.believed = false};
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
    if (!stream.fresh && seq <= stream.last) {
      finding.out_of_order = true;
      finding.filled = stream.skipped.take(seq);
      finding.repeated = !finding.filled && seq >= stream.first;
      return finding;
    }
    if (stream.fresh) stream.first = seq;
    if (!stream.fresh) finding.gap = static_cast<std::int64_t>(seq - stream.last - 1);
    if (finding.gap > 0) stream.skipped.add(stream.last + 1, seq - 1);
    stream.last = seq;
    stream.fresh = false;
    return finding;
  }

 private:
  static constexpr std::uint64_t kHighest = std::uint64_t{1} << 40;  // a year at 10 kHz is a third of it
  static constexpr double kMostPerSecond = 10'000.0;
  static constexpr std::uint64_t kAlwaysPossible = 100;

  /// Numbers that were skipped, as ranges; of very many the latest.
  class Skipped {
   public:
    void add(std::uint64_t from, std::uint64_t to) {
      ranges_[from] = to;
      if (ranges_.size() > kMost) ranges_.erase(ranges_.begin());
    }
    /// Whether the number is one of them, which it is no longer.
    bool take(std::uint64_t number) {
      auto range = ranges_.upper_bound(number);
      if (range == ranges_.begin() || (--range)->second < number) return false;
      const auto [from, to] = *range;
      ranges_.erase(range);
      if (from < number) ranges_[from] = number - 1;
      if (number < to) ranges_[number + 1] = to;
      return true;
    }
    void clear() { ranges_.clear(); }

   private:
    static constexpr std::size_t kMost = 256;
    std::map<std::uint64_t, std::uint64_t> ranges_;  // from, to
  };

  struct Stream {
    std::uint64_t writer = 0;
    std::uint64_t offset = 0;
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    Skipped skipped;
    bool fresh = true;
    double heard_s = 0.0;
    std::optional<std::uint64_t> doubted;

    void begin_anew(std::uint64_t by) {
      offset += last;
      first = last = 0;
      skipped.clear();
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
};

}  // namespace trivela::robot
