#include "log/write/experiment_log.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "log/file/files_beside.hpp"
#include "log/file/new_file.hpp"
#include "log/schema/bind.hpp"
#include "log/schema/digest.hpp"
#include "log/schema/row_digest.hpp"
#include "log/schema/schema.hpp"
#include "log/schema/schema_check.hpp"

namespace trivela::log {
namespace {

namespace fs = std::filesystem;

constexpr int kOtherRunTimeout_ms = 5000;
constexpr std::chrono::milliseconds kGroup{200};  // of matches in one transaction

FileTaken taken(const fs::path& path, const std::string& why) {
  return FileTaken(fmt::format("{}: {}", path.string(), why));
}

std::runtime_error not_written(const fs::path& path, const std::string& what, const SQLite::Exception& error) {
  return std::runtime_error(fmt::format("{}: {} could not be written: {}", path.string(), what, error.what()));
}

FileTaken in_use(const fs::path& path) { return taken(path, "another run writes to it"); }

void make(const fs::path& path, const Experiment& experiment) {
  try {
    new_file(path, kMatchLog, [&](SQLite::Database& database) {
      SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
      if (!is_blank(database)) throw FileTaken("another run has begun");
      create_tables(database);
      run(database, "INSERT INTO experiments VALUES (?, ?, ?, 0)", sha256(experiment.arguments), experiment.arguments,
          experiment.matches);
      transaction.commit();
    });
  } catch (const FileTaken&) {
    throw in_use(path);
  }
}

/// Throws unless the log is that of the experiment.
void check(SQLite::Database& database, const fs::path& path, const Experiment& experiment) {
  SQLite::Statement known(database, "SELECT arguments, matches FROM experiments");
  if (!known.executeStep()) throw taken(path, "is a recorded match and no experiment; choose another file");
  if (const std::string begun = known.getColumn(0); begun != experiment.arguments)
    throw other_arguments(path, "an experiment", begun, experiment.arguments);
  if (const std::int64_t matches = known.getColumn(1); matches != experiment.matches)
    throw other_arguments(path, "an experiment", fmt::format("matches = {}", matches),
                          fmt::format("matches = {}", experiment.matches));
}

/// The log of a run that was stopped, or has just begun.
std::unique_ptr<SQLite::Database> resume(const fs::path& path, const Experiment& experiment) {
  refuse_wal_of_another(path, wal_beside(path));
  try {
    auto database = std::make_unique<SQLite::Database>(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_NOMUTEX,
                                                       kOtherRunTimeout_ms);
    sqlite3_db_config(database->getHandle(), SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);  // it may be somebody else's
    if (is_blank(*database)) throw taken(path, "another run writes to it, or was killed when it had just begun");
    const bool ours = database->execAndGet("PRAGMA application_id").getInt() == kMatchLog.application_id &&
                      database->execAndGet("PRAGMA user_version").getInt() == kMatchLog.version;
    if (!ours) throw taken(path, "is there already and is no log of an experiment; choose another file");
    check_schema(*database, kMatchLog, path.string());
    check(*database, path, experiment);
    database->exec("PRAGMA journal_mode = WAL; PRAGMA temp_store = MEMORY;");
    return database;
  } catch (const SQLite::Exception& error) {
    if (is_busy(error)) throw in_use(path);
    throw taken(path, fmt::format("is there already and is no log that can be gone on with: {}", error.what()));
  }
}

std::unique_ptr<SQLite::Database> open(const fs::path& path, const Experiment& experiment) {
  const bool there = fs::exists(path);
  if (there && !fs::is_regular_file(path)) throw taken(path, "is no file; choose another");
  const bool begun = there && fs::file_size(path) > 0;
  if (!begun) make(path, experiment);
  auto database = resume(path, experiment);
  // A match that a power cut takes is played again: no commit waits for the disk.
  database->exec("PRAGMA synchronous = NORMAL; PRAGMA cache_size = -65536; PRAGMA wal_autocheckpoint = 8000;");
  return database;
}

}  // namespace

std::string experiment_uuid(std::string_view arguments_sha256, std::uint32_t match_id, std::uint32_t arm) {
  if (match_id >= (1u << 20) || arm >= kMostArms)
    throw std::out_of_range("an experiment has 2^20 matches and 128 arms");
  // The last bit before the variant is not part of session_id.
  return fmt::format("{}-{:04x}-8{:03x}-8{}-{}", arguments_sha256.substr(0, 8), match_id >> 4,
                     (match_id & 15) << 8 | arm << 1, arguments_sha256.substr(8, 3), arguments_sha256.substr(11, 12));
}

struct ExperimentLog::Impl final : RowSink {
  struct Table {
    std::string name;
    std::vector<std::string> columns;
    std::unique_ptr<SQLite::Statement> insert;
  };

