#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluator/sessions/same_match.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// How long a match was to last, and how much of it is in the log; of several recordings together.
struct PlayedLength {
  std::int64_t session_id = 0;  ///< of the first recording
  double planned_s = 0.0;
  double recorded_s = 0.0;    ///< between words of the referee, stops included
  bool half_missing = false;  ///< one of the planned halves, all as long, is not there or ends early

  /// Less than was planned, all of it or of a half: a half that lasts until its last possession has ended makes up for
  /// none of the next. The last cycle may end half a second early.
  bool cut_short() const { return half_missing || recorded_s < planned_s - 0.5; }
};

/// Of every match whose length was planned (sessions.planned_s), in the order of `sessions`.
std::vector<PlayedLength> played_lengths(std::span<const log::Reader* const> logs,
                                         const std::vector<ComparedSession>& sessions);

/// "cut short: 27.0 s of 300.0 s are recorded"; one a match that was.
std::vector<std::string> cut_short_lines(const std::vector<PlayedLength>& lengths);

}  // namespace trivela::evaluator
