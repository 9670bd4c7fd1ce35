#include "evaluator/log/migration.hpp"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "evaluator/log/digest.hpp"
#include "evaluator/log/files_beside.hpp"
#include "evaluator/log/log_file.hpp"
#include "evaluator/log/new_file.hpp"
#include "evaluator/log/reader.hpp"
#include "evaluator/log/row_copy.hpp"
#include "evaluator/log/row_digest.hpp"
#include "evaluator/log/schema.hpp"
#include "evaluator/log/session_tallies.hpp"
#include "evaluator/log/stoppable.hpp"

namespace trivela::evaluator::log {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kTold_rows = 10'000;

/// Names of texts in the new log by those in the old one, whose version 1 named them otherwise.
using TextNames = std::map<std::string, std::string>;

TextNames copy_texts(const Reader& reader, SQLite::Database& database) {
  TextNames names;
  SQLite::Statement insert(database, "INSERT OR IGNORE INTO texts (sha256, text) VALUES (?, ?)");
  reader.query("SELECT sha256, text FROM texts", [&](const std::string& old_name, const std::string& text) {
    const std::string& name = names[old_name] = sha256(text);
    insert.reset();
    insert.bind(1, name);
    insert.bindNoCopy(2, text);
    insert.exec();
  });
  return names;
}

std::int64_t rows_of(const Reader& reader) {
  std::int64_t rows = 0;
  for (const DigestedTable& table : digested_tables()) {
    reader.query(fmt::format("SELECT count(*) FROM {}", table.name), [&](std::int64_t count) { rows += count; });
  }
  return rows;
}

void copy_rows(const Reader& reader, SQLite::Database& database, std::string_view table, const TextNames& names,
               const std::function<void()>& copied) {
  RowCopy copy(database, table);
  const std::vector<std::string>& columns = copy.columns();
  std::vector<Value> renamed;
  reader.for_each_row(table, columns, [&](std::span<const Value> row) {
    renamed.assign(row.begin(), row.end());
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool names_text = columns[i] == "config_sha256" || columns[i] == "idl_sha256";
      if (names_text) renamed[i] = names.at(std::get<std::string>(row[i]));
    }
    if (!copy.insert(renamed)) throw std::runtime_error(fmt::format("a row of {} is against the schema", table));
    copied();
  });
}

/// Everything, with a digest and tallies of each session that has ended.
void copy_log(const Reader& reader, SQLite::Database& made, const std::function<void()>& copied) {
  SQLite::Transaction transaction(made, SQLite::TransactionBehavior::IMMEDIATE);
  create_tables(made);
  const TextNames names = copy_texts(reader, made);
  copy_rows(reader, made, "experiments", names, [] {});
  for (const std::string_view table : kSaidAfterwards) copy_rows(reader, made, table, names, [] {});
  for (const DigestedTable& table : digested_tables()) copy_rows(reader, made, table.name, names, copied);
  RowDigests digests(made);
  for (const RecordedSession& session : reader.sessions()) {
    if (!session.closed_t_ns) continue;
    digests.write(session.session_id);
    write_tallies(made, session.session_id);
  }
  transaction.commit();
}

/// Folds what a killed recorder left behind into the file. Throws where somebody still has it.
void let_go(const fs::path& log) {
  const auto held = [&](const char* why) {
    return std::runtime_error(fmt::format("cannot put another log in the place of {}: {}", log.string(), why));
  };
  refuse_wal_of_another(log, LogFile(log, kMatchLog, Check::kSchema).wal());
  try {
    SQLite::Database database(log.string(), SQLite::OPEN_READWRITE);
    if (!fold(database)) throw held("a recorder or a reader has it");
  } catch (const SQLite::Exception& error) {
    throw held(error.what());
  }
}

/// The file under another name, too; where the disk knows no second names, a copy.
void keep_as(const fs::path& log, const fs::path& backup) {
  std::error_code no_links;
  fs::create_hard_link(log, backup, no_links);
  if (no_links) fs::copy_file(log, backup);
}

}  // namespace

Migrated migrate(const std::filesystem::path& from, const std::filesystem::path& to,
                 const std::function<bool(std::int64_t, std::int64_t)>& progress) {
  const Reader reader(from, Check::kWhole);
  Migrated migrated{.from_version = reader.version()};
  const std::int64_t total = rows_of(reader);
  const auto goes_on = [&] { return progress(migrated.rows, total); };
  if (!goes_on()) throw Stopped{};
  const auto database = new_file(to, kMatchLog, [&](SQLite::Database& made) {
    stoppable(made, goes_on, [&] {
      const auto copied = [&] {
        if (++migrated.rows % kTold_rows == 0 && !goes_on()) throw Stopped{};
      };
      copy_log(reader, made, copied);
    });
    migrated.sessions = made.execAndGet("SELECT count(*) FROM digests").getInt64();
  });
  fold(*database);
  return migrated;
}

fs::path backup_of(const fs::path& log) {
  const LogFile file(log, kMatchLog, Check::kSchema);
  return log.parent_path() /
         fmt::format("{}.version-{}{}", log.stem().string(), file.version(), log.extension().string());
}

Migrated migrate_in_place(const fs::path& log, const fs::path& backup,
                          const std::function<bool(std::int64_t, std::int64_t)>& progress) {
  if (LogFile(log, kMatchLog, Check::kSchema).version() == kMatchLog.version)
    throw std::runtime_error(fmt::format("{} is of version {} already", log.string(), kMatchLog.version));
  if (fs::exists(backup))
    throw FileTaken(fmt::format("{} exists already; the old log would take its place", backup.string()));
  let_go(log);
  const fs::path made = beside(log, ".migrating");
  fs::remove(made);  // of a migration that was cut off
  try {
    const Migrated migrated = migrate(log, made, progress);
    const Reader whole(made, Check::kWhole);
    if (!progress(migrated.rows, migrated.rows)) throw Stopped{};
    keep_as(log, backup);
    fs::rename(made, log);
    return migrated;
  } catch (...) {
    for (const char* const suffix : {"", "-wal", "-shm"}) fs::remove(beside(made, suffix));
    throw;
  }
}

}  // namespace trivela::evaluator::log
