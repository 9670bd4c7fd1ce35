#pragma once

#include "kicking/geometry/goal.hpp"

namespace trivela::kicking {

/// A field and its goals. The lines lie at +-goal_line_y_m and +-side_line_x_m in F. SI.
struct PlayingField {
  double goal_line_y_m = 9.0;        ///< 18 x 12 m field of the paper
  double side_line_x_m = 6.0;        ///< 18 x 12 m field of the paper
  double goal_half_width_m = 1.0;    ///< inner; CAMBADA release 1.0 cambada.conf.xml goal_width 2000 mm
  double goal_height_m = 1.0;        ///< inner; CAMBADA release 1.0 cambada.conf.xml goal_height 1000 mm
  double frame_thickness_m = 0.125;  ///< posts: CAMBADA release 1.0 cambada.conf.xml; bar: assumption, the same
};

/// The goal of a field.
inline Goal goal_of(const PlayingField& field) {
  return {.y_m = field.goal_line_y_m,
          .half_width_m = field.goal_half_width_m,
          .height_m = field.goal_height_m,
          .post_width_m = field.frame_thickness_m};
}

}  // namespace trivela::kicking
