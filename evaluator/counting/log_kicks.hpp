#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "evaluator/counting/kick_dataset.hpp"
#include "evaluator/counting/log_opportunities.hpp"

namespace trivela::evaluator {

/// What was asked for by one of the options below makes no sense with these logs; the message begins with the option.
struct BadOption : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// How to read logs for a comparison.
struct LogKicks {
  std::string by{};  ///< "policy", "table", "robot", "arm" or "log"; empty: arm where there are several, else policy,
                     ///< or log where there is one policy
  std::string stratify{};      ///< "distance", "start_distance", "robot", "half", "scenario", "table", "policy", "arm",
                               ///< "log" or none
  bool truth = false;          ///< outcomes by the simulator's truth; otherwise as observed
  bool blocked_apart = false;  ///< blocked kicks stand apart; otherwise they are outside
};

/// All sessions of the logs together, with the outcomes that they were read for: `options.truth` says which. `by`
/// becomes what is compared. Throws BadOption where the logs have not what is asked for.
KickDataset kick_dataset_of(const LoggedOpportunities& logged, const LogKicks& options, std::string& by);

}  // namespace trivela::evaluator
