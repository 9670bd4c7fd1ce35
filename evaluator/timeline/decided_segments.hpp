#pragma once

#include <Eigen/Core>

#include "kicking/geometry/frames.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::evaluator {

/// What a decision says of its alignment.
struct DecidedAlignment {
  kicking::Pose robot{};
  double alpha_rad = 0.0;
  Eigen::Vector2d target_m{};
  double distance_m = 0.0;
  bool aligned = false;
  kicking::OptionalDouble offset_right_m;
  double left_m = 0.0;
  double right_m = 0.0;
};

/// The two segments of the alignment at the decision, in F.
struct DecidedSegments {
  Eigen::Vector2d s1_from_m, s1_to_m, s2_left_m, s2_right_m;
  bool aligned = false;
};

/// Where they lay, for a picture.
DecidedSegments decided_segments(const DecidedAlignment& decided);

}  // namespace trivela::evaluator
