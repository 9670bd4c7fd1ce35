#include "log/shards/study_results.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/VariadicBind.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
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
  const bool there = fs::exists(path) && (!fs::is_regular_file(path) || fs::file_size(path) > 0);
  if (!there) {
    fold(*new_file(path, kStudyResults, [&](SQLite::Database& database) {
      SQLite::Transaction transaction(database);
      create_study(database, arguments, matches);
      transaction.commit();
    }));
  }
  return resume(path, arguments);
}

/// What a file has, in the order of places.
std::vector<StudyResults::Arm> arms_in(SQLite::Database& database) {
  std::vector<StudyResults::Arm> arms;
  SQLite::Statement select(database, "SELECT arm_id, sha256, name FROM arms ORDER BY place");
  while (select.executeStep())
    arms.push_back({select.getColumn(0).getInt64(), select.getColumn(1).getString(), select.getColumn(2).getString()});
  SQLite::Statement played(database, "SELECT * FROM tallies WHERE arm_id = ?");
  for (StudyResults::Arm& arm : arms) {
    played.bind(1, arm.arm_id);
    while (played.executeStep()) {
      MatchTally& tally = arm.matches[played.getColumn(1).getUInt()];
      int place = 2;
      tally.calibration = played.getColumn(place).getUInt();
      for (const TallyField& count : kTallyFields) tally.*count.field = played.getColumn(++place).getInt64();
    }
    played.reset();
  }
  return arms;
}

}  // namespace

StudyResults::StudyResults(const fs::path& path, const std::string& arguments, std::uint32_t matches)
    : path_(path), arguments_(arguments), study_matches_(matches) {
  if (path.empty()) return;
  database_ = open(path, arguments, matches);
  arms_ = arms_in(*database_);
  arms_written_ = arms_.size();
}
StudyResults::~StudyResults() = default;

void StudyResults::take_over(const fs::path& path) {
  std::error_code none;
  if (fs::equivalent(path, path_, none)) return;
  const LogFile other(path, kStudyResults, Check::kWhole);
  other.query("SELECT arguments FROM studies", [&](const std::string& theirs) {
    if (theirs != arguments_) throw std::runtime_error(fmt::format("{}: has results of another study", path.string()));
  });
  std::vector<Arm> arms;
  other.as_query([&] { arms = arms_in(other.database()); });
  for (const Arm& arm : arms) {
    const auto known = std::ranges::find(arms_, arm.arm_id, &Arm::arm_id);
    if (known == arms_.end()) continue;
    for (const auto& [match, tally] : arm.matches)
      if (const auto ours = known->matches.find(match); ours != known->matches.end() && ours->second != tally)
        throw std::runtime_error(
            fmt::format("{}: says something else of match {} than the other results", path.string(), match));
  }
  for (const Arm& arm : arms) {
    const std::size_t place = place_of({arm.arm_id, arm.sha256, arm.name});
    for (const auto& [match, tally] : arm.matches)
      if (!arms_[place].matches.contains(match)) add(place, match, tally);
  }
  commit();
}

std::size_t StudyResults::arm(const std::string& text, const std::string& name) {
  const std::string digest = sha256(text);
  return place_of({static_cast<std::int64_t>(std::stoull(digest.substr(0, 16), nullptr, 16) >> 1), digest, name});
}

std::size_t StudyResults::place_of(Arm arm) {
  const auto known = std::ranges::find(arms_, arm.arm_id, &Arm::arm_id);
  const auto place = static_cast<std::size_t>(known - arms_.begin());
  if (known == arms_.end()) arms_.push_back(std::move(arm));
  return place;
}

void StudyResults::add(std::size_t arm, std::uint32_t match_id, const MatchTally& tally) {
  if (unwritten_.empty()) waits_since_ = std::chrono::steady_clock::now();
  arms_[arm].matches[match_id] = tally;
  unwritten_.emplace_back(arm, match_id);
  if (std::chrono::steady_clock::now() - waits_since_ >= kResultsGroup) commit();
}

std::int64_t StudyResults::size() const {
  std::size_t matches = 0;
  for (const Arm& arm : arms_) matches += arm.matches.size();
  return static_cast<std::int64_t>(matches);
}

void StudyResults::commit(bool finished) try {
  const bool unchanged = unwritten_.empty() && arms_written_ == arms_.size();
  if (!database_ || (unchanged && !finished)) return;
  SQLite::Transaction transaction(*database_, SQLite::TransactionBehavior::IMMEDIATE);
  SQLite::Statement insert(*database_, "INSERT INTO arms VALUES (?, ?, ?, ?)");
  for (std::size_t place = arms_written_; place < arms_.size(); ++place) {
    SQLite::bind(insert, arms_[place].arm_id, arms_[place].sha256, static_cast<std::int64_t>(place), arms_[place].name);
    insert.exec();
    insert.reset();
  }
  for (const auto& [place, match_id] : unwritten_) {
    const MatchTally& tally = arms_[place].matches.at(match_id);
    std::string values = fmt::format("{}, {}, {}", arms_[place].arm_id, match_id, tally.calibration);
    for (const TallyField& count : kTallyFields) values += fmt::format(", {}", tally.*count.field);
    database_->exec(fmt::format("INSERT INTO tallies VALUES ({})", values));
  }
  database_->exec(fmt::format("UPDATE studies SET finished = {0} WHERE finished <> {0}", finished ? 1 : 0));
  transaction.commit();
  arms_written_ = arms_.size();
  unwritten_.clear();
} catch (const SQLite::Exception& error) {
  throw std::runtime_error(fmt::format("{}: results could not be written: {}", path_.string(), error.what()));
}

void StudyResults::save(const fs::path& path) {
  path_ = path;
  database_ = open(path, arguments_, study_matches_);
  commit();
}

}  // namespace trivela::log
