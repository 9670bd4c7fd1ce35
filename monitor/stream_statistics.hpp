#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "robot/watch/sequence_watch.hpp"

namespace trivela::monitor {

/// A sample of a topic as it was received.
struct ReceivedSample {
  std::uint64_t writer = 0;           ///< tells the writers of the topic apart
  std::optional<std::uint64_t> seq;   ///< its number, where the message has one
  std::int64_t t_ns = 0;              ///< what the message is about: in real time of the machine's steady clock
  std::int64_t source_ns = 0;         ///< the writer's real-time clock when it was written
  std::int64_t received_ns = 0;       ///< steady clock
  std::int64_t received_real_ns = 0;  ///< real-time clock
};

/// What one robot's samples on one topic say of it.
struct StreamFigures {
  double rate_hz = 0.0;                  ///< over the last seconds
  double rate_now_hz = 0.0;              ///< over the last second
  std::optional<double> latency_p50_us;  ///< from writing (source timestamp) to reception; between machines their
  std::optional<double> latency_p99_us;  ///< clocks' difference is in it
  std::optional<double> age_p50_ms;      ///< from `t_ns` to reception; none where that is not this machine's clock
  std::int64_t received = 0;             ///< since we listen, as are the following
  std::int64_t lost = 0;                 ///< numbers skipped and not made good since
  std::int64_t lost_lately = 0;          ///< of these, in the last kNews_s
  std::int64_t out_of_order = 0;
  std::int64_t missed_deadlines = 0;   ///< times that three periods went by without a sample
  std::optional<double> silent_for_s;  ///< since the last one
};

/// Counts one robot's samples on one topic. A pure function of what was fed and of the clock that is handed in.
class StreamStatistics {
 public:
  static constexpr double kWindow_s = 5.0;
  static constexpr double kNews_s = 10.0;

  /// `period_s`: the longest time between two samples while all is well; 0: none.
  explicit StreamStatistics(double period_s) : period_s_(period_s) {}

  void see(std::uint8_t robot_id, const ReceivedSample& received_sample);
  StreamFigures figures(std::int64_t now_ns) const;
  std::int64_t lost() const { return counts_.lost; }

 private:
  struct Sample {
    std::int64_t received_ns;
    double latency_us;
    std::optional<double> age_ms;
  };
  std::int64_t deadlines_in(std::int64_t ns) const;
  void count(std::uint8_t robot_id, const ReceivedSample& received_sample);

  double period_s_;
  std::int64_t first_ns_ = 0;
  StreamFigures counts_;
  std::deque<Sample> window_;
  std::deque<std::pair<std::int64_t, std::int64_t>> losses_;  // when, how many; what was made good counts below 0
  robot::SequenceWatch numbers_;
};

}  // namespace trivela::monitor
