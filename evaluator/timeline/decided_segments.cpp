#include "evaluator/timeline/decided_segments.hpp"

#include <cmath>

#include "kicking/alignment/alignment.hpp"

namespace trivela::evaluator {
namespace {

/// Where S1 begins. By law paper_line that is the robot's centre; by law physical the ball's place at the release,
/// which the row has not, but of which distance, direction of S1 and offset leave one place alone.
Eigen::Vector2d start_of_s1(const DecidedAlignment& a) {
  Eigen::Vector2d centre(a.robot.x_m, a.robot.y_m);
  if (!a.offset_right_m || !(a.distance_m > 0.0)) return centre;
  const auto from_centre = kicking::align(a.robot, a.alpha_rad, 0.0, 0.0, a.target_m).offset_right_m;
  if (from_centre && std::abs(*from_centre - *a.offset_right_m) < 1e-6) return centre;
  const double turn_rad = std::atan2(*a.offset_right_m, a.distance_m);
  return a.target_m - a.distance_m * kicking::direction(a.robot.heading_rad - a.alpha_rad + turn_rad);
}

}  // namespace

DecidedSegments decided_segments(const DecidedAlignment& a) {
  DecidedSegments segments;
  segments.aligned = a.aligned;
  segments.s1_from_m = start_of_s1(a);
  const Eigen::Vector2d line = a.target_m - segments.s1_from_m;
  const double length_m = line.norm();
  const Eigen::Vector2d along = length_m > 1e-9 ? Eigen::Vector2d(line / length_m) : Eigen::Vector2d(0.0, 1.0);
  const Eigen::Vector2d right(along.y(), -along.x());
  segments.s1_to_m =
      a.offset_right_m
          ? Eigen::Vector2d(a.target_m + *a.offset_right_m * right)
          : Eigen::Vector2d(segments.s1_from_m + length_m * kicking::direction(a.robot.heading_rad - a.alpha_rad));
  segments.s2_left_m = a.target_m - a.left_m * right;
  segments.s2_right_m = a.target_m + a.right_m * right;
  return segments;
}

}  // namespace trivela::evaluator
