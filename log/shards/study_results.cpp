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

std::string arguments_of(const StudyPlan& plan) {
  return plan.shard ? stamped_arguments({plan.arguments, *plan.shard, plan.matches}) : plan.arguments;
}

void create(SQLite::Database& database, const StudyPlan& plan) {
  SQLite::Transaction transaction(database);
  create_study(database, {arguments_of(plan), plan.range().size(), false});
  transaction.commit();
}

/// The file of a run that was stopped, or has just begun.
std::unique_ptr<SQLite::Database> resume(const fs::path& path, const StudyPlan& plan) {
  refuse_wal_of_another(path, wal_beside(path));
  try {
    auto database = std::make_unique<SQLite::Database>(path.string(), SQLite::OPEN_READWRITE);
    sqlite3_db_config(database->getHandle(), SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);  // it may be somebody else's
    database->exec("PRAGMA locking_mode = EXCLUSIVE; PRAGMA journal_mode = DELETE; PRAGMA synchronous = NORMAL;");
    if (database->execAndGet("PRAGMA application_id").getInt() != kStudyResults.application_id ||
        database->execAndGet("PRAGMA user_version").getInt() != kStudyResults.version)
      throw taken_file(path, "is there already and has no study results of this version; choose another file");
    check_schema(*database, kStudyResults, path.string());
    SQLite::Statement known(*database, "SELECT arguments, matches FROM studies");
    const bool begun = known.executeStep();
    const std::string arguments = begun ? known.getColumn(0).getString() : "";
    if (arguments != arguments_of(plan)) throw other_arguments(path, "a study", arguments, arguments_of(plan));
    if (const std::int64_t matches = known.getColumn(1); matches != plan.range().size())
      throw other_arguments(path, "a study", fmt::format("matches = {}", matches),
                            fmt::format("matches = {}", plan.range().size()));
    return database;
  } catch (const SQLite::Exception& error) {
    if (is_busy(error)) throw taken_file(path, "another run writes to it");
    throw taken_file(path, fmt::format("is there already and has no study results: {}", error.what()));
  }
}

std::unique_ptr<SQLite::Database> open(const fs::path& path, const StudyPlan& plan) {
  if (path.empty()) {
    auto database = std::make_unique<SQLite::Database>(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    create(*database, plan);
    return database;
  }
  const bool there = fs::exists(path) && (!fs::is_regular_file(path) || fs::file_size(path) > 0);
  if (!there) fold(*new_file(path, kStudyResults, [&](SQLite::Database& database) { create(database, plan); }));
  return resume(path, plan);
}

constexpr const char* kCountColumns =
    "match_id, calibration_id, opportunities, kicks, on_target, blocked, bounced, goals, true_on_target";

/// The counts as a row value of the table `name`.
std::string qualified(const std::string& name) {
  return fmt::format(
      "{0}.calibration_id, {0}.opportunities, {0}.kicks, {0}.on_target, {0}.blocked, {0}.bounced, {0}.goals, "
      "{0}.true_on_target",
      name);
}

}  // namespace

