#include "log/schema/stream_table.hpp"

#include <algorithm>
#include <regex>
#include <sstream>

#include "log/schema/schema.hpp"

namespace trivela::log {
namespace {

std::string comment_in(const std::string& text) {
  const auto at = text.find("-- ");
  return at == std::string::npos ? "" : text.substr(at + 3, text.find('\n', at) - at - 3);
}

/// The definition of a column as CREATE TABLE has it, from its name to the next one's.
std::string definition_of(const std::string& create, const std::string& column) {
  std::istringstream lines(create);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    const bool begins = line.size() > 2 && line.starts_with("  ") && line[2] != ' ';
    if (begins && !text.empty()) break;
    if (!text.empty() || line.starts_with("  " + column + " ")) text += line + "\n";
  }
  return text;
}

StreamColumn column_of(const std::string& create, const std::string& name, const std::string& type, bool not_null) {
  const std::string definition = definition_of(create, name);
  StreamColumn column{name, CellKind::kInteger, !not_null, {}, comment_in(definition)};
  const std::string rule = definition.substr(0, definition.find("-- "));
  if (type == "REAL") column.kind = CellKind::kNumber;
  if (type == "INTEGER" && rule.find("IN (0, 1)") != std::string::npos) column.kind = CellKind::kTruth;
  if (type != "TEXT") return column;
  static const std::regex label("= '([^']*)'");
  for (std::sregex_iterator it(rule.begin(), rule.end(), label), end; it != end; ++it)
    column.labels.push_back((*it)[1]);
  column.kind = column.labels.empty() ? CellKind::kText : CellKind::kLabel;
  return column;
}

std::vector<StreamTable> tables_of_schema() {
  SQLite::Database empty(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  empty.exec(std::string(schema_of(kMatchLog)));
  SQLite::Statement query(empty, R"(
    SELECT t.name, t.sql, c.name, c.type, c."notnull", c.pk FROM sqlite_schema t, pragma_table_info(t.name) c
    WHERE t.type = 'table' AND t.name <> 'digests'
      AND EXISTS (SELECT * FROM pragma_table_info(t.name) WHERE name = 'session_id')
    ORDER BY t.rowid, c.cid)");
  std::vector<StreamTable> tables;
  while (query.executeStep()) {
    const std::string name = query.getColumn(0).getString(), create = query.getColumn(1).getString();
    if (tables.empty() || tables.back().name != name) tables.push_back({name, "", comment_in(create), {}});
    StreamTable& table = tables.back();
    const std::string column = query.getColumn(2).getString();
    table.columns.push_back(
        column_of(create, column, query.getColumn(3).getString(), query.getColumn(4).getInt() != 0));
    // The keys of the schema name their columns in the order in which the tables have them.
    if (query.getColumn(5).getInt() > 0) table.key += (table.key.empty() ? "" : ", ") + column;
  }
  return tables;
}

}  // namespace

bool StreamTable::has(std::string_view column) const {
  return std::ranges::find(columns, column, &StreamColumn::name) != columns.end();
}

const std::vector<StreamTable>& stream_tables() {
  static const std::vector<StreamTable> tables = tables_of_schema();
  return tables;
}

}  // namespace trivela::log
