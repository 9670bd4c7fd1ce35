#pragma once

#include <cstdint>
#include <vector>

#include "log/schema/queries.hpp"
#include "log/write/writer.hpp"

namespace trivela::log {

/// How far the clock of another participant was ahead; row of table `clock_offsets`. Robot 0 is the base.
struct ClockOffset {
  std::int64_t session_id = 0;
  int robot_id = 0;            ///< who measured
  int other_robot_id = 0;      ///< against whom
  std::int64_t t_ns = 0;       ///< instant, by the clock of who measured
  std::int64_t offset_ns = 0;  ///< the other's clock minus this one
  std::int64_t error_ns = 0;   ///< known to plus and minus so much, at least 0
};

/// Notes measured offsets in the log of whoever measured.
class ClockOffsetWriter {
 public:
  explicit ClockOffsetWriter(Writer& log);

  /// Queues a row, whose session is the log's own. False: the queue is full, the row is counted as overflow. Of several
  /// at one instant against the same participant the first is written.
  bool push(const ClockOffset& offset);

 private:
  Writer& log_;
  TableId table_;
};

/// What a match log has of them, by session, robots and time.
std::vector<ClockOffset> clock_offsets(const Queries& log);

}  // namespace trivela::log
