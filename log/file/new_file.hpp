#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>

#include "log/schema/schema.hpp"

namespace trivela::log {

/// The path of a file beside `path`, such as its write-ahead log with `suffix` "-wal".
std::filesystem::path beside(const std::filesystem::path& path, const char* suffix);

/// Somebody else has made the file, or is about to.
struct FileTaken : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// That `path`, of `what` ("an experiment"), was begun with other arguments; the first line of them that differs.
FileTaken other_arguments(const std::filesystem::path& path, const std::string& what, const std::string& begun,
                          const std::string& asked);

/// Does another process hold the file?
bool is_busy(const SQLite::Exception& error);

/// Has the database no table yet?
bool is_blank(SQLite::Database& database);

/// Creates a log (SQLite, WAL, synchronous FULL) whose tables `create` makes, and leaves nothing behind where that
/// fails. Throws std::runtime_error naming the path where it cannot be created: FileTaken where it holds anything
/// already, or another process writes to it.
std::unique_ptr<SQLite::Database> new_file(const std::filesystem::path& path, const LogKind& kind,
                                           const std::function<void(SQLite::Database&)>& create);

/// Folds the write-ahead log into the file. False: somebody reads or writes, so that it stays beside the file.
bool fold(SQLite::Database& database);

/// Thrown where whoever is told of the progress says to stop: no error, and no file is kept.
struct Stopped {};

/// Calls `work`, which runs statements of `database`, and asks meanwhile whether to go on, within long statements as
/// well. Throws Stopped where `go_on` says no, and whatever the two throw.
void stoppable(SQLite::Database& database, const std::function<bool()>& go_on, const std::function<void()>& work);

}  // namespace trivela::log
