#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <functional>
#include <memory>

#include "evaluator/log/schema.hpp"

namespace trivela::evaluator::log {

/// The path of a file beside `path`, such as its write-ahead log with `suffix` "-wal".
std::filesystem::path beside(const std::filesystem::path& path, const char* suffix);

/// Creates a log (SQLite, WAL, synchronous FULL) whose tables `create` makes, and leaves nothing behind where that
/// fails. Throws std::runtime_error naming the path where it cannot be created, or where it holds anything already.
std::unique_ptr<SQLite::Database> new_file(const std::filesystem::path& path, const LogKind& kind,
                                           const std::function<void(SQLite::Database&)>& create);

/// Folds the write-ahead log into the file. False: a reader holds it, so that it stays beside the file.
bool fold(SQLite::Database& database);

}  // namespace trivela::evaluator::log
