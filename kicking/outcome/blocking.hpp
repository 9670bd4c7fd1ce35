#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "kicking/constants.hpp"
#include "kicking/outcome/crossing_spread.hpp"

namespace trivela::kicking {

/// How many opponents beside the keeper are looked at.
inline constexpr std::size_t kMostBodies = 5;

/// An opponent that is tracked, in F.
struct BodyPlace {
  Eigen::Vector2d position_m{0.0, 0.0};
  double closing_mps = 0.0;  ///< by which it comes nearer to the ball
  double sd_m = 0.0;         ///< of its position, each axis
};

/// An opponent's body, a cylinder.
struct Body {
  double radius_m = 0.26;  ///< rules: 52 x 52 x 80 cm
  double height_m = 0.8;
};

/// A kick as bodies meet it.
struct KickPath {
  Eigen::Vector2d velocity_mps{0.0, 0.0};  ///< over ground
  double v_z_mps = 0.0;
  double sd_rad = 0.0;  ///< of its direction
};

/// Probability that a body at `relative_m` from the ball at the release, N(., sd^2 per axis), is in the ball's way.
/// With s along the way and u beside it, R = body and ball radius, the ball meets it where |u| < R and s > 0:
///
///     P = Phi((R - u) / sd_u) - Phi((-R - u) / sd_u),   sd_u^2 = sd^2 + (s sd_rad)^2
///
/// but 0 where the ball's lower side is above it at s - R and at s + R, without drag.
double p_in_the_way(const Eigen::Vector2d& relative_m, double sd_m, const KickPath& path, const Body& body,
                    const Ball& ball = {}, double gravity_mps2 = kGravity_mps2);

}  // namespace trivela::kicking
