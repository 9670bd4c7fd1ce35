#include "evaluator/log/tally_book.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <chrono>
#include <stdexcept>

#include "evaluator/log/digest.hpp"
#include "evaluator/log/files_beside.hpp"
#include "evaluator/log/log_file.hpp"
#include "evaluator/log/new_file.hpp"
#include "evaluator/log/own_rows.hpp"
#include "evaluator/log/schema_check.hpp"

namespace trivela::evaluator::log {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kBookGroup{500};  // of matches in one transaction

FileTaken taken_book(const fs::path& path, const std::string& why) {
  return FileTaken(fmt::format("{}: {}", path.string(), why));
}

std::string arguments_of(const StudyPlan& plan) {
  return plan.shard ? stamped_arguments({plan.arguments, *plan.shard, plan.matches}) : plan.arguments;
}

void new_book(SQLite::Database& database, const StudyPlan& plan) {
  SQLite::Transaction transaction(database);
  create_book(database, {arguments_of(plan), plan.range().size(), false});
  transaction.commit();
}

/// The book of a run that was stopped, or has just begun.
std::unique_ptr<SQLite::Database> resume_book(const fs::path& path, const StudyPlan& plan) {
  refuse_wal_of_another(path, wal_beside(path));
  try {
    auto database = std::make_unique<SQLite::Database>(path.string(), SQLite::OPEN_READWRITE);
    sqlite3_db_config(database->getHandle(), SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);  // it may be somebody else's
    database->exec("PRAGMA locking_mode = EXCLUSIVE; PRAGMA journal_mode = DELETE; PRAGMA synchronous = NORMAL;");
    if (database->execAndGet("PRAGMA application_id").getInt() != kTallyBook.application_id ||
        database->execAndGet("PRAGMA user_version").getInt() != kTallyBook.version)
      throw taken_book(path, "is there already and is no book of tallies of this version; choose another file");
    check_schema(*database, kTallyBook, path.string());
    SQLite::Statement known(*database, "SELECT arguments_sha256, matches FROM studies");
    if (!known.executeStep() || known.getColumn(0).getString() != sha256(arguments_of(plan)) ||
        known.getColumn(1).getInt64() != plan.range().size())
      throw taken_book(path,
                       "was begun with other arguments (table studies says which); a study goes on with its own alone, "
                       "choose another file");
    return database;
  } catch (const SQLite::Exception& error) {
    if (is_busy(error)) throw taken_book(path, "another run writes to it");
    throw taken_book(path, fmt::format("is there already and is no book of tallies: {}", error.what()));
  }
}

std::unique_ptr<SQLite::Database> open_book(const fs::path& path, const StudyPlan& plan) {
  if (path.empty()) {
    auto database = std::make_unique<SQLite::Database>(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    new_book(*database, plan);
    return database;
  }
  const bool there = fs::exists(path) && (!fs::is_regular_file(path) || fs::file_size(path) > 0);
  if (!there) fold(*new_file(path, kTallyBook, [&](SQLite::Database& database) { new_book(database, plan); }));
  return resume_book(path, plan);
}

constexpr const char* kCountColumns =
    "match_id, calibration_id, opportunities, kicks, on_target, blocked, bounced, goals, true_on_target";

Book book_in(const Queries& rows) {
  Book book;
  rows.query("SELECT arguments, matches, finished FROM main.studies",
             [&](const std::string& arguments, std::int64_t matches, bool finished) {
               book.arguments = arguments;
               book.matches = matches;
               book.finished = finished;
             });
  std::map<std::int64_t, std::size_t> places;
  rows.query("SELECT arm_id, name FROM main.arms ORDER BY place, arm_id",
             [&](std::int64_t arm_id, const std::string& name) {
               places[arm_id] = book.arms.size();
               book.arms.push_back({name, {}});
             });
  rows.query(fmt::format("SELECT arm_id, {} FROM main.tallies ORDER BY arm_id, match_id", kCountColumns),
             [&](std::int64_t arm_id, std::uint32_t match_id, std::int64_t calibration_id, std::int64_t opportunities,
                 std::int64_t kicks, std::int64_t on_target, std::int64_t blocked, std::int64_t bounced,
                 std::int64_t goals, std::int64_t true_on_target) {
               const auto place = places.find(arm_id);
               if (place == places.end()) return;
               book.arms[place->second].matches[match_id] = {calibration_id, opportunities, kicks, on_target,
                                                             blocked,        bounced,       goals, true_on_target};
             });
  return book;
}

}  // namespace

struct TallyBook::Impl {
  Impl(const fs::path& file, const StudyPlan& asked)
      : path(file),
        plan(asked),
        database(open_book(file, asked)),
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
      throw std::runtime_error(fmt::format("{}: tallies could not be written: {}", path.string(), error.what()));
    }
  }

  fs::path path;
  StudyPlan plan;
  std::unique_ptr<SQLite::Database> database;
  SQLite::Statement insert;
  std::optional<SQLite::Transaction> transaction;
  std::chrono::steady_clock::time_point begun;
  std::unique_ptr<SQLite::Database> known;  // the merged book
};