  Impl(const fs::path& file, const Experiment& asked) : path(file), database(open(file, asked)) {}

  void integer(std::int64_t value) override { statement->bind(++cell, value); }
  void number(double value) override {
    ++cell;
    if (!std::isnan(value)) statement->bind(cell, value);
  }
  void text(const char* value) override { statement->bindNoCopy(++cell, value); }

  fs::path path;
  std::unique_ptr<SQLite::Database> database;
  std::vector<Table> tables;
  Digests digests;  // of the arms' configurations
  RowDigests row_digests{*database};
  std::vector<std::int64_t> sessions;  // of the match under way
  std::optional<SQLite::Transaction> transaction;
  std::chrono::steady_clock::time_point begun;
  SQLite::Statement* statement = nullptr;  // of the row under way
  int cell = 0;
};

ExperimentLog::ExperimentLog(const fs::path& path, const Experiment& experiment)
    : impl_(std::make_unique<Impl>(path, experiment)),
      matches_done_(impl_->database->execAndGet("SELECT matches_done FROM experiments").getInt64()) {}

ExperimentLog::~ExperimentLog() = default;

std::size_t ExperimentLog::table(std::string_view name, const std::vector<std::string>& columns) {
  const auto schema = columns_of(*impl_->database, name);
  if (!schema) throw std::runtime_error(fmt::format("the match log has no table '{}'", name));
  for (const std::string& column : columns) {
    if (std::ranges::find(*schema, column, &Column::name) != schema->end()) continue;
    throw std::runtime_error(fmt::format("table '{}' of the match log has no column '{}'", name, column));
  }
  std::string sql = fmt::format("INSERT INTO {} (session_id, {}) VALUES (?", name, fmt::join(columns, ", "));
  for (std::size_t i = 0; i < columns.size(); ++i) sql += ", ?";
  impl_->tables.push_back(
      {std::string(name), columns, std::make_unique<SQLite::Statement>(*impl_->database, sql + ")")});
  return impl_->tables.size() - 1;
}

void ExperimentLog::begin() {
  if (impl_->transaction) return;
  impl_->begun = std::chrono::steady_clock::now();
  try {
    impl_->transaction.emplace(*impl_->database, SQLite::TransactionBehavior::IMMEDIATE);
  } catch (const SQLite::Exception& error) {
    if (is_busy(error)) throw in_use(impl_->path);
    throw;
  }
  if (impl_->database->execAndGet("SELECT matches_done FROM experiments").getInt64() == matches_done_) return;
  throw in_use(impl_->path);
}

std::int64_t ExperimentLog::add_session(const Session& session, std::int64_t closed_t_ns) {
  insert_session(*impl_->database, session, closed_t_ns, impl_->digests);
  impl_->sessions.push_back(session_id_of(session.uuid));
  return impl_->sessions.back();
}

RowSink& ExperimentLog::row(std::size_t table, std::int64_t session_id) {
  impl_->statement = impl_->tables[table].insert.get();
  impl_->statement->clearBindings();
  impl_->cell = 0;
  impl_->integer(session_id);
  return *impl_;
}

void ExperimentLog::end_row() {
  try {
    impl_->statement->exec();
    impl_->statement->reset();
  } catch (const SQLite::Exception& error) {
    throw not_written(impl_->path, "a row", error);
  }
}

void ExperimentLog::end_match() {
  for (const std::int64_t session_id : impl_->sessions) impl_->row_digests.write(session_id);
  impl_->sessions.clear();
  ++matches_done_;
  if (std::chrono::steady_clock::now() - impl_->begun >= kGroup) commit();
}

void ExperimentLog::commit() {
  if (!impl_->transaction) return;
  try {
    impl_->database->exec(fmt::format("UPDATE experiments SET matches_done = {}", matches_done_));
    impl_->transaction->commit();
  } catch (const SQLite::Exception& error) {
    throw not_written(impl_->path, "matches", error);
  }
  impl_->transaction.reset();
}

void ExperimentLog::finish() {
  impl_->tables.clear();
  impl_->row_digests.close();
  fold(*impl_->database);
}

}  // namespace trivela::log
