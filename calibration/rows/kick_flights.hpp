#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "kicking/learning/kicker_learner.hpp"

namespace trivela::calibration {

/// A kick of one robot that a match log has, and the match it is from.
struct LoggedFlight {
  std::uint32_t match = 0;
  std::int64_t utc_ns = 0;
  std::int64_t kick_id = 0;
  kicking::KickFlight flight;
};

/// The kicks of a robot in match logs whose flights were seen, each once, by time.
struct LoggedFlights {
  std::vector<LoggedFlight> flights;
  std::vector<int> robots;           ///< of all kicks in the logs
  std::size_t kicks = 0;             ///< of the robot, seen or not
  bool simulated = false;            ///< some of it
  std::vector<std::string> remarks;  ///< on what does not count
};

/// `delay_s`: of the robot's file that they are held against, whatever the match was played with. Throws
/// std::runtime_error as log::Reader does.
LoggedFlights flights_in(const std::vector<std::filesystem::path>& logs, int robot_id, double delay_s);

}  // namespace trivela::calibration
