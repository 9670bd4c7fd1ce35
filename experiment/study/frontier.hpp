#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment/study/report.hpp"

namespace trivela::experiment {

/// The swept policy at one firing threshold.
struct FrontierPoint {
  double threshold = 0.0;
  ArmTally matches;
};

/// A policy without a threshold, on the same opportunities.
struct FixedPoint {
  std::string name;
  ArmTally matches;
};

struct FrontierReport {
  std::string policy{};  ///< that is swept
  StudyPlayed played{};
  std::vector<FrontierPoint> points{};  ///< thresholds rising
  std::vector<FixedPoint> fixed{};      ///< policies without a threshold
  std::optional<FixedPoint> oracle{};
};

/// A function of the arms' totals over all matches with its 95 % interval: the jackknife over matches, by match and
/// calibration (half_width_of()). No interval where the function has no finite value without one of the matches.
Effect jackknife(const std::vector<const ArmTally*>& arms,
                 const std::function<double(const std::vector<MatchTally>&)>& of);

/// A policy against the frontier at its own number of kicks. Between two thresholds the frontier is what a team gets
/// that plays some possessions with the one and the rest with the other: kicks and shots on target both linear.
struct Standing {
  std::string name;
  double from_threshold = 0.0;  ///< the kicks lie between this one ...
  double to_threshold = 0.0;    ///< ... and this one; the same where they lie beyond all
  bool within = false;          ///< they do lie between two
  Effect above;                 ///< efficiency of the frontier minus the policy's, the interval within [-1, 1]
};

/// None: a policy without kicks, or no point that kicks.
std::optional<Standing> standing_of(const FrontierReport& report, const FixedPoint& fixed);

/// The point with the most shots on target per opportunity. Throws std::invalid_argument where there is none.
const FrontierPoint& best_of(const FrontierReport& report);

/// Shots on target of best_of() over the oracle's, the interval from 0 on. Not finite where the oracle has
/// none, without an interval where it has them in one match only. Throws std::invalid_argument without an oracle.
Effect share_of_oracle(const FrontierReport& report);

std::vector<StudyRow> rows_of(const FrontierReport& report);
std::string to_text(const FrontierReport& report);
Json to_json(const FrontierReport& report);

/// On target of kicks over kicks per opportunity: the frontier as a line, the other policies with their intervals.
std::string to_svg(const FrontierReport& report);

}  // namespace trivela::experiment
