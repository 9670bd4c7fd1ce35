#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "log/read/reader.hpp"

namespace trivela::log {

/// Finds rows of a stream by their instant, which has no index, through the key of session, robot and seq.
class StreamSearch {
 public:
  /// `table` and `columns` are there. Throws SQLite::Exception.
  StreamSearch(SQLite::Database& database, std::string_view table, const std::vector<std::string>& columns);

  /// Reader::for_each_row_between(). Throws SQLite::Exception.
  void rows(const StreamSpan& span, const RowFunction& fn);

 private:
  std::int64_t first_from(const StreamSpan& span, std::int64_t t_ns);

  SQLite::Statement ends_;     // first and last seq of a session and robot
  SQLite::Statement instant_;  // seq and t_ns of the row with a seq, or of the next one
  SQLite::Statement rows_;
};

}  // namespace trivela::log
