#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/rows/release_track.hpp"
#include "evaluator/log/reader.hpp"
#include "kicking/geometry/frames.hpp"

namespace trivela::calibration {

using RobotKey = std::pair<std::int64_t, std::int64_t>;  ///< session, robot

/// A kick that the driver accepted: the robot's belief at the order, and what it saw of the flight.
struct DriveKick {
  std::string policy;
  std::int64_t order_t_ns = 0;
  kicking::Pose pose;    ///< in F
  kicking::Twist twist;  ///< in R
  double goal_line_y_m = 0.0;
  double power = 0.0;
  std::optional<double> x_cross_m;  ///< none: it was not seen to cross
  std::optional<double> z_cross_m;
  RobotKey robot;

  /// The crossing in R as it was at the order: x to the right of the pointing line, y along it.
  Eigen::Vector2d crossing_in_robot() const { return kicking::to_robot(pose, {*x_cross_m, goal_line_y_m}); }
};

/// What a fit sees of a drive: its kicks in the order of their decisions, and the flight camera's sightings of the
/// ball, held or flying, in the order of what they show. Nothing of a simulator's truth.
struct RecordedDrives {
  std::vector<DriveKick> kicks;
  std::map<RobotKey, std::vector<kicking::Sighting>> sightings;
};

/// The drives of a match log.
RecordedDrives recorded_drives(const evaluator::log::Reader& reader);

}  // namespace trivela::calibration
