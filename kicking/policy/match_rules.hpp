#pragma once

#include <Eigen/Core>

#include "kicking/geometry/frames.hpp"

namespace trivela::kicking {

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
