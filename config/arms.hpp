#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/settings.hpp"
#include "kicking/policy/policy.hpp"

namespace trivela::config {

/// A setting on top of others, e.g. "policy.predictive.threshold = 0.4", and where it stands, for messages.
struct SettingLine {
  std::string text;
  std::string place;
};

/// One [[arm]] of an experiment's file, see config/arms/*.toml. What it leaves out is the command line's.
struct ArmFields {
  std::string name;
  std::optional<kicking::PolicyName> policy;  ///< none, and `random` empty: the settings say who plays
  std::string table = "new";                  ///< "new" or "old"
  std::vector<std::string> robots;            ///< robot files, robot n's at n - 1; relative to the file
  std::string config;                         ///< settings in place of the command line's; relative to the file
  std::vector<SettingLine> set;
  std::vector<kicking::PolicyName> random;   ///< drawn for each possession
  std::vector<double> random_probabilities;  ///< of those; empty: alike
  std::string place;                         ///< of the arm, for messages: file, line and name
};

/// Reads an experiment's arms. Throws Error naming file, line, key and value; also for a file without arms, for two of
/// one name, for a name that is empty, longer than 64 bytes or not printable, for probabilities that are none, and for
/// an arm with both `policy` and `random`.
std::vector<ArmFields> load_arms(const std::filesystem::path& path);

/// The same of a text, which sentences call `name`; its files are relative to the folder where the program runs.
std::vector<ArmFields> parse_arms(const std::string& text, const std::string& name);

/// Throws BadArgument where the key, "policy.own.NAME.KEY", sets a policy that this program has not.
void require_own_policy(std::string_view key, const std::string& place);

/// Overrides settings by the line; returns the keys that it names, e.g. "policy.predictive.threshold". Throws Error
/// that begins with the line's place, and as require_own_policy() does.
std::vector<std::string> override_setting(Settings& settings, const SettingLine& line);

}  // namespace trivela::config
