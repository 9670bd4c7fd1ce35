#pragma once

/// What `fields(visitor, struct)` says of a number beside its key.
namespace trivela::kicking {

/// An angle in rad that a file shows in degrees.
struct Degrees {
  double& rad;
};

/// The values that a number may take, both ends included, in the unit of its key.
struct Range {
  double min;
  double max;

  bool contains(double value) const { return value >= min && value <= max; }
};

}  // namespace trivela::kicking
