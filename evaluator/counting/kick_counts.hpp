#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluator/counting/kick_dataset.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/stats/clustered.hpp"
#include "evaluator/stats/counts/interval.hpp"
#include "evaluator/stats/paired.hpp"

namespace trivela::evaluator {

/// Of how many balls inside something was said, and of how many it was so: by the robots' observer or a person, and by
/// the simulator's truth, which matches without simulation have not.
struct ReportsOfInside {
  std::int64_t observed = 0;
  std::int64_t observed_yes = 0;
  std::int64_t truth = 0;
  std::int64_t truth_yes = 0;

  void add(std::optional<bool> seen, std::optional<bool> is) {
    observed += seen ? 1 : 0;
    observed_yes += seen.value_or(false) ? 1 : 0;
    truth += is ? 1 : 0;
    truth_yes += is.value_or(false) ? 1 : 0;
  }
  ReportsOfInside& operator+=(const ReportsOfInside& other);
  bool any() const { return observed_yes > 0 || truth_yes > 0; }
};

/// Balls inside: those that touched the floor before the line, and those that a keeper stopped.
struct InsideKicks {
  ReportsOfInside bounced;
  ReportsOfInside saved;
  std::int64_t by_people = 0;  ///< of which somebody says whether they were saved

  /// Goals are to be shown: a keeper saved something, or people say what were goals.
  bool goals() const { return saved.observed_yes > 0 || by_people > 0; }
};

/// Kicks of a policy, a group or a robot: what is inside, outside, a goal, and of how many minutes.
struct KickCounts {
  std::map<std::string, std::int64_t> kicks_by_outcome;  ///< by the label of view labelled_kicks
  stats::LabelDoubt doubt;                               ///< of the labels; 0 where the log does not say
  InsideKicks inside_kicks;
  bool blocked_apart = false;        ///< blocked kicks are neither inside nor outside
  bool by_truth = false;             ///< what was saved goes by the simulator's truth
  std::optional<double> played_min;  ///< minutes of play in the possessions in which it had the ball; none: not known

  /// A kick with the label that holds, and what was said of it if it was on target.
  void add(const std::string& label, const ReportsOfKick& said);
  /// An opportunity; without a kick it adds nothing.
  void add(const Opportunity& opportunity);
  KickCounts& operator+=(const KickCounts& other);

  std::int64_t kicks() const;
  std::int64_t of(const std::string& outcome) const;
  std::int64_t inside() const { return of("on_target"); }
  std::int64_t unknown() const { return of("unknown"); }
  std::int64_t blocked() const { return of("blocked"); }
  std::int64_t outside() const { return kicks() - inside() - unknown() - (blocked_apart ? blocked() : 0); }

  std::int64_t saved() const;
  /// Inside, and known that no keeper stopped them.
  std::int64_t goals() const { return inside() - goal_not_known() - saved(); }
  /// Inside, and not known whether a keeper stopped them.
  std::int64_t goal_not_known() const;

  /// Inside of the kicks whose outcome is known.
  stats::Counts counts() const { return {inside(), inside() + outside()}; }

  /// Efficiency if every unknown outcome was outside and as many labels as may be are wrong, and the reverse.
  stats::Interval efficiency_bounds() const { return stats::efficiency_bounds({counts(), unknown(), doubt}); }

  /// So many kicks a minute of play; none: no minutes.
  std::optional<double> per_min(std::int64_t n) const;
  std::optional<double> kicks_per_min() const { return per_min(kicks()); }
};

struct NamedInside {
  std::string name;
  InsideKicks inside;
};

/// "bounced before the line, of those inside, ...: stopped 16 of 31, moving 40 of 95" and "saved by a keeper, ...", a
/// sentence for each that says it; of saves only where there are some. Empty where nobody says anything.
std::vector<std::string> inside_lines(std::span<const NamedInside> groups);

/// {"observed": {`what`, "of"}, "truth": ...}; null where nobody says it.
Json said_json(const ReportsOfInside& said, const char* what);

/// Adds an ending: a trial, and a success if it was inside.
inline void add(stats::Counts& sum, Ending ending) {
  sum.inside += ending == Ending::kInside ? 1 : 0;
  sum.n += 1;
}
inline void add(stats::Counts& sum, stats::Counts counts) {
  sum.inside += counts.inside;
  sum.n += counts.n;
}

/// Counts of two groups by match, calibration and stratum, of opportunities or of kicks. A kick with an unknown outcome
/// is an opportunity without a shot on target, and left out of the kicks.
std::vector<stats::MatchCounts> cells_of(const KickDataset& dataset, std::uint32_t older, std::uint32_t newer,
                                         bool of_opportunities);

/// Opportunities that two groups both had: of the same match, calibration, id and setting, which a group has once.
struct PairedOpportunities {
  stats::PairedCounts counts;
  std::vector<stats::MatchCounts> cells;  ///< the same by match and calibration
  std::int64_t unpaired = 0;              ///< without a partner
};
PairedOpportunities paired_opportunities(const KickDataset& dataset, std::uint32_t older, std::uint32_t newer);

}  // namespace trivela::evaluator
