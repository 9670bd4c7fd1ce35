#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

namespace trivela::robot {

/// Finds what a stream lost from its sequence numbers, robot by robot and writer by writer, and keeps the numbers of
/// the record unique where a node is started again and where two writers of a robot speak in turn. A writer that was
/// not heard for long and is heard again goes on counting: what it wrote meanwhile is missing, unless it comes late. A
/// number that no writer can have come to in the time that passed is not believed before its successor has confirmed
/// it, nor is a robot 0.
class SequenceWatch {
 public:
  struct Finding {
    std::int64_t seq = 0;       ///< for the record: goes on rising whoever writes
    std::int64_t gap = 0;       ///< numbers skipped right before this one
    bool out_of_order = false;  ///< not newer than its predecessor
    bool filled = false;        ///< of those that were counted as skipped before, and now it is there
    bool repeated = false;      ///< it came before
    bool believed = true;       ///< false: not for the record
  };

  /// `writer` tells the writers of a topic apart, also where one goes and comes back; a new one, of a node that was
  /// started again or of a second node, starts a new count, which is no gap. `received_s`: when this one came, on any
  /// clock that rises; none: as in lockstep, where any time may have passed. `said_s`: its own instant; who stood still
  /// for long takes what waited for it in no time, and then what came after that was lost.
  Finding see(std::uint8_t robot_id, std::uint64_t seq, std::uint64_t writer, std::optional<double> received_s = {},
              std::optional<double> said_s = {}) {
    if (robot_id == 0 || seq > kHighest) return {.believed = false};
    Robot& robot = robots_[robot_id];
    Count& count = robot.count_of(writer);
    const std::uint64_t most = count.most_numbers(received_s, said_s);
    if (!count.fresh && seq > count.last && seq - count.last > most) {
      const bool confirmed = count.doubted && seq > *count.doubted && seq - *count.doubted <= most;
      if (!confirmed) {
        count.doubted = seq;
        return {.believed = false};
      }
      count.last = *count.doubted;
    }
    count.doubted.reset();
    if (received_s) count.received_s = *received_s;
    if (said_s) count.said_s = std::max(*said_s, count.said_s.value_or(*said_s));
    if (!count.fresh && seq <= count.last) return late(count, seq);
    return newer(robot, count, seq);
  }

 private:
  static constexpr std::uint64_t kHighest = std::uint64_t{1} << 40;  // a year at 10 kHz is a third of it
  static constexpr double kMostPerSecond = 10'000.0;
  static constexpr std::uint64_t kAlwaysPossible = 100;
  static constexpr std::size_t kMostWriters = 16;  // of a robot; who was not heard for longest begins again

  /// Numbers that were skipped, as ranges; of very many the latest.
  class Skipped {
   public:
    void add(std::uint64_t from, std::uint64_t to, std::uint64_t offset) {
      ranges_[from] = {to, offset};
      if (ranges_.size() > kMost) ranges_.erase(ranges_.begin());
    }
    /// The number in the record where it is one of them, which it is no longer.
    std::optional<std::uint64_t> take(std::uint64_t number) {
      auto place = ranges_.upper_bound(number);
      if (place == ranges_.begin() || (--place)->second.to < number) return std::nullopt;
      const std::uint64_t from = place->first;
      const Range range = place->second;
      ranges_.erase(place);
      if (from < number) ranges_[from] = {number - 1, range.offset};
      if (number < range.to) ranges_[number + 1] = range;
      return range.offset + number;
    }

   private:
    struct Range {
      std::uint64_t to, offset;
    };
    static constexpr std::size_t kMost = 256;
    std::map<std::uint64_t, Range> ranges_;  // by their first number
  };

  /// What one writer has come to.
  struct Count {
    std::uint64_t before = 0;  // the record's number below its first ones
    std::uint64_t offset = 0;  // the record's number of its last one, minus that
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    std::uint64_t turn = 0;  // when it was heard last, counted in samples of its robot
    Skipped skipped{};
    bool fresh = true;
    double received_s = 0.0;
    std::optional<double> said_s{};
    std::optional<std::uint64_t> doubted{};

    /// That may have been written since the last one that was believed.
    std::uint64_t most_numbers(std::optional<double> now_s, std::optional<double> then_s) const {
      if (!now_s) return kHighest;
      const double passed_s = std::max(*now_s - received_s, then_s && said_s ? *then_s - *said_s : 0.0);
      const double written = std::clamp(passed_s * kMostPerSecond, 0.0, static_cast<double>(kHighest));
      return std::max(kAlwaysPossible, static_cast<std::uint64_t>(written));
    }
  };

  struct Robot {
    std::uint64_t highest = 0;  // of the record
    std::uint64_t turns = 0;
    std::map<std::uint64_t, Count> counts;  // by writer

    Count& count_of(std::uint64_t writer) {
      const auto place = counts.find(writer);
      if (place == counts.end() && counts.size() == kMostWriters) {
        counts.erase(std::ranges::min_element(counts, {}, [](const auto& count) { return count.second.turn; }));
      }
      Count& count = place != counts.end() ? place->second : counts[writer];
      count.turn = ++turns;
      return count;
    }
  };

  static Finding late(Count& count, std::uint64_t seq) {
    const auto skipped = count.skipped.take(seq);
    const std::uint64_t number = skipped.value_or((seq < count.first ? count.before : count.offset) + seq);
    return {.seq = static_cast<std::int64_t>(number),
            .out_of_order = true,
            .filled = skipped.has_value(),
            .repeated = !skipped && seq >= count.first};
  }

  static Finding newer(Robot& robot, Count& count, std::uint64_t seq) {
    Finding finding;
    if (count.fresh) {
      count.first = seq;
      count.before = count.offset = robot.highest;
    } else {
      count.offset = robot.highest - count.last;  // another one may have spoken meanwhile
      finding.gap = static_cast<std::int64_t>(seq - count.last - 1);
      if (finding.gap > 0) count.skipped.add(count.last + 1, seq - 1, count.offset);
    }
    count.last = seq;
    count.fresh = false;
    robot.highest = count.offset + seq;
    finding.seq = static_cast<std::int64_t>(robot.highest);
    return finding;
  }

  std::map<std::uint8_t, Robot> robots_;
};

}  // namespace trivela::robot
