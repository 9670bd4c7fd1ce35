#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibration/rows/recorded_drives.hpp"
#include "kicking/fit/deflection_fit.hpp"
#include "kicking/fit/scatter_fit.hpp"
#include "kicking/fit/table_fit.hpp"
#include "kicking/fit/transfer_fit.hpp"
#include "kicking/model/robot_model.hpp"

namespace trivela::calibration {

/// Kicks of a log as the rows of a fit, and a sentence on each kind of kick left out.
template <class Row>
struct DriveKicks {
  std::vector<Row> rows;
  std::vector<std::string> left_out;
};

// What the robot believed at the order and what it saw of the flight.
// The simulator's truth is never read. The pointing line goes from the robot's centre along its heading, at the order.
// `model` is the robot's calibration so far: its table and exit angle give the speeds, its ball offset the ball.

/// Kicks of policy "lateral_drive": b is the crossing right of where the pointing line meets the goal line, d from the
/// ball to that point.
DriveKicks<kicking::DeflectionRow> lateral_kicks(const RecordedDrives& drives, const kicking::RobotModel& model);

/// Kicks of policy "turn_drive": the allowed error that would have brought the ball to the middle of the target: how
/// far the ball crosses from the pointing line, plus the half cycle by which an order is late on average.
DriveKicks<kicking::RotationRow> turn_kicks(const RecordedDrives& drives, const kicking::RobotModel& model,
                                            double cycle_s);

/// Kicks of policy "straight_drive", and of "lateral_drive" as kicks without forward speed, each with the velocity that
/// the flight camera's track of its ball begins with: along the pointing line and upwards. Where the ball lands and
/// whether it crosses plays no part.
DriveKicks<kicking::TransferRow> transfer_kicks(const RecordedDrives& drives, const kicking::RobotModel& model);

/// A kick of policy "standing_drive" by the flight camera.
struct TrackedSpeed {
  std::int64_t order_t_ns = 0;
  double power = 0.0;
  double up_mps = 0.0;        ///< vertical velocity at the launch
  double sideways_rad = 0.0;  ///< direction over ground, clockwise from +y of F
};
DriveKicks<TrackedSpeed> standing_kicks(const RecordedDrives& drives, const kicking::RobotModel& model);

/// Directions of the kicks of policy "standing_drive" over ground, counter-clockwise from +y of F: the slope of a line
/// through the flight camera's sightings of the ball in flight, x over y. Neither the robot's localisation nor its
/// filters are in it.
DriveKicks<kicking::LaunchDirection> launch_directions(const RecordedDrives& drives, const kicking::RobotModel& model);

/// Kicks of policy "standing_drive" that stay low: exit speed by the flight camera, and the exit angle of `model`,
/// which a ball near the floor does not show. The speed is the slope of a line through the sightings of the first
/// quarter of a second in flight, with the drag until its middle, by the cosine of that angle. Where the ball slides
/// meanwhile it comes out too slow: friction times g times half of that time, 0.4 m/s for a friction of 0.3.
DriveKicks<kicking::Trial> low_kicks(const RecordedDrives& drives, const kicking::RobotModel& model);

/// Order to release [s] of every accepted kick of a robot that does not turn, by the flight camera alone: the instant
/// at which the ball's track in flight meets its track in the handler.
DriveKicks<double> release_delays(const RecordedDrives& drives);

}  // namespace trivela::calibration
