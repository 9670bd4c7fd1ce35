#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "log/schema/row.hpp"

namespace trivela::log {

/// A part of a table that is in order by itself.
struct TimedPart {
  std::string table;
  std::vector<std::string> columns;
  std::string key;  ///< of the table
  std::int64_t session_id = 0;
  std::optional<int> robot_id;  ///< none: rows of all
};

/// The instant of a row of a part, by one clock for all.
using PartInstant = std::function<std::int64_t(std::size_t part, std::span<const Value> row)>;

/// Called with the part, its row and the row's instant.
using PartRow = std::function<void(std::size_t part, std::int64_t t_ns, std::span<const Value> row)>;

/// Calls `fn` for the rows of all parts, the earliest of those that come next in their parts first, of one instant the
/// first part's. In memory is one row of each part. Throws SQLite::Exception, and what `instant` and `fn` throw.
void rows_in_time(SQLite::Database& database, const std::vector<TimedPart>& parts, const PartInstant& instant,
                  const PartRow& fn);

}  // namespace trivela::log
