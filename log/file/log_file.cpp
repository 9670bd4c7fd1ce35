#include "log/file/log_file.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "log/file/ask_to_stop.hpp"
#include "log/schema/schema_check.hpp"

namespace trivela::log {
namespace {

namespace fs = std::filesystem;

constexpr int kLongestCell_B = 16 << 20;       // of a text or a blob
constexpr std::int64_t kMemory_B = 1LL << 30;  // of SQLite in this program
constexpr int kStepsALook = 100'000;           // of SQLite's machine between two looks at the budget
constexpr std::int64_t kSteps = 300'000'000;   // that any statement may take: some seconds
constexpr std::int64_t kStepsAByte = 20;       // of the file, on top; scanning takes far below one

/// The file's size with what lies in its write-ahead log.
std::uintmax_t size_of(const std::string& path) {
  std::error_code none;
  const std::uintmax_t size = fs::file_size(path, none);
  const std::uintmax_t wal = fs::file_size(path + "-wal", none);
  return size + (none ? 0 : wal);
}

/// What SQLite says of a file; where it says no more than that a match log is malformed, who says more.
RefusedLog refused(const std::string& begin, const SQLite::Exception& error, const LogKind& kind,
                   const std::string& path) {
  const bool malformed = (error.getErrorCode() & 0xFF) == SQLITE_CORRUPT;
  return {Refused::kDamaged, begin + error.what(),
          malformed && kind.application_id == kMatchLog.application_id
              ? fmt::format(": trivela doctor {} says what can be done", path)
              : ""};
}

/// `name`: as ReadableLog has it.
std::unique_ptr<SQLite::Database> connect(const std::string& name, bool damaged) {
  auto database = std::make_unique<SQLite::Database>(name, SQLite::OPEN_READONLY | SQLite::OPEN_URI, 5000);
  sqlite3* const handle = database->getHandle();
  sqlite3_hard_heap_limit64(kMemory_B);
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, kLongestCell_B);
  for (const int off : {SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_ENABLE_TRIGGER})
    sqlite3_db_config(handle, off, 0, nullptr);  // views of the connection stay
  // A file that was cut off is read by this connection, which cannot write, only where schemas count as writable.
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, damaged ? 0 : 1, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_WRITABLE_SCHEMA, damaged ? 1 : 0, nullptr);
  return database;
}

/// While it lives the connection answers SELECTs and nothing else.
class ReadingOnly {
 public:
  explicit ReadingOnly(sqlite3* handle) : handle_(handle) { sqlite3_set_authorizer(handle_, may, nullptr); }
  ~ReadingOnly() { sqlite3_set_authorizer(handle_, nullptr, nullptr); }
  ReadingOnly(const ReadingOnly&) = delete;
  ReadingOnly& operator=(const ReadingOnly&) = delete;

 private:
  static int may(void*, int action, const char*, const char*, const char*, const char*) {
    const bool reads =
        action == SQLITE_SELECT || action == SQLITE_READ || action == SQLITE_FUNCTION || action == SQLITE_RECURSIVE;
    return reads ? SQLITE_OK : SQLITE_DENY;
  }

  sqlite3* handle_;
};

/// What a log only gains, and what names whose its rows are; all of one instant, since a recorder may go on.
struct Extent {
  explicit Extent(SQLite::Database& database) {
    const SQLite::Transaction snapshot(database);
    const auto each = [&](const std::string& sql, const auto& take) {
      SQLite::Statement statement(database, sql);
      while (statement.executeStep()) take(statement);
    };
    each("PRAGMA page_count", [&](auto& row) { pages = row.getColumn(0).getInt64(); });
    std::vector<std::string> tables;
    each(
        "SELECT t.name FROM sqlite_schema AS t, pragma_table_info(t.name) AS c WHERE t.type = 'table' AND "
        "c.name = 'session_id'",
        [&](auto& row) { tables.push_back(row.getColumn(0).getString()); });
    for (const std::string& table : tables) {
      const bool names_them = table == "sessions";
      std::set<std::int64_t>& ids = names_them ? sessions : rows_of;
      const char* const columns = names_them ? "session_id, session_id" : "min(session_id), max(session_id)";
      std::string quoted;  // the file may be anybody's
      for (const char c : table) quoted += c == '"' ? "\"\"" : std::string(1, c);
      each(fmt::format("SELECT {} FROM \"{}\"", columns, quoted), [&](auto& row) {
        for (const int i : {0, 1}) {
          if (!row.getColumn(i).isNull()) ids.insert(row.getColumn(i).getInt64());
        }
      });
    }
  }

