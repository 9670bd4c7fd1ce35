#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "log/schema/session.hpp"

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

/// A session that a new one goes on from, with the driver's counters where it ends.
struct Predecessor {
  std::string uuid;
  std::filesystem::path log;
  std::vector<log::DriverCount> drivers;
};

/// How old a recording's last row may be for another to go on from it, in seconds.
inline constexpr double kLongestPause_s = 3600.0;

/// The newest session of the same set-up (equal config_toml) among the match logs of `family` in `folder`, whose last
/// row is no older than kLongestPause_s. The logs are read and not changed; one that cannot be read is told to `warn`
/// and passed over.
std::optional<Predecessor> find_predecessor(const std::filesystem::path& folder, const LogFamily& family,
                                            const log::Session& session, std::int64_t now_utc_ns,
                                            const std::function<void(const std::string&)>& warn);

}  // namespace trivela::robot
