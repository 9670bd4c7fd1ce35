#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "log/file/files_beside.hpp"
#include "log/file/log_check.hpp"
#include "log/schema/queries.hpp"
#include "log/schema/refused_log.hpp"
#include "log/schema/schema.hpp"

namespace trivela::log {

/// The value of a column of the row that the statement stands at.
Value value_of(const SQLite::Column& column);

/// Calls `head` with the names of the statement's columns, where it is one, then `fn` for each row.
void each_row_of(SQLite::Statement& statement, const HeadFunction& head, const RowFunction& fn);

/// Rows of a database of our own that is being written. Errors are SQLite's.
class OwnRows final : public Queries {
 public:
  explicit OwnRows(SQLite::Database& database) : database_(database) {}

 private:
  void each_row(std::string_view sql, const HeadFunction& head, const RowFunction& fn) const override;

  SQLite::Database& database_;
};

/// What was opened is no log of the kind that was asked for: it is not there, a folder, empty or another file.
class NoSuchLog : public RefusedLog {
 public:
  explicit NoSuchLog(const std::string& found, Refused why = Refused::kNoLog) : RefusedLog(why, found) {}
};

/// A finished or growing log, open for reading only. It may come from anybody: no view, trigger or index of its own
/// plays a part, and what reading costs is bounded by its size: a query that takes more steps than any of a file of
/// this size does throws std::runtime_error, as every error naming the path.
class LogFile final : public Queries {
 public:
  /// Throws, naming the path, NoSuchLog where it does not exist or is no log of this kind, RefusedLog where it is of
  /// another version, has another schema, or is damaged.
  LogFile(const std::filesystem::path& path, const LogKind& kind, Check check = Check::kIfShort);
  ~LogFile();
  LogFile(LogFile&&) noexcept;

  /// The sentence on a session without an end.
  std::string not_closed() const;

  /// What lay beside it.
  Wal wal() const { return place_->wal(); }

  /// Nothing but the schema was looked at.
  bool may_be_damaged() const { return check_ == Check::kSchema; }

  /// Was, or will be, everything looked at?
  bool looks_at_everything() const { return whole_; }

  /// Somebody's own question, which may take as long as it likes: `head` is called once with the names of its columns,
  /// then `fn` for each row. Throws BadQuestion where it is not one SELECT, or asks for what is not there.
  void ask(const std::string& sql, const HeadFunction& head, const RowFunction& fn) const;

  /// Calls `work`, which steps statements of the database, as one query: within its budget, its errors named.
  void as_query(const std::function<void()>& work) const;

  const std::string& path() const { return path_; }
  SQLite::Database& database() const { return *database_; }

  void each_row(std::string_view sql, const HeadFunction& head, const RowFunction& fn) const override;

 private:
  struct Budget;

  void open();
  void check() const;
  void allow_steps() const;
  void each_row_of(SQLite::Statement& statement, std::string_view sql, const HeadFunction& head,
                   const RowFunction& fn) const;
  RefusedLog unreadable(const SQLite::Exception& error) const;

  LogKind kind_;
  std::string path_;
  std::unique_ptr<ReadableLog> place_;
  Check check_;
  bool whole_;
  std::unique_ptr<Budget> budget_;  // of the statement under way
  std::unique_ptr<SQLite::Database> database_;
};

}  // namespace trivela::log
