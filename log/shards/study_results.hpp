#pragma once

#include <SQLiteCpp/Database.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
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

/// A count of a match by its name, which is its column's in a results file.
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

  /// The number of an arm, by `text`, all that its matches depend on but their number; `name` is for people.
  std::int64_t arm(const std::string& text, const std::string& name);

  std::map<std::uint32_t, MatchTally> matches_of(std::int64_t arm_id) const;

  /// A match that matches_of() does not have. Committed within half a second. Throws std::runtime_error naming the
  /// file where it cannot be written.
  void add(std::int64_t arm_id, std::uint32_t match_id, const MatchTally& tally);

  /// Matches of arms.
  std::int64_t size() const;

  void commit();

  /// All matches are there.
  void finish();

  /// Writes results in memory to a new file.
  void save(const std::filesystem::path& path);

 private:
  void begin();
  void written(const std::function<void()>& work) const;

  std::filesystem::path path_;
  std::string arguments_;
  std::unique_ptr<SQLite::Database> database_;
  std::optional<std::chrono::steady_clock::time_point> begun_{};  // of the matches in one transaction
};

}  // namespace trivela::log
