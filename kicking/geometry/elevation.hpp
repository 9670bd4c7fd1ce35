#pragma once

#include <cmath>

namespace trivela::kicking {

/// An angle over the floor with its sine and cosine, for who needs more than one of them.
struct Elevation {
  Elevation() = default;
  Elevation(double angle)  // NOLINT(google-explicit-constructor): it is that angle
      : angle_rad(angle), sine(std::sin(angle)), cosine(std::cos(angle)) {}

  double tangent() const { return sine / cosine; }

  double angle_rad = 0.0;
  double sine = 0.0;
  double cosine = 1.0;
};

}  // namespace trivela::kicking
