#include "log/read/clock_offsets.hpp"

namespace trivela::log {

ClockOffsetWriter::ClockOffsetWriter(Writer& log)
    : log_(log), table_(log.table("clock_offsets", {"robot_id", "other_robot_id", "t_ns", "offset_ns", "error_ns"})) {}

bool ClockOffsetWriter::push(const ClockOffset& offset) {
  return log_.push(table_, {std::int64_t{offset.robot_id}, std::int64_t{offset.other_robot_id}, offset.t_ns,
                            offset.offset_ns, offset.error_ns});
}

std::vector<ClockOffset> clock_offsets(const Queries& log) {
  using C = ClockOffset;
  return log.rows<C>(
      "SELECT session_id, robot_id, other_robot_id, t_ns, offset_ns, error_ns FROM clock_offsets "
      "ORDER BY session_id, robot_id, other_robot_id, t_ns",
      &C::session_id, &C::robot_id, &C::other_robot_id, &C::t_ns, &C::offset_ns, &C::error_ns);
}

}  // namespace trivela::log
