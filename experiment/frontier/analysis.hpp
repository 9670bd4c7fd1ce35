#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment/effects/effects.hpp"

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
  std::string policy;    ///< that is swept
  std::string scenario;  ///< name of its file
  std::uint64_t seed = 1;
  std::uint32_t matches = 0;
  std::uint32_t possessions = 0;      ///< opportunities a match
  std::vector<FrontierPoint> points;  ///< thresholds rising
  std::vector<FixedPoint> fixed;      ///< policies without a threshold
  std::optional<FixedPoint> oracle;
  std::size_t evenings = 0;  ///< of calibration; 0: robot files
};

double kicks_per_opportunity(const MatchTally& total);
double efficiency_of(const MatchTally& total);
double on_target_per_opportunity(const MatchTally& total);

/// A function of the arms' totals over all matches with its 95 % interval: the jackknife over matches, by match and
/// calibration (reach_of()). No interval where the function has no finite value without one of the matches.
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

}  // namespace trivela::experiment
