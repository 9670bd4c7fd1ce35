#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kicking/policy/policy.hpp"

namespace trivela::config {

/// One [[arm]] of an experiment's file, see config/arms/*.toml. What it leaves out is the command line's.
struct ArmFields {
  std::string name;
  kicking::PolicyName policy = kicking::PolicyName::kMoving;
  std::string table = "new";                 ///< "new" or "old"
  std::vector<std::string> robots;           ///< robot files, robot n's at n - 1; relative to the file
  std::vector<std::string> set;              ///< settings on top, e.g. "policy.predictive.threshold = 0.4"
  std::vector<kicking::PolicyName> random;   ///< drawn for each possession, in place of `policy`
  std::vector<double> random_probabilities;  ///< of those; empty: alike
};

/// Reads an experiment's arms. Throws Error naming file, line, key and value; also for a file without arms, for two of
/// one name, and for an arm without a name.
std::vector<ArmFields> load_arms(const std::filesystem::path& path);

}  // namespace trivela::config
