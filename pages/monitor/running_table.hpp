#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evaluator/stats/counts/counts.hpp"
#include "pages/monitor/kick_ledger.hpp"

namespace trivela::pages {

/// A row of Table 2 while the match goes on.
struct RunningRow {
  std::string policy;  ///< "not received": of kicks whose decision was not
  KickTally kicks;
  evaluator::stats::Interval interval{0.0, 1.0};  ///< 95 %, of the part inside; holds at every look at once

  /// Inside, of the kicks whose outcome is known.
  evaluator::stats::Counts counts() const { return {kicks.inside, kicks.inside + kicks.outside}; }
};

/// The first two policies that have a kick with a known outcome: newer less older.
struct RunningDifference {
  std::string older;
  std::string newer;
  double value = 0.0;
  evaluator::stats::Interval interval{-1.0, 1.0};  ///< 95 %, holds at every look at once
};

struct RunningTable {
  std::vector<RunningRow> rows;  ///< in the order of the policies
  std::optional<RunningDifference> difference;
};

/// With the intervals of evaluator/stats/confidence_sequence.hpp: whoever looks after each kick, and stops when they
/// like, errs in no more than 5 % of matches. Of the difference that holds however the policy of the next kick
/// is chosen, as long as nobody chooses it by the situation.
RunningTable running_table(const std::map<std::optional<PolicyLabel>, KickTally>& tallies);

}  // namespace trivela::pages
