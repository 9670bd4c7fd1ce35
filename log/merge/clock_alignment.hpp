#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "log/read/clock_offsets.hpp"

namespace trivela::log {

/// A session as its clock is seen.
struct ClockedSession {
  std::int64_t session_id = 0;
  std::string uuid;
  int robot_id = 0;  ///< whose clock it is; 0: the base's
  std::int64_t started_t_ns = 0;
  std::int64_t ended_t_ns = 0;
  std::int64_t realtime_offset_ns = 0;  ///< UTC minus its clock, as its own machine had it
};

/// UTC by the reference's clock from an instant of a session on; row of table `session_clocks`.
struct ClockSegment {
  std::int64_t from_t_ns = 0;      ///< by the session's clock
  std::int64_t utc_offset_ns = 0;  ///< UTC minus the session's clock, at from_t_ns
  double rate = 0.0;               ///< and so much more a nanosecond
  std::int64_t error_ns = 0;       ///< known to plus and minus so much
};

/// A session that measurements join to the reference.
struct AlignedSession {
  std::int64_t session_id = 0;
  std::vector<ClockSegment> segments;  ///< by time, at least one
  std::int64_t error_ns = 0;           ///< the largest of them
};

struct Alignment {
  std::optional<int> reference_robot;    ///< none: nobody measured anything
  std::string reference_uuid;            ///< session whose UTC all others are given
  std::vector<AlignedSession> sessions;  ///< those that could be aligned, the reference among them
};

/// How fast two clocks may part where nobody measured, in seconds a second.
inline constexpr double kLargestDrift = 5e-5;

/// UTC minus the session's clock at an instant, by its segments; before the first that one holds.
std::int64_t utc_offset_at(const std::vector<ClockSegment>& segments, std::int64_t t_ns);

/// Gives every session that measurements join to a reference, also over others in between, UTC by the reference's
/// clock. Of ten seconds the measurement with the smallest error counts; between two, time is linear, beyond the first
/// and the last the error grows with kLargestDrift; errors of several steps add. Sessions of one robot whose own UTC
/// agrees within half a second are by one clock: a machine started again begins its clock at 0. `reference_robot`:
/// whose clock, none: the one that joins most sessions, of those the one with the smallest errors.
Alignment align_clocks(const std::vector<ClockedSession>& sessions, const std::vector<ClockOffset>& offsets,
                       std::optional<int> reference_robot);

}  // namespace trivela::log
