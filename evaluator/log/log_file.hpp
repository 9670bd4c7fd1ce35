#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "evaluator/log/schema.hpp"
#include "evaluator/log/value.hpp"

namespace trivela::evaluator::log {

/// The value of a column of the row that the statement stands at.
Value value_of(const SQLite::Column& column);

/// A finished or growing log, open for reading only.
class LogFile {
 public:
  /// Throws std::runtime_error naming the path where it does not exist, is no log of this kind, is of a newer version,
  /// or is damaged.
  LogFile(const std::filesystem::path& path, const LogKind& kind);

  /// Calls `fn` for each row of the result. Throws std::runtime_error naming the path.
  void query(std::string_view sql, const RowFunction& fn) const;

  /// The sentence on a session without an end.
  std::string not_closed() const;

  /// Of the file's schema.
  int version() const;

  const std::string& path() const { return path_; }
  SQLite::Database& database() const { return *database_; }

 private:
  LogKind kind_;
  std::string path_;
  bool has_wal_;  // before opening, which may make one
  std::unique_ptr<SQLite::Database> database_;
};

}  // namespace trivela::evaluator::log
