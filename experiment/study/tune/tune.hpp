#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiment/study/tune/tune_search.hpp"

namespace trivela::experiment {

/// Matches of a search, or those that it is tried on afterwards.
struct TuneMatches {
  std::uint64_t seed = 0;
  std::uint32_t matches = 0;
  std::uint32_t possessions = 0;  ///< opportunities a match
  std::size_t calibrations = 0;   ///< of calibration, by the same seed; 0: the robot files
};

/// What a search found, and on which matches.
struct TuneReport {
  std::string policy;
  std::string command;   ///< that makes the file again
  std::string scenario;  ///< name of its file
  TuneMatches tuning{};
  TuneMatches held_out{};
  std::vector<Coordinate> space{};
  TuneState state{};
  std::optional<ArmTally> held_out_start{};  ///< none: interrupted before
  std::optional<ArmTally> held_out_best{};
};

/// What was changed, the objective where it was chosen and on held-out matches, and what choosing made of it.
std::string to_text(const TuneReport& report);

/// A file for --config: the settings that were searched and every other one of [policy] that is not the built-in
/// default, below comments that say where they come from. Its robot and scenario are named relative to `out`'s folder.
std::string to_settings_file(const TuneReport& report, const std::filesystem::path& out);

}  // namespace trivela::experiment
