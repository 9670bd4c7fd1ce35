#pragma once

#include <Eigen/Core>

#include "kicking/geometry/frames.hpp"
#include "kicking/geometry/goal.hpp"
#include "kicking/range.hpp"

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

/// What a match's rules allow a robot with the ball. By default nothing is forbidden, as on the paper's field; a
/// scenario says where each of its rules comes from.
struct MatchRules {
  bool opponents_half_only = false;  ///< a goal counts only where the ball was kicked in the opponents' half
  double carry_limit_m = 0.0;        ///< the ball is carried at most so far from where it was taken; 0: no limit
  double set_piece_s = 0.0;          ///< our set piece is taken within so long of its START; 0: no limit

  friend bool operator==(const MatchRules&, const MatchRules&) = default;
};

/// How far a robot may still go with the ball: its centre within a circle about the place where the ball was taken.
class DribbleLimit {
 public:
  /// `taken_m`: the ball's centre in F then.
  DribbleLimit(double radius_m, double max_brake_mps2, const Eigen::Vector2d& taken_m)
      : radius_m_(radius_m), brake_mps2_(max_brake_mps2), taken_m_(taken_m), limited_(true) {}

  /// No limit.
  DribbleLimit() = default;

  /// The command in R of a robot at centre_m in F, unit vector of its heading `forward`: its part away from where the
  /// ball was taken is v <= sqrt(2 a room), a the braking and room what is left of the radius; beyond it none.
  Twist keep(const Twist& command, const Eigen::Vector2d& centre_m, const Eigen::Vector2d& forward) const {
    return limited_ ? kept(command, centre_m, forward) : command;
  }

 private:
  Twist kept(const Twist& command, const Eigen::Vector2d& centre_m, const Eigen::Vector2d& forward) const;

  double radius_m_ = 0.0;
  double brake_mps2_ = 0.0;
  Eigen::Vector2d taken_m_{0.0, 0.0};
  bool limited_ = false;
};

}  // namespace trivela::kicking

/// The keys of a field and of a match's rules, each named once with the range it may take; found by ADL.
namespace trivela::kicking {

template <class V>
void fields(V& v, MatchRules& r) {
  v("opponents_half_only", r.opponents_half_only);
  v("carry_limit_m", r.carry_limit_m, Range{0.0, 60.0});
  v("set_piece_s", r.set_piece_s, Range{0.0, 60.0});
}

template <class V>
void fields(V& v, PlayingField& f) {
  v("goal_line_y_m", f.goal_line_y_m, Range{1.0, 30.0});
  v("side_line_x_m", f.side_line_x_m, Range{1.0, 30.0});
  v("goal_half_width_m", f.goal_half_width_m, Range{0.3, 5.0});
  v("goal_height_m", f.goal_height_m, Range{0.3, 5.0});
  v("frame_thickness_m", f.frame_thickness_m, Range{0.0, 0.5});
}

}  // namespace trivela::kicking
