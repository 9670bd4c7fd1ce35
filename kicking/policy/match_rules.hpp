#pragma once

#include <Eigen/Core>

#include "kicking/geometry/frames.hpp"

namespace trivela::kicking {

/// What a match's rules allow a robot with the ball. By default nothing is forbidden, as on the paper's field; the
/// files of config/fields/ name each rule's source.
struct MatchRules {
  /// A goal counts only where the ball was kicked in the opponents' half ...
  bool opponents_half_only = false;
  /// ... its centre so far beyond the half-way line, which is as much as one's own place is trusted (VDL Robotsports
  /// role_assigner, min_y_for_lob_shot: 0.25 m).
  double half_line_margin_m = 0.25;
  /// The ball is carried at most so far from where it was taken; 0: as far as one likes.
  double carry_limit_m = 0.0;
  /// The policies stay so far within that (assumed: position error of a few metres' odometry, and braking).
  double carry_margin_m = 0.3;

  /// May a ball be kicked at the goal from ball_y_m, of its centre in F?
  bool may_shoot_from(double ball_y_m) const { return !opponents_half_only || ball_y_m > half_line_margin_m; }
};

/// How far a robot may still go with the ball: its centre within a circle about the place where the ball was taken.
class CarryReach {
 public:
  /// `taken_m`: the ball's centre in F then. The ball is at most ball_offset_m farther from there than the robot's
  /// centre, however it turns, so that the circle's radius is carry_limit_m - carry_margin_m - ball_offset_m.
  CarryReach(const MatchRules& rules, double ball_offset_m, double max_brake_mps2, const Eigen::Vector2d& taken_m)
      : radius_m_(rules.carry_limit_m - rules.carry_margin_m - ball_offset_m),
        brake_mps2_(max_brake_mps2),
        taken_m_(taken_m),
        limited_(rules.carry_limit_m > 0.0) {}

  /// No limit.
  CarryReach() = default;

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
