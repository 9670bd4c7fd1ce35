#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace trivela::robot {

/// What a recorder's file is named by.
struct LogNaming {
  std::string team;
  std::uint32_t robot_id = 1;
  std::int64_t now_utc_ns = 0;
};

/// What a folder is given as name.
inline constexpr const char* kLogPattern = "{team}-{robot}-{time}.db";

/// Logs that a recorder of the same settings would have made.
struct LogFamily {
  std::string name;       ///< of the one file, without its ending; empty: each has its own
  std::string beginning;  ///< of all others
  std::string ending;     ///< ".db"

  bool has(const std::filesystem::path& file) const;
};

/// "20261122T013000Z".
std::string log_time(std::int64_t utc_ns);

/// `setting` (recorder.log) as a file: a folder, which is there or ends with '/', stands for kLogPattern in it; {team},
/// {robot} and {time} (UTC) of the file's name are filled in. What a file's name cannot hold becomes '_'.
std::filesystem::path log_path(const std::string& setting, const LogNaming& naming);

/// The logs of that setting: of a name without {time} its file and NAME-r*, of others all that begin as it does before
/// {time}.
LogFamily log_family(const std::string& setting, const LogNaming& naming);

}  // namespace trivela::robot
