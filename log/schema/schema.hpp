#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "log/schema/digest.hpp"
#include "log/schema/session.hpp"

namespace trivela::log {

/// A kind of file that this folder writes.
struct LogKind {
  const char* name = "";
  const char* content = "";  ///< what is lost where one is overwritten
  int application_id = 0;    ///< shown by file(1)
  int version = 1;           ///< PRAGMA user_version
};
inline constexpr LogKind kMatchLog{"match log", "a recorded match", 0x4B49434B, 1};     ///< "KICK"
inline constexpr LogKind kScanRecord{"scan record", "a recorded scan", 0x5343414E, 1};  ///< "SCAN"

struct Column {
  std::string name;
  bool not_null = false;
  bool has_default = false;  ///< what a row has that leaves it out
};

/// The statements that make a log.
std::string_view schema_of(const LogKind& kind);

/// Views of this connection through which a match log is read. Views of the file are never used. View counted_kicks is
/// kicks without what the connection's tables left_out_sessions and left_out_kicks name. Throws SQLite::Exception.
void create_reading_views(SQLite::Database& database);

/// Creates the tables of a match log. Throws SQLite::Exception.
void create_tables(SQLite::Database& database);

/// Inserts a session's rows, its texts where they are not there yet; `uuid` must be set. `closed_t_ns`: end of the
/// recording, none: it goes on. Throws SQLite::Exception.
void insert_session(SQLite::Database& database, const Session& session, std::optional<std::int64_t> closed_t_ns,
                    Digests& digests);

/// Both in one transaction.
void create_log(SQLite::Database& database, const Session& session);

/// Names of the tables, without views.
std::vector<std::string> tables_of(SQLite::Database& database);

/// Columns of a table or view; none: there is no such table.
std::optional<std::vector<Column>> columns_of(SQLite::Database& database, std::string_view table);

}  // namespace trivela::log
