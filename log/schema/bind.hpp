#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>
#include <type_traits>

#include "log/schema/queries.hpp"

namespace trivela::log {

/// Binds a value to a parameter, from 1: an empty optional as NULL, a bool as 0 or 1. A text is not copied:
/// it must live until the statement has run.
template <class T>
void bind_value(SQLite::Statement& statement, int place, const T& value) {
  if constexpr (kMayBeNull<T>) {
    value ? bind_value(statement, place, *value) : statement.bind(place);
  } else if constexpr (std::is_same_v<T, bool>) {
    statement.bind(place, value ? 1 : 0);
  } else if constexpr (std::is_arithmetic_v<T>) {
    statement.bind(place, value);
  } else {
    statement.bindNoCopy(place, value);
  }
}

/// Runs a statement with these values for its parameters; it is ready for the next ones then. Throws SQLite::Exception.
template <class... Values>
void run(SQLite::Statement& statement, const Values&... values) {
  int place = 0;
  (bind_value(statement, ++place, values), ...);
  statement.exec();
  statement.reset();
}

/// The same of a statement that is needed once.
template <class... Values>
void run(SQLite::Database& database, const std::string& sql, const Values&... values) {
  SQLite::Statement statement(database, sql);
  run(statement, values...);
}

}  // namespace trivela::log
