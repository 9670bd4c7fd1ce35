#pragma once

#include <cstdint>
#include <vector>

#include "evaluator/imports/referee_log.hpp"
#include "evaluator/imports/team_log.hpp"

namespace trivela::evaluator::imports {

/// When each usable record was true, UTC since 1970 [ms], never falling: records count in the order of the file, and
/// the step between two is that of the box's game time. Where the game time falls back a new part began. A part's place
/// in UTC is the median of `timestamp - gametimeMs` over the records whose timestamp moved on; where none did, what the
/// referee's log says of its parts, one after the other; otherwise it follows its predecessor at once. A record
/// without game time, or with that of its predecessor, is as much later as its timestamp moved, at most 2 s.
std::vector<std::int64_t> record_times_ms(const TeamLog& log, const RefereeLog* referee);

}  // namespace trivela::evaluator::imports
