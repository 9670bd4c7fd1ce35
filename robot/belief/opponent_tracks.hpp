#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "kicking/outcome/blocking.hpp"

namespace trivela::robot {

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
