#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "evaluator/counting/log_opportunities.hpp"
#include "evaluator/drift/drift_watch.hpp"

namespace trivela::evaluator {

/// Where a kick of a series stands.
struct DriftKick {
  std::size_t log = 0;  ///< place among the logs
  std::int64_t session_id = 0;
  std::string session{};  ///< its uuid
  std::int64_t kick_id = 0;
  std::int64_t utc_ns = 0;
};

/// What became of one robot's kicker in the logs. On a field a robot's kicks go on from session to session; a simulated
/// session begins with a kicker of its own, and so is a series of its own.
struct RobotDrift {
  int robot_id = 0;
  bool simulated = false;
  std::size_t sessions = 0;
  std::vector<DriftKick> kicks{};  ///< accepted ones, by time
  DriftEstimate timeline{};        ///< places in it are of `kicks`
};

struct DriftReport {
  std::vector<RobotDrift> robots;    ///< by robot and time
  std::vector<std::string> remarks;  ///< on what does not count
  bool found() const;
};

/// The kicks of match logs, each once, as drifts_of() judges them. Throws std::runtime_error as log::Reader does.
DriftReport drift_in(const std::vector<std::filesystem::path>& logs);

/// The same of open logs.
DriftReport drift_in(std::span<const OpenLog> logs);

/// What holds since the last change, in % of what the robot's own table says: "above its table by 0.8 % of speed
/// (standard error 0.2, 201 heights)".
std::string level_words(const DriftLevel& level);

std::string to_text(const DriftReport& report);
std::string to_json(const DriftReport& report);

}  // namespace trivela::evaluator
