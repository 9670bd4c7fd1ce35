#pragma once

#include <span>

#include "kicking/ballistics/flight.hpp"

namespace trivela::robot {

/// How far a sighting lies from the ball, learned from the flights seen so far.
///
/// Each sighting is held against the straight line between its two neighbours in time, sideways and forward: with the
/// share w of the way between them it is off by sd sqrt(1 + (1 - w)^2 + w^2), whatever the ball's way, as long as that
/// is nearly straight. The median of what they are off makes a kink or two harmless. The configured value counts as
/// four sightings, what was learned as a hundred at most, so that a camera may change.
class CameraNoise {
 public:
  explicit CameraNoise(double configured_sd_m);

  /// Learns from one flight.
  void learn(std::span<const kicking::Sighting> sightings);

  double sd_m() const;
  /// Sightings that the value rests on.
  double weight() const { return weight_; }

 private:
  double configured_m2_;
  double learned_m2_ = 0.0;  // sum of squares
  double weight_ = 0.0;
};

}  // namespace trivela::robot
