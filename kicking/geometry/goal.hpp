#pragma once

#include "kicking/constants.hpp"

namespace trivela::kicking {

/// The opponents' goal in F: inner half-width and height, posts and bar of one square section. Defaults: 18 x 12 m
/// field with the 2 x 1 m goal (CAMBADA release 1.0, cambada.conf.xml); on 22 x 14 m fields the half-width is 1.2 m
/// (Falcons cEnvironment14x22).
struct Goal {
  double y_m = 9.0;
  double half_width_m = 1.0;
  double height_m = 1.0;
  double post_width_m = 0.125;

  /// Largest |x| at which the ball's centre passes between the posts and touches none.
  constexpr double clean_half_width_m(const Ball& ball = {}) const { return half_width_m - ball.radius_m; }
  /// Largest height of the ball's centre that passes below the bar and touches it not.
  constexpr double clean_height_m(const Ball& ball = {}) const { return height_m - ball.radius_m; }
  /// |x| of the ball's centre from which it passes outside the post.
  constexpr double wide_half_width_m(const Ball& ball = {}) const {
    return half_width_m + post_width_m + ball.radius_m;
  }
  /// Height of the ball's centre from which it passes over the bar.
  constexpr double over_height_m(const Ball& ball = {}) const { return height_m + post_width_m + ball.radius_m; }
};

}  // namespace trivela::kicking
