#include "log/file/new_file.hpp"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <sstream>
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

/// Of several that found it empty, or made it, at the same time one has it: what it writes here is for that alone.
void take(SQLite::Database& database, const LogKind& kind) {
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  if (!is_blank(database) || database.execAndGet("PRAGMA application_id").getInt() != 0)
    throw FileTaken("another process writes to it");
  database.exec(fmt::format("PRAGMA application_id = {}", kind.application_id));
  transaction.commit();
}

constexpr int kStepsACall = 20'000;  // of SQLite's machine: under a millisecond

/// While it lives, statements of the connection end where `go_on` says no.
class Asking {
 public:
  Asking(sqlite3* handle, const std::function<bool()>& go_on) : handle_(handle), go_on_(go_on) {
    sqlite3_progress_handler(handle_, kStepsACall, ask, this);
  }
  Asking(const Asking&) = delete;
  Asking& operator=(const Asking&) = delete;
  ~Asking() { sqlite3_progress_handler(handle_, 0, nullptr, nullptr); }

  bool stopped() const { return stopped_; }
  std::exception_ptr failure() const { return failure_; }

 private:
  static int ask(void* asking) {
    auto& self = *static_cast<Asking*>(asking);
    try {
      self.stopped_ = self.stopped_ || !self.go_on_();
    } catch (...) {  // SQLite, which called, knows no exceptions
      self.stopped_ = true;
      self.failure_ = std::current_exception();
    }
    return self.stopped_ ? 1 : 0;
  }

  sqlite3* handle_;
  const std::function<bool()>& go_on_;
  bool stopped_ = false;
  std::exception_ptr failure_;
};

}  // namespace

fs::path beside(const fs::path& path, const char* suffix) {
  fs::path other = path;
  other += suffix;
  return other;
}

FileTaken other_arguments(const std::filesystem::path& path, const std::string& what, const std::string& begun,
                          const std::string& asked) {
  std::istringstream there{begun}, here{asked};
  std::string theirs, ours;
  do {
    if (!std::getline(there, theirs)) theirs.clear();
    if (!std::getline(here, ours)) ours.clear();
  } while (theirs == ours && (there || here));
  return FileTaken(
      fmt::format("{}: was begun with other arguments: \"{}\" there, \"{}\" here; {} goes on with its own "
                  "alone, choose another file",
                  path.string(), theirs, ours, what));
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
    take(*database, kind);
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
  bool folded = false;
  // Another reader or writer stops the last step alone: the rows that it does not hold are in the file by then.
  for (const char* const step :
       {"PRAGMA optimize;", "PRAGMA wal_checkpoint(TRUNCATE);", "PRAGMA journal_mode = DELETE;"}) {
    const int code = database.tryExec(step);
    if (code != SQLITE_OK && (code & 0xFF) != SQLITE_BUSY) throw SQLite::Exception(database.getHandle(), code);
    folded = code == SQLITE_OK;
  }
  return folded;
}

void stoppable(SQLite::Database& database, const std::function<bool()>& go_on, const std::function<void()>& work) {
  const Asking asking(database.getHandle(), go_on);
  try {
    work();
  } catch (...) {
    if (asking.failure()) std::rethrow_exception(asking.failure());
    if (asking.stopped()) throw Stopped{};
    throw;
  }
}

}  // namespace trivela::log
