#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

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

}  // namespace trivela::log
