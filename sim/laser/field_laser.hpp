#pragma once

#include <cstdint>
#include <vector>

#include "kicking/lob/scan.hpp"
#include "sim/laser/laser_model.hpp"
#include "sim/laser/scan_builder.hpp"
#include "sim/scenario.hpp"

namespace trivela::sim {

/// The range finder of a scenario: a UTM-30LX.
LaserModel laser_model(const Laser& laser);

/// The laser of a match: nothing without one.
class FieldLaser {
 public:
  /// The first scan starts at t_ns 0.
  FieldLaser(const Laser& laser, double ball_radius_m);

  /// Another opportunity begins: its random numbers, and the ball is somewhere else from one instant to the next.
  void begin(const kicking::Draws& draws);

  /// The ball's centre at t_ns, after each sub-step.
  void see(std::int64_t t_ns, const Eigen::Vector3d& ball_m);

  /// Scans finished since forget().
  const std::vector<kicking::lob::Scan>& scans() const { return scans_; }
  void forget() { scans_.clear(); }

 private:
  std::optional<ScanBuilder> builder_;
  bool ball_was_moved_ = true;
  std::vector<kicking::lob::Scan> scans_;
};

}  // namespace trivela::sim