  std::int64_t pages = 0;
  std::set<std::int64_t> sessions, rows_of;
};

/// Was the write-ahead log that was read with it its own? Another's, or an older copy of its own, hides what it has.
/// `both` is looked at last: by then it has whatever a recorder has moved into the file.
bool has_what_the_file_has(SQLite::Database& both, const std::string& main_file) {
  std::optional<Extent> of_file;
  try {
    of_file.emplace(*connect(main_file, false));
  } catch (const SQLite::Exception&) {
    return true;  // it has no table yet, or a recorder is writing the page
  }
  try {
    const Extent of_both(both);
    return of_both.pages >= of_file->pages && std::ranges::includes(of_both.sessions, of_file->sessions) &&
           std::ranges::includes(of_both.sessions, of_both.rows_of);
  } catch (const SQLite::Exception& error) {
    if ((error.getErrorCode() & 0xFF) != SQLITE_CORRUPT) throw;  // a recorder has it for a moment
    return false;
  }
}

}  // namespace

Value value_of(const SQLite::Column& column) {
  if (column.isInteger()) return column.getInt64();
  if (column.isFloat()) return column.getDouble();
  if (column.isText()) return column.getString();
  if (!column.isBlob()) return std::monostate{};
  const auto* const bytes = static_cast<const std::uint8_t*>(column.getBlob());
  return Blob(bytes, bytes + column.getBytes());
}

void each_row_of(SQLite::Statement& statement, const HeadFunction& head, const RowFunction& fn) {
  std::vector<Value> row(static_cast<std::size_t>(statement.getColumnCount()));
  if (head) {
    std::vector<std::string> names(row.size());
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = statement.getColumnName(static_cast<int>(i));
    head(names);
  }
  while (statement.executeStep()) {
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = value_of(statement.getColumn(static_cast<int>(i)));
    fn(row);
  }
}

void OwnRows::each_row(std::string_view sql, const HeadFunction& head, const RowFunction& fn) const {
  SQLite::Statement statement(database_, std::string(sql));
  each_row_of(statement, head, fn);
}

struct LogFile::Budget {
  std::int64_t calls = 0;

  static int spend(void* budget) { return --static_cast<Budget*>(budget)->calls < 0 || AskToStop::says_stop() ? 1 : 0; }
};

LogFile::LogFile(const fs::path& path, const LogKind& kind, Check check)
    : kind_(kind),
      path_(path.string()),
      check_(check),
      whole_(check == Check::kWhole),
      budget_(std::make_unique<Budget>()) {
  if (fs::is_directory(path)) throw NoSuchLog(fmt::format("{} is a folder, no {}", path_, kind.name));
  if (fs::exists(path) && !fs::is_regular_file(path))
    throw NoSuchLog(fmt::format("{} is a pipe or a device, no {}", path_, kind.name));
  if (!fs::is_regular_file(path)) {
    throw NoSuchLog(fmt::format("there is no {} {}{}", kind.name, path_,
                                path.is_relative() ? " (in " + fs::current_path().string() + ")" : ""));
  }
  if (size_of(path_) == 0) throw NoSuchLog(fmt::format("{} is empty, no {}", path_, kind.name), Refused::kEmpty);
  whole_ = whole_ || (check == Check::kIfShort && size_of(path_) <= kShort_B);
  place_ = std::make_unique<ReadableLog>(path);
  try {
    open();
    this->check();
  } catch (const SQLite::Exception& error) {
    const int code = error.getErrorCode() & 0xFF;
    if (code == SQLITE_NOTADB) throw NoSuchLog(fmt::format("{} is not a {}", path_, kind.name));
    if (code == SQLITE_CORRUPT)
      throw refused(fmt::format("the {} {} is damaged: ", kind.name, path_), error, kind, path_);
    throw unreadable(error);
  }
}

LogFile::~LogFile() = default;
LogFile::LogFile(LogFile&&) noexcept = default;

RefusedLog LogFile::unreadable(const SQLite::Exception& error) const {
  const std::string begin = fmt::format("cannot read the {} {}: ", kind_.name, path_);
  if ((error.getErrorCode() & 0xFF) == SQLITE_INTERRUPT)
    return {Refused::kDamaged, begin + "it asks for more work than a file of its size can hold"};
  return refused(begin, error, kind_, path_);
}

void LogFile::allow_steps() const {
  const auto steps = kSteps + kStepsAByte * static_cast<std::int64_t>(size_of(path_));
  budget_->calls = steps / kStepsALook;
}

