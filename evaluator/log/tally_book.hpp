#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "evaluator/log/shard.hpp"

namespace trivela::evaluator::log {

/// What a study was asked for.
struct StudyPlan {
  std::string verb;           ///< "factorial"
  std::string arguments;      ///< everything that its rows depend on, as text
  std::uint32_t matches = 0;  ///< of each arm, of the whole study
  std::optional<Shard> shard;

  MatchRange range() const { return range_of(shard, matches); }
};

/// What one arm did in one match.
struct MatchCounts {
  std::int64_t calibration_id = 0;
  std::int64_t opportunities = 0;
  std::int64_t kicks = 0;
  std::int64_t on_target = 0;
  std::int64_t blocked = 0;
  std::int64_t bounced = 0;
  std::int64_t goals = 0;
  std::int64_t true_on_target = 0;  ///< of the simulator
};

/// A book as it is read.
struct BookArm {
  std::string name;
  std::map<std::uint32_t, MatchCounts> matches;  ///< by number
};
struct Book {
  std::string arguments;
  std::int64_t matches = 0;  ///< of each arm, when it is finished
  bool finished = false;
  std::vector<BookArm> arms;  ///< in the order in which they were asked for
};

/// A book of tallies: what a study has played so far, match by match, so that nothing is played twice, however often
/// the run is stopped. The same arms and matches make the same rows, in whatever order they come. For one thread at a
/// time, and one process: the file is locked.
class TallyBook {
 public:
  /// Makes the book, or goes on with it; without a path it is in memory until save(). Throws std::runtime_error naming
  /// the path where it cannot be written, holds something else, another run has it, or it was begun with other
  /// arguments.
  TallyBook(const std::filesystem::path& path, const StudyPlan& plan);
  ~TallyBook();
  TallyBook(const TallyBook&) = delete;
  TallyBook& operator=(const TallyBook&) = delete;

  /// Reads what another book of the same study has, too: the merged shards of the steps before. Throws
  /// std::runtime_error naming the file where it is none.
  void know(const std::filesystem::path& merged);

  /// The number of an arm; `text`: all that its matches depend on but their number.
  std::int64_t arm(const std::string& text, const std::string& name);

  /// The arm's matches that are known, by number.
  std::map<std::uint32_t, MatchCounts> matches_of(std::int64_t arm_id) const;

  /// A match that was played; in the file some tenths of a second later.
  void add(std::int64_t arm_id, std::uint32_t match_id, const MatchCounts& counts);

  /// All of it but what know() added.
  Book all() const;

  /// Matches of arms that are in the book.
  std::int64_t size() const;

  /// What was added is in the file. Throws std::runtime_error naming it where the disk refuses.
  void commit();

  /// Commits, and notes that what was asked for is there.
  void finish();

  /// Writes a book that is in memory to a new file.
  void save(const std::filesystem::path& path);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Throws std::runtime_error naming the file where it is no book, or damaged.
Book read_book(const std::filesystem::path& path);

/// Is any of the files a book of tallies?
bool any_is_tally_book(const std::vector<std::filesystem::path>& files);

/// What the shards of a study were made into.
struct MergedBooks {
  std::int64_t shards = 0;
  std::int64_t arms = 0;
  std::int64_t matches = 0;  ///< of each arm
};

/// One new book out of the shards of one study, in any order, with the rows of one run. No file is changed. Throws
/// std::runtime_error naming the file where one is no shard, of another study, damaged, not finished or behind the
/// others, where one is there twice or lacks, and where `to` exists or cannot be written, Stopped where `told(done,
/// all)` of shards says so; nothing is left behind then.
MergedBooks merge_books(const std::vector<std::filesystem::path>& files, const std::filesystem::path& to,
                        const std::function<bool(std::size_t done, std::size_t all)>& told);

}  // namespace trivela::evaluator::log