TallyBook::TallyBook(const fs::path& path, const StudyPlan& plan) : impl_(std::make_unique<Impl>(path, plan)) {}
TallyBook::~TallyBook() = default;

void TallyBook::know(const fs::path& merged) {
  LogFile(merged, kTallyBook, Check::kWhole).query("SELECT arguments FROM studies", [&](const std::string& arguments) {
    if (arguments != impl_->plan.arguments)
      throw std::runtime_error(fmt::format(
          "{}: is no merged book of this study: it was begun with other arguments, or is a shard", merged.string()));
  });
  impl_->known = std::make_unique<SQLite::Database>(name_of_main_file(merged),
                                                    SQLite::OPEN_READONLY | SQLite::OPEN_URI);  // many shards read it
}

std::int64_t TallyBook::arm(const std::string& text, const std::string& name) {
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

std::map<std::uint32_t, MatchCounts> TallyBook::matches_of(std::int64_t arm_id) const {
  std::map<std::uint32_t, MatchCounts> matches;
  for (SQLite::Database* const book : {impl_->database.get(), impl_->known.get()}) {
    if (book == nullptr) continue;
    SQLite::Statement select(*book, fmt::format("SELECT {} FROM main.tallies WHERE arm_id = ?", kCountColumns));
    select.bind(1, arm_id);
    while (select.executeStep()) {
      const auto cell = [&](int i) { return select.getColumn(i).getInt64(); };
      matches[static_cast<std::uint32_t>(cell(0))] = {cell(1), cell(2), cell(3), cell(4),
                                                      cell(5), cell(6), cell(7), cell(8)};
    }
  }
  return matches;
}

Book TallyBook::all() const { return book_in(OwnRows(*impl_->database)); }

Book read_book(const fs::path& path) { return book_in(LogFile(path, kTallyBook, Check::kWhole)); }

void TallyBook::add(std::int64_t arm_id, std::uint32_t match_id, const MatchCounts& counts) {
  impl_->written([&] {
    impl_->begin();
    int place = 0;
    const auto bind = [&](auto... values) { (impl_->insert.bind(++place, values), ...); };
    impl_->insert.reset();
    bind(arm_id, std::int64_t{match_id}, counts.calibration_id, counts.opportunities, counts.kicks, counts.on_target,
         counts.blocked, counts.bounced, counts.goals, counts.true_on_target);
    impl_->insert.exec();
    impl_->insert.reset();
  });
  if (std::chrono::steady_clock::now() - impl_->begun >= kBookGroup) commit();
}

std::int64_t TallyBook::size() const {
  return impl_->database->execAndGet("SELECT count(*) FROM main.tallies").getInt64();
}

void TallyBook::commit() {
  if (!impl_->transaction) return;
  impl_->written([&] { impl_->transaction->commit(); });
  impl_->transaction.reset();
}

void TallyBook::finish() {
  commit();
  impl_->written([&] { impl_->database->exec("UPDATE main.studies SET finished = 1 WHERE finished = 0"); });
}

void TallyBook::save(const fs::path& path) {
  commit();
  SQLite::Statement vacuum(*impl_->database, "VACUUM main INTO ?");
  vacuum.bind(1, path.string());
  vacuum.exec();
}

}  // namespace trivela::evaluator::log
