#include "log/schema/schema_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "log/schema/refused_log.hpp"

namespace trivela::log {
namespace {

struct Object {
  std::string type;  // "table", "index", "view" or "trigger"
  std::string table;
  std::string sql;
};

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }

/// Where the token at `begin` ends, or the comment or space that is none.
std::size_t end_of(std::string_view sql, std::size_t begin) {
  const char first = sql[begin];
  if (is_space(first)) return begin + 1;
  if (sql.substr(begin, 2) == "--") return std::min(sql.find('\n', begin), sql.size());
  if (sql.substr(begin, 2) == "/*") {
    const auto end = sql.find("*/", begin + 2);
    return end == std::string_view::npos ? sql.size() : end + 2;
  }
  if (first == '\'' || first == '"' || first == '`' || first == '[') {
    const auto end = sql.find(first == '[' ? ']' : first, begin + 1);
    return end == std::string_view::npos ? sql.size() : end + 1;
  }
  std::size_t end = begin + 1;
  while (is_word(first) && end < sql.size() && is_word(sql[end])) ++end;
  return end;
}

bool is_token(std::string_view part) {
  return !is_space(part.front()) && !part.starts_with("--") && !part.starts_with("/*");
}

/// Without `CHECK ( ... )`.
std::vector<std::string> without_checks(const std::vector<std::string>& tokens) {
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i] != "CHECK" || i + 1 == tokens.size() || tokens[i + 1] != "(") {
      kept.push_back(tokens[i]);
      continue;
    }
    int open = 0;
    for (++i; i < tokens.size(); ++i) {
      open += tokens[i] == "(" ? 1 : tokens[i] == ")" ? -1 : 0;
      if (open == 0) break;
    }
  }
  return kept;
}

/// The tokens of a statement without comments and CHECK constraints: labels were added to those within a version, and
/// none of them changes what a query says. Quoted names and texts stay as they are.
std::vector<std::string> tokens_of(std::string_view sql) {
  std::vector<std::string> tokens;
  for (std::size_t begin = 0; begin < sql.size();) {
    const std::size_t end = end_of(sql, begin);
    const std::string_view part = sql.substr(begin, end - begin);
    if (is_token(part)) tokens.emplace_back(part);
    begin = end;
  }
  return without_checks(tokens);
}

/// Everything that a statement made, by name: what SQLite adds of itself has no statement.
std::map<std::string, Object> objects_of(SQLite::Database& database) {
  SQLite::Statement query(database, "SELECT name, type, tbl_name, sql FROM main.sqlite_schema WHERE sql IS NOT NULL");
  std::map<std::string, Object> objects;
  while (query.executeStep()) {
    objects[query.getColumn(0).getString()] = {query.getColumn(1).getString(), query.getColumn(2).getString(),
                                               query.getColumn(3).getString()};
  }
  return objects;
}

/// What this program makes.
const std::map<std::string, Object>& own_objects(const LogKind& kind) {
  static thread_local std::map<int, std::map<std::string, Object>> known;
  auto& objects = known[kind.application_id];
  if (objects.empty()) {
    SQLite::Database empty(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    empty.exec(std::string(schema_of(kind)));
    objects = objects_of(empty);
  }
  return objects;
}

/// Names of the indexes that statements made on a table.
std::vector<std::string> indexes_on(SQLite::Database& database, const std::string& table) {
  SQLite::Statement query(database, "PRAGMA main.index_list(" + table + ")");
  std::vector<std::string> names;
  while (query.executeStep()) {
    if (query.getColumn("origin").getString() == "c") names.push_back(query.getColumn("name").getString());
  }
  return names;
}

}  // namespace

void check_schema(SQLite::Database& database, const LogKind& kind, const std::string& file) {
  const auto refuse = [&](const std::string& what, Refused why = Refused::kDamaged) {
    throw RefusedLog(
        why, fmt::format("{} is no {} of version {} that can be trusted: {}", file, kind.name, kind.version, what));
  };
  // The text is compared and nothing else: asking SQLite about a table would prepare the views of the file.
  const auto found = objects_of(database);
  const auto& own = own_objects(kind);
  for (const auto& [name, object] : own) {
    if (object.type == "view") continue;  // ours are views of the connection
    const auto there = found.find(name);
    if (there == found.end()) refuse(fmt::format("it has no {} {}", object.type, name));
    if (there->second.type != object.type) {
      refuse(fmt::format("its {} is a {} and no {}", name, there->second.type, object.type));
    }
    if (tokens_of(there->second.sql) != tokens_of(object.sql)) {
      refuse(fmt::format("its {} {} is not made as in that version", object.type, name));
    }
  }
  for (const auto& [name, object] : own) {
    if (object.type != "table") continue;
    for (const std::string& index : indexes_on(database, name)) {
      if (own.contains(index)) continue;
      refuse(fmt::format("the index {} on its table {} is not of that version and could answer in the table's place; "
                         "DROP INDEX removes it",
                         index, name),
             Refused::kForeignIndex);
    }
  }
}

}  // namespace trivela::log
