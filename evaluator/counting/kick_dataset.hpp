#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trivela::evaluator {

/// What became of an opportunity to kick.
enum class Ending : std::uint8_t {
  kNoKick,   ///< the ball was lost, or time ran out
  kInside,   ///< a kick on target: between the posts and below the bar, saves included
  kOutside,  ///< a kick that was not
  kUnknown,  ///< a kick whose outcome nobody knows
  kBlocked,  ///< a kick that was blocked, where those stand apart; otherwise it is outside
};

/// How it came that one policy played here and another there; decides what a difference may be called.
enum class Design {
  kBeforeAfter,  ///< one after the other: other matches, or always the other half
  kAlternating,  ///< in turn within the matches
  kRandomised,   ///< drawn for each possession
  kPaired,       ///< the same opportunities for each, in the simulation
};

/// "before_after", "alternating", "randomised", "paired"; and back, none for another word.
const char* label(Design design);
std::optional<Design> design_of(const std::string& label);

/// What was said of a kick on target, as observed and by the simulator's truth; none: nothing.
struct ReportsOfKick {
  std::optional<bool> bounced{}, truth_bounced{};  ///< it touched the floor before the line
  std::optional<bool> saved{}, truth_saved{};      ///< a keeper stopped it; `saved`: or so somebody says
  bool by_people = false;                          ///< somebody says of it goal or saved
};

/// One opportunity, or one kick where opportunities are not known. Numbers are places in the dataset's lists.
struct Opportunity {
  std::uint32_t group = 0;
  std::uint32_t match = 0;    ///< opportunities of a match are alike; numbered from 0
  std::uint32_t stratum = 0;  ///< situation; 0 where the dataset has no strata
  std::uint64_t id = 0;       ///< the same id in the same match: the same situation; 0: not known
  std::uint32_t setting = 0;  ///< what it was played with apart from what is compared: others make no pair
  Ending ending = Ending::kNoKick;
  std::uint32_t calibration =
      0;               ///< number of the calibration that the robots were calibrated on; 0 where none is named
  double doubt = 0.0;  ///< probability that a kick called inside was not, or one called outside was
  ReportsOfKick said{};
  std::optional<bool> saved{};  ///< a keeper stopped it, by what the ending is of
};

/// Everything that a comparison looks at, whether it comes from match logs or a table of kicks.
struct KickDataset {
  std::vector<std::string> groups;         ///< names, the baseline first
  std::vector<std::string> strata;         ///< names; empty: not stratified
  std::string stratified_by;               ///< name of the column; empty: not stratified
  bool strata_of_kicks = false;            ///< the strata are known of kicks alone, not of opportunities without one
  std::vector<Opportunity> opportunities;  ///< with `stratum` < strata.size() + 1; the last: not known
  bool has_opportunities = false;          ///< those without a kick are there, too
  std::uint32_t matches = 0;               ///< `match` is below it
  bool has_matches = false;                ///< which kick belongs to which match is known
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> minutes;  ///< of play, by group and match
  Design design = Design::kBeforeAfter;
  std::string design_reason;           ///< how the design is known
  std::vector<double> planned_shares;  ///< of the groups, where drawn at random with constant chances; else empty
  bool simulated = false;
  std::string outcome = "observed";  ///< "observed", "truth", "labelled": somebody watched, or "table"
  bool keeper = false;               ///< a keeper saved something in these matches, or people say what were goals
  bool blocked_apart = false;        ///< blocked kicks stand apart
  std::vector<std::string> remarks;  ///< sentences on what was read
};

/// Place of `name` in `names`, added where it is new.
std::uint32_t place_of(std::vector<std::string>& names, const std::string& name);

/// "under 3 m", "3 to 4 m", "4 to 5 m", "5 to 6 m", "6 m or more".
const std::vector<std::string>& distance_bins();
/// Place of a distance >= 0 in distance_bins().
std::uint32_t distance_bin(double distance_m);

/// Brings the baseline to the front, keeping the order of the others. False: there is no such group.
bool put_first(KickDataset& dataset, const std::string& baseline);

}  // namespace trivela::evaluator
