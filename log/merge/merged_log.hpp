#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/merge/clock_alignment.hpp"
#include "log/merge/merge.hpp"
#include "log/schema/row.hpp"

namespace trivela::log {

/// Rows of one table on their way from one match log to another.
class RowCopy {
 public:
  /// Into a table of `database` that has the schema of this version.
  RowCopy(SQLite::Database& database, std::string_view table);

  /// Every column of the table, in the order that insert() takes them.
  const std::vector<std::string>& columns() const { return columns_; }

  /// The place of a column that the table has.
  std::size_t place(std::string_view column) const;

  /// False: a row of its key is there already, or it is against the schema. Throws SQLite::Exception where the disk
  /// refuses.
  bool insert(std::span<const Value> row);

 private:
  SQLite::Database& database_;
  std::vector<std::string> columns_;
  SQLite::Statement insert_;
};

/// Copies every session of a match log of this version that was verified, with its rows, digest and tallies, into a new
/// one, without looking at a cell. Outside of any transaction. `told(rows)`: that were copied so far. Rows that are
/// against the schema of the new log are left out, and with them the digest of their session. Returns the rows. Throws
/// SQLite::Exception.
std::int64_t copy_whole(SQLite::Database& database, const std::filesystem::path& source,
                        const std::function<void(std::int64_t rows)>& told);

/// The rows of a session that copy_whole() brought along as it was recorded; none: it did not.
std::optional<std::int64_t> rows_of_whole(SQLite::Database& database, std::int64_t session_id);

/// Whether the session's tallies came along, too.
bool has_tallies(SQLite::Database& database, std::int64_t session_id);

/// Rows of any session in the new log, counted.
std::int64_t counted_rows(SQLite::Database& database, std::int64_t session_id);

/// Rows that the session's recorder wrote by its own counters and that are not there.
std::int64_t missing_rows(SQLite::Database& database, std::int64_t session_id);

/// Whose clock a session has: its robot's; where it names none, of who measured clocks in it, of the only robot in it;
/// otherwise the base's.
ClockedSession clock_of(SQLite::Database& database, std::int64_t session_id);

/// Fills table `session_clocks` of a merged log from its `clock_offsets`.
Alignment write_clocks(SQLite::Database& database, const std::vector<MergedSession>& sessions,
                       std::optional<int> reference_robot);

}  // namespace trivela::log