struct StudyResults::Impl {
  Impl(const fs::path& file, const StudyPlan& asked)
      : path(file),
        plan(asked),
        database(open(file, asked)),
        insert(*database, fmt::format("INSERT INTO main.tallies (arm_id, {}) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                                      kCountColumns)) {}

  void begin() {
    if (transaction) return;
    begun = std::chrono::steady_clock::now();
    transaction.emplace(*database, SQLite::TransactionBehavior::IMMEDIATE);
    database->exec("UPDATE main.studies SET finished = 0 WHERE finished = 1");
  }

  void written(const std::function<void()>& work) const {
    try {
      work();
    } catch (const SQLite::Exception& error) {
      throw std::runtime_error(fmt::format("{}: results could not be written: {}", path.string(), error.what()));
    }
  }

  fs::path path;
  StudyPlan plan;
  std::unique_ptr<SQLite::Database> database;
  SQLite::Statement insert;
  std::optional<SQLite::Transaction> transaction;
  std::chrono::steady_clock::time_point begun;
};

StudyResults::StudyResults(const fs::path& path, const StudyPlan& plan) : impl_(std::make_unique<Impl>(path, plan)) {}
StudyResults::~StudyResults() = default;

void StudyResults::take_over(const fs::path& path) {
  std::error_code none;
  if (fs::equivalent(path, impl_->path, none)) return;
  LogFile(path, kStudyResults, Check::kWhole).query("SELECT arguments FROM studies", [&](const std::string& arguments) {
    const auto stamp = stamp_of(arguments);
    if ((stamp ? stamp->arguments : arguments) != impl_->plan.arguments ||
        (stamp && stamp->matches != impl_->plan.matches))
      throw std::runtime_error(fmt::format("{}: has results of another study", path.string()));
  });
  commit();
  impl_->written([&] {
    SQLite::Database& database = *impl_->database;
    SQLite::Statement attach(database, "ATTACH ? AS other");
    attach.bind(1, name_of_main_file(path));
    attach.exec();
    SQLite::Statement differs(database, fmt::format("SELECT m.match_id FROM main.tallies AS m JOIN other.tallies AS o "
                                                    "USING (arm_id, match_id) WHERE ({0}) IS NOT ({1}) LIMIT 1",
                                                    qualified("m"), qualified("o")));
    if (differs.executeStep())
      throw std::runtime_error(fmt::format("{}: says something else of match {} than the other results", path.string(),
                                           differs.getColumn(0).getInt64()));
    SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
    database.exec(
        "INSERT OR IGNORE INTO main.arms SELECT arm_id, sha256, (SELECT count(*) FROM main.arms) + place, name FROM "
        "other.arms");
    database.exec("INSERT OR IGNORE INTO main.tallies SELECT * FROM other.tallies");
    transaction.commit();
    differs.reset();
    attach.reset();
    database.exec("DETACH other");
  });
}

std::int64_t StudyResults::arm(const std::string& text, const std::string& name) {
  const std::string digest = sha256(text);
  const auto arm_id = static_cast<std::int64_t>(std::stoull(digest.substr(0, 16), nullptr, 16) >> 1);
  impl_->written([&] {
    SQLite::Statement known(*impl_->database, "SELECT 1 FROM main.arms WHERE arm_id = ?");
    known.bind(1, arm_id);
    if (known.executeStep()) return;
    impl_->begin();
    SQLite::Statement insert(*impl_->database, "INSERT INTO main.arms SELECT ?, ?, count(*), ? FROM main.arms");
    insert.bind(1, arm_id);
    insert.bind(2, digest);
    insert.bind(3, name);
    insert.exec();
  });
  return arm_id;
}

std::map<std::uint32_t, MatchTally> StudyResults::matches_of(std::int64_t arm_id) const {
  std::map<std::uint32_t, MatchTally> matches;
  SQLite::Statement select(*impl_->database,
                           fmt::format("SELECT {} FROM main.tallies WHERE arm_id = ?", kCountColumns));
  select.bind(1, arm_id);
  while (select.executeStep()) {
    const auto cell = [&](const char* column) { return select.getColumn(column).getInt64(); };
    matches[static_cast<std::uint32_t>(cell("match_id"))] = {
        .opportunities = cell("opportunities"),
        .kicks = cell("kicks"),
        .on_target = cell("on_target"),
        .blocked = cell("blocked"),
        .bounced = cell("bounced"),
        .goals = cell("goals"),
        .calibration = static_cast<std::uint32_t>(cell("calibration_id")),
        .true_on_target = cell("true_on_target")};
  }
  return matches;
}

void StudyResults::add(std::int64_t arm_id, std::uint32_t match_id, const MatchTally& tally) {
  impl_->written([&] {
    impl_->begin();
    int place = 0;
    const auto bind = [&](auto... values) { (impl_->insert.bind(++place, values), ...); };
    impl_->insert.reset();
    bind(arm_id, std::int64_t{match_id}, std::int64_t{tally.calibration}, tally.opportunities, tally.kicks,
         tally.on_target, tally.blocked, tally.bounced, tally.goals, tally.true_on_target);
    impl_->insert.exec();
    impl_->insert.reset();
  });
  if (std::chrono::steady_clock::now() - impl_->begun >= kResultsGroup) commit();
}

std::int64_t StudyResults::size() const {
  return impl_->database->execAndGet("SELECT count(*) FROM main.tallies").getInt64();
}

void StudyResults::commit() {
  if (!impl_->transaction) return;
  impl_->written([&] { impl_->transaction->commit(); });
  impl_->transaction.reset();
}

void StudyResults::finish() {
  commit();
  impl_->written([&] { impl_->database->exec("UPDATE main.studies SET finished = 1 WHERE finished = 0"); });
}

void StudyResults::save(const fs::path& path) {
  commit();
  SQLite::Statement vacuum(*impl_->database, "VACUUM main INTO ?");
  vacuum.bind(1, path.string());
  vacuum.exec();
}

}  // namespace trivela::log
