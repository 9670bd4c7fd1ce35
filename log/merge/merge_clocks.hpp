#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "log/merge/clock_alignment.hpp"
#include "log/merge/merge.hpp"

namespace trivela::log {

/// Rows that the session's recorder wrote by its own counters and that are not there.
std::int64_t missing_rows(SQLite::Database& database, std::int64_t session_id);

/// Whose clock a session has: its robot's; where it names none, of who measured clocks in it, of the only robot in it;
/// otherwise the base's.
ClockedSession clock_of(SQLite::Database& database, std::int64_t session_id);

/// Fills table `session_clocks` of a merged log from its `clock_offsets`.
Alignment write_clocks(SQLite::Database& database, const std::vector<MergedSession>& sessions,
                       std::optional<int> reference_robot);

}  // namespace trivela::log
