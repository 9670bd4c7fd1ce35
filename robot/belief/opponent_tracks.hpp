#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kicking/outcome/opponents.hpp"

namespace trivela::robot {

/// Where the opponents' keeper stands along its goal line: a Kalman filter of one state, which between pictures goes
/// back to what is known of any keeper, N(0, s^2) about the goal's middle. With q = exp(-t / T), s = 0.3 m, T = 5 s:
///
///     x' = q x,   var' = q^2 var + (1 - q^2) s^2
class KeeperTrack {
 public:
  /// A picture of t_ns shows it at x_m in F, an error of seen_sd_m; one that is not newer than the last counts for
  /// nothing, nor one that shows it where no keeper stands.
  void observe(std::int64_t t_ns, double x_m, double seen_sd_m);

  /// As known at t_ns; none: it was never seen.
  std::optional<kicking::KeeperPlace> at(std::int64_t t_ns) const;

 private:
  std::int64_t t_ns_ = 0;
  double x_m_ = 0.0;
  double var_m2_ = 0.0;  // 0: never seen
};

/// An opponent beside the keeper, in F: a Kalman filter of a constant velocity, both axes alike.
struct OpponentTrack {
  std::int64_t t_ns = 0;  ///< of the last prediction
  std::int64_t seen_t_ns = 0;
  Eigen::Vector2d position_m{0.0, 0.0};
  Eigen::Vector2d velocity_mps{0.0, 0.0};
  double var_m2 = 0.0;  ///< of each axis
  double cov_m2ps = 0.0;
  double var_m2ps2 = 0.0;

  /// As it is expected at t_ns: velocities walk, by 2 m/s in a second.
  OpponentTrack at(std::int64_t t_ns) const;
};

/// Who they are from picture to picture. A sighting belongs to the track that is nearest to it in standard deviations,
/// each to one; one that belongs to none begins a track, and one that was not seen for a second is dropped.
class OpponentTracks {
 public:
  OpponentTracks() { tracks_.reserve(kicking::kMostBodies); }

  /// A picture of t_ns with sightings in F, of seen_sd_m each axis. One that is not finite counts for nothing.
  void observe(std::int64_t t_ns, std::span<const Eigen::Vector2d> seen_m, double seen_sd_m);

  /// At most kMostBodies.
  const std::vector<OpponentTrack>& tracks() const { return tracks_; }

 private:
  std::vector<OpponentTrack> tracks_;
};

}  // namespace trivela::robot
