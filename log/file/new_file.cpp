#include "log/file/new_file.hpp"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

namespace trivela::log {
namespace {

namespace fs = std::filesystem;

constexpr int kBusyTimeout_ms = 5000;
constexpr int kFoldTimeout_ms = 200;  // a reader that stays must not hold up the end of a match

// True: the file was made here. An empty file is as good as none; anything else may be a recorded match.
bool claim(const fs::path& path, const LogKind& kind) {
  const bool left_over = fs::exists(beside(path, "-wal"));  // looked for first: who is at work fills the file before
  const bool there = fs::exists(path);
  if (there && !(fs::is_regular_file(path) && fs::file_size(path) == 0)) {
    throw FileTaken(
        fmt::format("{} exists already; {} is never overwritten, choose another file", path.string(), kind.content));
  }
  if (left_over) {
    throw std::runtime_error(
        fmt::format("{}-wal is left over from another recording; choose another file for the log", path.string()));
  }
  if (there) return false;
  std::FILE* const file = std::fopen(path.c_str(), "wx");
  if (file == nullptr && errno == EEXIST) return false;  // who is quicker makes the tables
  if (file == nullptr) {
    throw std::runtime_error(
        fmt::format("cannot create the {} {}: {}", kind.name, path.string(), std::generic_category().message(errno)));
  }
  std::fclose(file);
  return true;
}

}  // namespace

fs::path beside(const fs::path& path, const char* suffix) {
  fs::path other = path;
  other += suffix;
  return other;
}

bool is_busy(const SQLite::Exception& error) { return (error.getErrorCode() & 0xFF) == SQLITE_BUSY; }

bool is_blank(SQLite::Database& database) {
  return database.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
}

std::unique_ptr<SQLite::Database> new_file(const fs::path& path, const LogKind& kind,
                                           const std::function<void(SQLite::Database&)>& create) {
  const bool made_here = claim(path, kind);
  const auto failed = [&](const char* why) {
    return fmt::format("cannot create the {} {}: {}", kind.name, path.string(), why);
  };
  const auto leave_nothing = [&] {
    if (!made_here) return;
    for (const char* const suffix : {"", "-wal", "-shm"}) fs::remove(beside(path, suffix));
  };
  // A file that another process works on stays, whoever has made it.
  try {
    auto database =
        std::make_unique<SQLite::Database>(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_URI, kBusyTimeout_ms);
    database->exec("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA temp_store = MEMORY;");
    if (!is_blank(*database)) throw FileTaken("another process writes to it");
    create(*database);
    database->exec("PRAGMA wal_checkpoint(TRUNCATE);");  // a copy without its -wal is at least known as what it is
    return database;
  } catch (const FileTaken& error) {
    throw FileTaken(failed(error.what()));
  } catch (const std::exception& error) {
    const auto* const sqlite = dynamic_cast<const SQLite::Exception*>(&error);
    // Who was quicker may be at the end already, and its -wal and -shm just gone, before they were opened or while.
    const int code = sqlite != nullptr ? sqlite->getErrorCode() & 0xFF : SQLITE_OK;
    const bool just_gone =
        !made_here && (code == SQLITE_CANTOPEN || code == SQLITE_IOERR) && ::access(path.c_str(), W_OK) == 0;
    if (just_gone || (sqlite != nullptr && is_busy(*sqlite))) throw FileTaken(failed(error.what()));
    leave_nothing();
    throw std::runtime_error(failed(error.what()));
  } catch (...) {
    leave_nothing();
    throw;
  }
}

bool fold(SQLite::Database& database) {
  database.setBusyTimeout(kFoldTimeout_ms);
  database.exec("PRAGMA optimize; PRAGMA wal_checkpoint(TRUNCATE);");
  const int code = database.tryExec("PRAGMA journal_mode = DELETE;");
  if (code == SQLITE_OK) return true;
  if ((code & 0xFF) == SQLITE_BUSY) return false;
  throw SQLite::Exception(database.getHandle(), code);
}

}  // namespace trivela::log
