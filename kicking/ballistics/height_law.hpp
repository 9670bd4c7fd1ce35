#pragma once

#include "kicking/ballistics/crossing.hpp"

namespace trivela::kicking {

/// Exit speed for the target's height at its distance.
/// kPaper: the range law of section 2.2, the ball lands on the goal line. kExtendedRange: the released code's D = d + h
/// / tan(theta). kExact: the parabola through the target.
enum class HeightLaw { kPaper, kExtendedRange, kExact };

/// The point that the drag-free flight shall pass, by that law, so that the ball meets the target.
inline FlightPoint point_by(HeightLaw law, const FlightPoint& target, const Elevation& exit_angle) {
  switch (law) {
    case HeightLaw::kPaper:
      return {target.distance_m, 0.0};
    case HeightLaw::kExtendedRange:
      return {extended_range(target, exit_angle), 0.0};
    case HeightLaw::kExact:
      break;
  }
  return target;
}

}  // namespace trivela::kicking
