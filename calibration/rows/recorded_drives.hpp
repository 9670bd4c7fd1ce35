#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kicking/ballistics/flight.hpp"
#include "kicking/geometry/frames.hpp"
#include "log/read/reader.hpp"

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
RecordedDrives recorded_drives(const log::Reader& reader);

/// Order to release of one kick [s]: the instant at which two straight tracks over the floor meet. The one in the
/// handler is fitted to the 0.2 s before the order; the one in flight to the first eight sightings farther than 0.25 m
/// from where the ball would be in the handler, slowed by the drag of kicking::Ball and kicking::Air: s = v (t - k |v|
/// t^2 / 2). None: fewer than five sightings of either, or no flight within half a second. `sightings` by time; the
/// robot must drive straight and must not turn around the order.
std::optional<double> release_delay_s(std::span<const kicking::Sighting> sightings, std::int64_t order_t_ns);

/// How a ball left, by the flight camera alone.
struct LaunchTrack {
  Eigen::Vector3d velocity_mps{0.0, 0.0, 0.0};  ///< over ground, in F, where the centre passes the launch height
  double spread_s2 = 0.0;  ///< sum of the squared deviations of the sightings' times: velocity variance = sd^2 / this
};

/// Least squares of the flight with drag, d2p/dt2 = -k |v| v - g, k by kicking::drag_per_m(). The sightings count from
/// 0.06 s after `release_t_ns` until the goal line, the floor or the hand that carries the ball back. It gives the
/// velocity at the instant at which the centre is one radius high. The flight itself says when it began, so that
/// `release_t_ns` needs to be right to 0.05 s only. None: fewer than ten sightings, or a track that never was on the
/// floor.
std::optional<LaunchTrack> launch_track(std::span<const kicking::Sighting> sightings, std::int64_t release_t_ns,
                                        double goal_line_y_m, const kicking::Ball& ball);

}  // namespace trivela::calibration
