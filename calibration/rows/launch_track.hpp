#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "kicking/ballistics/flight.hpp"

namespace trivela::calibration {

/// How a ball left, by the flight camera alone.
struct LaunchTrack {
  Eigen::Vector3d velocity_mps{0.0, 0.0, 0.0};  ///< over ground, in F, where the centre passes the launch height
  double spread_s2 = 0.0;  ///< sum of the squared deviations of the sightings' times: velocity variance = sd^2 / this
};

/// Least squares of the flight with drag, d2p/dt2 = -k |v| v - g, k by kicking::drag_per_m(), through the sightings
/// from 0.06 s after `release_t_ns` until the goal line, the floor or the hand that carries the ball back; its velocity
/// at the instant at which the centre is one radius high. The flight itself says when it began, so that `release_t_ns`
/// needs to be right to 0.05 s only. None: fewer than ten sightings, or a track that never was on the floor.
std::optional<LaunchTrack> launch_track(std::span<const kicking::Sighting> sightings, std::int64_t release_t_ns,
                                        double goal_line_y_m, const kicking::Ball& ball);

}  // namespace trivela::calibration
