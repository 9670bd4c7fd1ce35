#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <string>
#include <vector>

namespace trivela::evaluator {

/// As the match logs of several robots are merged: keys do not collide, and a second merge changes nothing.
inline void merge(const std::filesystem::path& from, const std::filesystem::path& into) {
  SQLite::Database database(into.string(), SQLite::OPEN_READWRITE);
  database.exec("ATTACH '" + from.string() + "' AS other");
  std::vector<std::string> tables;
  SQLite::Statement names(database, "SELECT name FROM sqlite_schema WHERE type = 'table'");
  while (names.executeStep()) tables.push_back(names.getColumn(0).getString());
  for (const std::string& table : tables) {
    for (int twice = 0; twice < 2; ++twice) {
      database.exec("INSERT INTO main." + table + " SELECT * FROM other." + table +
                    " WHERE true ON CONFLICT DO NOTHING");
    }
  }
}

}  // namespace trivela::evaluator
