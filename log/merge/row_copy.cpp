#include "log/merge/row_copy.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <algorithm>
#include <variant>

#include "log/schema/schema.hpp"

namespace trivela::log {
namespace {

std::vector<std::string> names_of_columns(SQLite::Database& database, std::string_view table) {
  const auto schema = columns_of(database, table);
  std::vector<std::string> names;
  for (const Column& column : *schema) names.push_back(column.name);
  return names;
}

std::string insertion(std::string_view table, const std::vector<std::string>& columns) {
  const std::vector<std::string> places(columns.size(), "?");
  return fmt::format("INSERT INTO main.{} ({}) VALUES ({})", table, fmt::join(columns, ", "), fmt::join(places, ", "));
}

void bind_cell(SQLite::Statement& statement, int place, const Value& value) {
  if (const auto* const whole = std::get_if<std::int64_t>(&value)) return statement.bind(place, *whole);
  if (const auto* const number = std::get_if<double>(&value)) return statement.bind(place, *number);
  if (const auto* const text = std::get_if<std::string>(&value)) return statement.bindNoCopy(place, *text);
  if (const auto* const bytes = std::get_if<Blob>(&value))
    return statement.bindNoCopy(place, bytes->data(), static_cast<int>(bytes->size()));
  statement.bind(place);
}

}  // namespace

RowCopy::RowCopy(SQLite::Database& database, std::string_view table)
    : database_(database), columns_(names_of_columns(database, table)), insert_(database, insertion(table, columns_)) {}

std::size_t RowCopy::place(std::string_view column) const {
  return static_cast<std::size_t>(std::ranges::find(columns_, column) - columns_.begin());
}

bool RowCopy::insert(std::span<const Value> row) {
  insert_.tryReset();
  for (std::size_t i = 0; i < row.size(); ++i) bind_cell(insert_, static_cast<int>(i) + 1, row[i]);
  const int code = insert_.tryExecuteStep();
  insert_.tryReset();
  if (code == SQLITE_DONE) return true;
  const int primary = code & 0xFF;
  if (primary == SQLITE_CONSTRAINT || primary == SQLITE_MISMATCH) return false;
  throw SQLite::Exception(database_.getHandle(), code);
}

}  // namespace trivela::log
