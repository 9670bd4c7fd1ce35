#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

#include "log/file/log_file.hpp"
#include "log/schema/queries.hpp"

namespace trivela::log {

/// Rows of a database of our own that is being written. Errors are SQLite's.
class OwnRows final : public Queries {
 public:
  explicit OwnRows(SQLite::Database& database) : database_(database) {}

 private:
  void each_row(std::string_view sql, const HeadFunction& head, const RowFunction& fn) const override {
    SQLite::Statement statement(database_, std::string(sql));
    if (head) head(names_of(statement));
    std::vector<Value> row(static_cast<std::size_t>(statement.getColumnCount()));
    while (statement.executeStep()) {
      for (std::size_t i = 0; i < row.size(); ++i) row[i] = value_of(statement.getColumn(static_cast<int>(i)));
      fn(row);
    }
  }

  SQLite::Database& database_;
};

}  // namespace trivela::log
