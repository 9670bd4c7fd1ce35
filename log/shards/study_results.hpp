#pragma once

#include <SQLiteCpp/Database.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace trivela::log {

/// What one arm did in one match.
struct MatchTally {
  std::int64_t opportunities = 0;
  std::int64_t kicks = 0;
  std::int64_t on_target = 0;       ///< observed
  std::int64_t blocked = 0;         ///< observed
  std::int64_t bounced = 0;         ///< on target, and by the simulator's truth it touched the floor before
  std::int64_t goals = 0;           ///< by the simulator's truth: on target and past the keeper, where there is one
  std::uint32_t calibration = 0;    ///< number of the calibration of its robots
  std::int64_t true_on_target = 0;  ///< by the simulator's truth; 0 where it was not counted

  bool operator==(const MatchTally&) const = default;
};

/// A count of a match by its name, which is its column's in a results file. They are in the order of the columns.
struct TallyField {
  const char* name;
  std::int64_t MatchTally::*field;
};
inline constexpr std::array kTallyFields{TallyField{"opportunities", &MatchTally::opportunities},
                                         TallyField{"kicks", &MatchTally::kicks},
                                         TallyField{"on_target", &MatchTally::on_target},
                                         TallyField{"blocked", &MatchTally::blocked},
                                         TallyField{"bounced", &MatchTally::bounced},
                                         TallyField{"goals", &MatchTally::goals},
                                         TallyField{"true_on_target", &MatchTally::true_on_target}};

/// An arm's matches, in the order of their numbers.
using ArmTally = std::vector<MatchTally>;

/// What a study, or a shard of it, has played so far, match by match: no match is played twice, however often the run
/// is stopped. The same arms and matches make the same rows, in any order. For one thread and one process at a time:
/// the file is locked.
class StudyResults {
 public:
  /// What is known of an arm.
  struct Arm {
    std::int64_t arm_id = 0;
    std::string sha256;
    std::string name;
    std::map<std::uint32_t, MatchTally> matches{};
  };

  /// Makes the file, or goes on with it; without a path the results are in memory until save(). `arguments`: everything
  /// that the rows depend on, as text; `matches` of each arm, of the whole study. Throws FileTaken naming the file
  /// where it is something else, of other arguments, or in use.
  StudyResults(const std::filesystem::path& path, const std::string& arguments, std::uint32_t matches);
  ~StudyResults();
  StudyResults(const StudyResults&) = delete;
  StudyResults& operator=(const StudyResults&) = delete;

  /// Takes over what another file of this study has. Throws std::runtime_error naming the file where it is of another
  /// study, cannot be read, or says something else of a match.
  void take_over(const std::filesystem::path& path);

  /// The place of an arm, by `text`, all that its matches depend on but their number; `name` is for people.
  std::size_t arm(const std::string& text, const std::string& name);

  const std::map<std::uint32_t, MatchTally>& matches_of(std::size_t arm) const { return arms_[arm].matches; }

  /// A match that matches_of() does not have. Written within half a second of the first one that is not, if more are
  /// added. Throws std::runtime_error naming the file where it cannot be written.
  void add(std::size_t arm, std::uint32_t match_id, const MatchTally& tally);

  /// Matches of arms.
  std::int64_t size() const;

  /// What was added is in the file. `finished`: all matches are there. Throws as add().
  void commit(bool finished = false);

  /// Writes results in memory to a new file, and goes on there.
  void save(const std::filesystem::path& path);

 private:
  std::size_t place_of(Arm arm);

  std::filesystem::path path_;
  std::string arguments_;
  std::uint32_t study_matches_;
  std::unique_ptr<SQLite::Database> database_;                    // none: in memory alone
  std::vector<Arm> arms_;                                         // by place
  std::size_t arms_written_ = 0;                                  // the first ones
  std::vector<std::pair<std::size_t, std::uint32_t>> unwritten_;  // matches by place and number
  std::chrono::steady_clock::time_point waits_since_;             // the first of them
};

}  // namespace trivela::log
