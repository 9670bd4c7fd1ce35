#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
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

/// A count of a match by its name, in the order of a results file.
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

/// Matches of an arm that are known, by their number.
using MatchesByNumber = std::map<std::uint32_t, MatchTally>;

/// The first line of a results file. Then come the arguments, "= " before each line, and a line a match: arm, match,
/// calibration, and the counts in the order of kTallyFields.
inline constexpr std::string_view kStudyResultsBegin = "trivela study results 1\n";

/// What a study, or a shard of it, has played so far, match by match: no match is played twice, however often the run
/// is stopped. The same arms and matches make the same lines, in any order. For one thread and one process at a time:
/// the file is locked.
class StudyResults {
 public:
  /// Makes the file, or goes on with it; without a path the results are in memory until save(). `arguments`: everything
  /// that the matches depend on, as lines of text. Throws FileTaken naming the file where it is something else, of
  /// other arguments, or in use, std::runtime_error where it cannot be read or written.
  StudyResults(const std::filesystem::path& path, const std::string& arguments);
  ~StudyResults();
  StudyResults(const StudyResults&) = delete;
  StudyResults& operator=(const StudyResults&) = delete;

  /// Takes over what another file of this study has. Throws std::runtime_error naming the file where it is of another
  /// study, cannot be read, or says something else of a match.
  void take_over(const std::filesystem::path& path);

  /// The name of an arm in the file, by `text`, all that its matches depend on but their number.
  static std::string arm(const std::string& text);

  const MatchesByNumber& matches_of(const std::string& arm) { return arms_[arm]; }

  /// A match that matches_of() does not have. Written half a second after what was written last, if more are added.
  /// Throws std::runtime_error naming the file where it cannot be written.
  void add(const std::string& arm, std::uint32_t match_id, const MatchTally& tally);

  /// Matches of arms.
  std::size_t size() const;

  /// What was added is in the file, and on the disk. Throws as add().
  void commit();

  /// Writes results in memory to a new file, and goes on there. Throws as the constructor.
  void save(const std::filesystem::path& path);

 private:
  std::filesystem::path path_;
  std::string arguments_;
  int file_ = -1;  // none: in memory alone
  std::map<std::string, MatchesByNumber> arms_;
  std::string unwritten_;  // whole lines
  std::chrono::steady_clock::time_point written_at_{};
};

}  // namespace trivela::log
