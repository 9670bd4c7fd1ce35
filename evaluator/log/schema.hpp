#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evaluator/log/session.hpp"

namespace trivela::evaluator::log {

inline constexpr int kApplicationId = 0x4B49434B;  ///< "KICK", shown by file(1)
inline constexpr int kSchemaVersion = 1;           ///< PRAGMA user_version

struct Column {
  std::string name;
  bool not_null = false;
};

/// Creates the tables and the session's rows in one transaction; `uuid` must be set. Throws SQLite::Exception.
void create_log(SQLite::Database& database, const Session& session);

/// Names of the tables, without views.
std::vector<std::string> tables_of(SQLite::Database& database);

/// Columns of a table or view; none: there is no such table.
std::optional<std::vector<Column>> columns_of(SQLite::Database& database, std::string_view table);

}  // namespace trivela::evaluator::log