void LogFile::open() {
  database_ = connect(place_->name(), may_be_damaged());
  if (place_->wal() == Wal::kOfThis && !has_what_the_file_has(*database_, name_of_main_file(place_->name()))) {
    place_->leave_wal_out();
    database_ = connect(place_->name(), may_be_damaged());
  }
  sqlite3_progress_handler(database_->getHandle(), kStepsALook, Budget::spend, budget_.get());
  allow_steps();
  database_->exec("PRAGMA temp_store = MEMORY; PRAGMA cell_size_check = ON; PRAGMA ignore_check_constraints = ON;");
  const int application_id = database_->execAndGet("PRAGMA application_id").getInt();
  const int version = database_->execAndGet("PRAGMA user_version").getInt();
  for (const LogKind& other : {kMatchLog, kScanRecord}) {
    if (application_id != other.application_id || application_id == kind_.application_id) continue;
    throw NoSuchLog(fmt::format("{} is not a {} but a {}", path_, kind_.name, other.name));
  }
  if (application_id != kind_.application_id || version < 1) {
    throw NoSuchLog(fmt::format("{} is not a {}", path_, kind_.name));
  }
  if (version == kind_.version) return;
  throw RefusedLog(Refused::kOtherVersion, fmt::format("{} is a {} of version {}; this program reads version {} alone",
                                                       path_, kind_.name, version, kind_.version));
}

void LogFile::check() const {
  check_schema(*database_, kind_, path_);
  if (check_ == Check::kSchema || (!whole_ && size_of(path_) > kShort_B)) return;  // pages as they are read
  allow_steps();
  const char* const pages = whole_ ? "PRAGMA main.integrity_check(1)" : "PRAGMA main.quick_check(1)";
  const std::string said = database_->execAndGet(pages).getString();
  if (said != "ok")
    throw RefusedLog(Refused::kDamaged, fmt::format("the {} {} is damaged: {}", kind_.name, path_, said));
}

void LogFile::as_query(const std::function<void()>& work) const {
  try {
    allow_steps();
    work();
  } catch (const SQLite::Exception& error) {
    throw unreadable(error);
  }
}

void LogFile::each_row(std::string_view sql, const HeadFunction& head, const RowFunction& fn) const {
  as_query([&] {
    SQLite::Statement statement(*database_, std::string(sql));
    each_row_of(statement, sql, head, fn);
  });
}

void LogFile::each_row_of(SQLite::Statement& statement, std::string_view sql, const HeadFunction& head,
                          const RowFunction& fn) const try {
  log::each_row_of(statement, head, fn);
} catch (const WrongCell& wrong) {
  throw std::runtime_error(fmt::format("cannot read the {} {}: column {} of \"{:.100}\" is not {}", kind_.name, path_,
                                       statement.getColumnName(static_cast<int>(wrong.column)),
                                       sql.substr(0, sql.find('\n')), wrong.wanted));
}

void LogFile::ask(const std::string& sql, const HeadFunction& head, const RowFunction& fn) const {
  const ReadingOnly reading(database_->getHandle());
  sqlite3_stmt* first = nullptr;
  const char* rest = nullptr;
  const int code = sqlite3_prepare_v2(database_->getHandle(), sql.c_str(), -1, &first, &rest);
  const bool is_empty = first == nullptr;
  sqlite3_finalize(first);
  static const BadQuestion only_read("a log is only read: ask with SELECT");
  if (code == SQLITE_AUTH) throw only_read;
  if (code != SQLITE_OK) throw BadQuestion(sqlite3_errmsg(database_->getHandle()));
  if (is_empty || std::string_view(rest).find_first_not_of(" \t\r\n;") != std::string_view::npos)
    throw BadQuestion(is_empty ? "it asks nothing" : "it is more than one statement");
  budget_->calls = std::numeric_limits<std::int64_t>::max();
  try {
    SQLite::Statement statement(*database_, sql);
    each_row_of(statement, sql, head, fn);
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() == SQLITE_AUTH) throw only_read;  // VACUUM asks while it runs
    throw unreadable(error);
  }
}

std::string LogFile::not_closed() const {
  switch (wal()) {
    case Wal::kOfThis:
      return "its recorder still runs or was killed, the last rows may be missing";
    case Wal::kOfAnother:
      return "the -wal beside it is of another recording";
    case Wal::kNone:
      break;
  }
  return "no -wal lies beside it: what the recorder had not yet moved into the log is missing; copy both";
}

}  // namespace trivela::log
