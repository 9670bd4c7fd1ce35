#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

#include "log/schema/schema.hpp"

namespace trivela::log {

/// Makes sure that the tables and indexes of its kind are in the file as this program makes them, and that no other
/// index lies on those tables: a foreign file may have a view or a virtual table of that name, a generated column, or
/// an index that answers in the table's place. Other tables, views and triggers may be there; nobody uses them. Throws
/// std::runtime_error naming `file`, the object and what is wrong with it.
void check_schema(SQLite::Database& database, const LogKind& kind, const std::string& file);

}  // namespace trivela::log
