#pragma once

#include <string>

#include "kicking/alignment/alignment.hpp"
#include "kicking/alignment/release_predictor.hpp"
#include "kicking/geometry/goal.hpp"

namespace trivela::evaluator {

/// One kick and the half of the field in which it is played, in F.
struct KickPicture {
  kicking::Pose robot{};  ///< at the order
  kicking::Twist twist{};
  kicking::KickAction kick{};
  kicking::Goal goal{};
  double side_line_x_m = 6.0;  ///< 18 x 12 m field
  kicking::Ball ball{};
  double gravity_mps2 = kicking::kGravity_mps2;
  kicking::AlignmentRule segments{.half_width_m = 0.8};  ///< what the moving policy plays with
};

/// The kick as SVG of its own, to scale: from above the field's lines, the robot at the order and at the release, the
/// kicker's velocity, what the robot's motion adds and their sum, the ball's way to where predict_crossing() has it
/// cross the goal line, and the two segments of the alignment (S2 through the goal's middle); from the side the flight
/// and the bar. Behind a first touch of the floor the way is dotted. Light or dark as the reader's system is.
/// Throws std::invalid_argument where the ball does not fly towards the goal line.
std::string to_svg(const KickPicture& picture);

}  // namespace trivela::evaluator
