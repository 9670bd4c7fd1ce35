#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kicking/fit/table_fit.hpp"
#include "kicking/lob/lob_record.hpp"

namespace trivela::calibration {

/// What a calibration is made from.
enum class InputKind { kNumbers, kScanRecord, kMatchLog };

/// By the file's first bytes and tables; "-" and whatever is no SQLite file is a table of numbers.
/// Throws std::runtime_error naming a file that cannot be read.
InputKind input_kind(const std::string& file);

/// How to read the trials of a kicker, and what sentences call that.
struct TrialFlags {
  kicking::TableKind kind = kicking::TableKind::kEffective;
  std::optional<double> exit_angle_rad = {};  ///< of speeds that come without an angle
  std::string columns = {};                   ///< of tables of numbers, see NumberTable
  std::string kind_called = "kind";
  std::string angle_called = "exit_angle_deg";
  std::string columns_called = "columns";
};

/// Trials, and sentences on what was left out.
struct Trials {
  std::vector<kicking::Trial> trials;
  std::vector<std::string> warnings;
  bool simulated = false;  ///< some are of synthetic scans
};

/// Trials of scan records (accepted lobs with a known power; effective or true values by `kind`) and of tables with the
/// columns power, height_m, distance_m (of the ball's centre relative to the launch; effective) or power,
/// exit_speed_mps
/// [, exit_angle_deg].
/// Throws std::runtime_error, std::invalid_argument naming file and line; config::BadArgument for flags that
/// contradict a file.
Trials read_trials(const std::vector<std::string>& files, const TrialFlags& flags);

/// The same for lobs: those accepted and with a power.
Trials trials_of_lobs(const std::vector<kicking::lob::LobRecord>& lobs, kicking::TableKind kind,
                      const std::string& file);

}  // namespace trivela::calibration
