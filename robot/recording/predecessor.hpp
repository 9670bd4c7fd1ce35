#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "log/schema/session.hpp"
#include "robot/recording/log_name.hpp"

namespace trivela::robot {

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
