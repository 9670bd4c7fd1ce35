#pragma once

#include <array>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "evaluator/imports/fault_counter.hpp"

namespace trivela::evaluator::imports {

/// A robot as its team told the box. F: origin at the centre spot, +y to the opponents' goal, heading counter-clockwise
/// from +y.
struct ReportedRobot {
  int id = 0;                                       ///< 0 to 255
  double x_m = 0.0, y_m = 0.0, heading_rad = 0.0;   ///< in F
  std::optional<std::array<double, 3>> velocity{};  ///< in F [m/s, m/s, rad/s]
  bool ball_engaged = false;
};

/// The ball that a team trusts most.
struct ReportedBall {
  double x_m = 0.0, y_m = 0.0;                      ///< in F
  std::optional<std::array<double, 2>> velocity{};  ///< in F, over ground [m/s]
};

/// One worldstate that can be used.
struct TeamRecord {
  std::int64_t number = 0;               ///< in the file, from 1
  std::optional<double> timestamp_ms{};  ///< UTC since 1970 less what the team said of its age
  std::optional<double> game_ms{};       ///< the box's clock of this part of the match
  std::vector<ReportedRobot> robots{};
  std::optional<ReportedBall> ball{};
};

/// What a team sent upstream, as the box logged it.
struct TeamLog {
  std::string file;
  std::string team;  ///< as the box names it
  std::int64_t records = 0;
  std::vector<TeamRecord> usable;  ///< in the file's order
  FaultCounter faults;
};

/// Reads a JSON array of worldstate records, one at a time: of the file no more than one record is in memory. Faults
/// are counted by name. A robot or ball without a position is left out, a record that is no JSON or without a
/// worldstate, too; after one that is broken, reading goes on at the next line that begins an object. Format:
/// RoboCup-MSL/RefBox mslrb2015/Team.pde and its MSLWMD-schema; faults as real clients make them.
TeamLog read_team_log(std::istream& in, const std::string& file);

/// Of the game time between records, without pauses. None: it never moves.
std::optional<double> record_rate_hz(const TeamLog& log);

/// Slower than the league asks of a team, 10 a second, by more than 5 %.
inline constexpr double kSlowRate_hz = 9.5;

}  // namespace trivela::evaluator::imports
