#include "log/shards/study_results.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <chrono>
#include <stdexcept>

#include "log/file/files_beside.hpp"
#include "log/file/log_file.hpp"
#include "log/file/new_file.hpp"
#include "log/schema/digest.hpp"
#include "log/schema/schema_check.hpp"

namespace trivela::log {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kResultsGroup{500};  // of matches in one transaction

FileTaken taken_file(const fs::path& path, const std::string& why) {
  return FileTaken(fmt::format("{}: {}", path.string(), why));
}

/// The file of a run that was stopped, or has just begun.
std::unique_ptr<SQLite::Database> resume(const fs::path& path, const std::string& arguments) {
  refuse_wal_of_another(path, wal_beside(path));
  try {
    auto database = std::make_unique<SQLite::Database>(path.string(), SQLite::OPEN_READWRITE);
    sqlite3_db_config(database->getHandle(), SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);  // it may be somebody else's
    database->exec("PRAGMA locking_mode = EXCLUSIVE; PRAGMA journal_mode = DELETE; PRAGMA synchronous = NORMAL;");
    if (database->execAndGet("PRAGMA application_id").getInt() != kStudyResults.application_id ||
        database->execAndGet("PRAGMA user_version").getInt() != kStudyResults.version)
      throw taken_file(path, "is there already and has no study results of this version; choose another file");
    check_schema(*database, kStudyResults, path.string());
    SQLite::Statement known(*database, "SELECT arguments FROM studies");
    const std::string begun = known.executeStep() ? known.getColumn(0).getString() : "";
    if (begun != arguments) throw other_arguments(path, "a study", begun, arguments);
    return database;
  } catch (const SQLite::Exception& error) {
    if (is_busy(error)) throw taken_file(path, "another run writes to it");
    throw taken_file(path, fmt::format("is there already and has no study results: {}", error.what()));
  }
}

std::unique_ptr<SQLite::Database> open(const fs::path& path, const std::string& arguments, std::uint32_t matches) {
  const auto create = [&](SQLite::Database& database) {
    SQLite::Transaction transaction(database);
    create_study(database, {arguments, matches, false});
    transaction.commit();
  };
  if (path.empty()) {
    auto database = std::make_unique<SQLite::Database>(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    create(*database);
    return database;
  }
  const bool there = fs::exists(path) && (!fs::is_regular_file(path) || fs::file_size(path) > 0);
  if (!there) fold(*new_file(path, kStudyResults, create));
  return resume(path, arguments);
}

/// The columns of table tallies but arm_id.
std::string tally_columns() {
  std::string columns = "match_id, calibration_id";
  for (const TallyField& count : kTallyFields) columns += fmt::format(", {}", count.name);
  return columns;
}

}  // namespace

StudyResults::StudyResults(const fs::path& path, const std::string& arguments, std::uint32_t matches)
    : path_(path), arguments_(arguments), database_(open(path, arguments, matches)) {}
StudyResults::~StudyResults() = default;

void StudyResults::begin() {
  if (begun_) return;
  database_->exec("BEGIN IMMEDIATE; UPDATE main.studies SET finished = 0 WHERE finished = 1");
  begun_ = std::chrono::steady_clock::now();
}

void StudyResults::written(const std::function<void()>& work) const {
  try {
    work();
  } catch (const SQLite::Exception& error) {
    throw std::runtime_error(fmt::format("{}: results could not be written: {}", path_.string(), error.what()));
  }
}

void StudyResults::take_over(const fs::path& path) {
  std::error_code none;
  if (fs::equivalent(path, path_, none)) return;
  LogFile(path, kStudyResults, Check::kWhole).query("SELECT arguments FROM studies", [&](const std::string& theirs) {
    if (theirs != arguments_) throw std::runtime_error(fmt::format("{}: has results of another study", path.string()));
  });
  commit();
  written([&] {
    SQLite::Statement attach(*database_, "ATTACH ? AS other");
    attach.bind(1, name_of_main_file(path));
    attach.exec();
    {
      SQLite::Transaction transaction(*database_, SQLite::TransactionBehavior::IMMEDIATE);
      database_->exec(
          "INSERT OR IGNORE INTO main.arms SELECT arm_id, sha256, (SELECT count(*) FROM main.arms) + place, name FROM "
          "other.arms; INSERT OR IGNORE INTO main.tallies SELECT * FROM other.tallies");
      SQLite::Statement differs(*database_,
                                "SELECT match_id FROM (SELECT * FROM other.tallies EXCEPT SELECT * FROM main.tallies)");
      if (differs.executeStep())
        throw std::runtime_error(fmt::format("{}: says something else of match {} than the other results",
                                             path.string(), differs.getColumn(0).getInt64()));
      transaction.commit();
    }
    attach.reset();
    database_->exec("DETACH other");
  });
}

std::int64_t StudyResults::arm(const std::string& text, const std::string& name) {
  const std::string digest = sha256(text);
  const auto arm_id = static_cast<std::int64_t>(std::stoull(digest.substr(0, 16), nullptr, 16) >> 1);
  written([&] {
    SQLite::Statement known(*database_, "SELECT 1 FROM main.arms WHERE arm_id = ?");
    known.bind(1, arm_id);
    if (known.executeStep()) return;
    begin();
    SQLite::Statement insert(*database_, "INSERT INTO main.arms SELECT ?, ?, count(*), ? FROM main.arms");
    insert.bind(1, arm_id);
    insert.bind(2, digest);
    insert.bind(3, name);
    insert.exec();
  });
  return arm_id;
}

std::map<std::uint32_t, MatchTally> StudyResults::matches_of(std::int64_t arm_id) const {
  std::map<std::uint32_t, MatchTally> matches;
  SQLite::Statement select(*database_, fmt::format("SELECT {} FROM main.tallies WHERE arm_id = ?", tally_columns()));
  select.bind(1, arm_id);
  while (select.executeStep()) {
    MatchTally& tally = matches[select.getColumn(0).getUInt()];
    tally.calibration = select.getColumn(1).getUInt();
    int place = 1;
    for (const TallyField& count : kTallyFields) tally.*count.field = select.getColumn(++place).getInt64();
  }
  return matches;
}

void StudyResults::add(std::int64_t arm_id, std::uint32_t match_id, const MatchTally& tally) {
  written([&] {
    begin();
    std::string values = fmt::format("{}, {}, {}", arm_id, match_id, tally.calibration);
    for (const TallyField& count : kTallyFields) values += fmt::format(", {}", tally.*count.field);
    database_->exec(fmt::format("INSERT INTO main.tallies (arm_id, {}) VALUES ({})", tally_columns(), values));
  });
  if (std::chrono::steady_clock::now() - *begun_ >= kResultsGroup) commit();
}

std::int64_t StudyResults::size() const {
  return database_->execAndGet("SELECT count(*) FROM main.tallies").getInt64();
}

void StudyResults::commit() {
  if (!begun_) return;
  written([&] { database_->exec("COMMIT"); });
  begun_.reset();
}

void StudyResults::finish() {
  commit();
  written([&] { database_->exec("UPDATE main.studies SET finished = 1 WHERE finished = 0"); });
}

void StudyResults::save(const fs::path& path) {
  commit();
  SQLite::Statement vacuum(*database_, "VACUUM main INTO ?");
  vacuum.bind(1, path.string());
  vacuum.exec();
}

}  // namespace trivela::log
