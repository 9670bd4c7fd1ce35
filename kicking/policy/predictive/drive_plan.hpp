#pragma once

#include <array>

#include "kicking/policy/predictive/base_motion.hpp"

namespace trivela::kicking {

/// A way to drive on: how it turns and whether it keeps driving towards the goal or brakes.
struct DrivePlan {
  enum class Turn {
    kOnto,    ///< comes to rest on the target: the braking curve of the other policies
    kThrough  ///< as fast as the base turns, through the target and back
  };
  Turn turn = Turn::kOnto;
  bool dribble = true;

  bool operator==(const DrivePlan&) const = default;
};

/// In the order of preference where they are worth the same.
inline constexpr std::array<DrivePlan, 4> kDrivePlans{{{DrivePlan::Turn::kOnto, true},
                                                       {DrivePlan::Turn::kThrough, true},
                                                       {DrivePlan::Turn::kOnto, false},
                                                       {DrivePlan::Turn::kThrough, false}}};

/// The plan's drive command in a state of motion. It turns the way that is quicker from the present turn rate, to where
/// a standing turn rate sends the ball to the target: bearing plus alpha = k_x v_x / ball_speed_mps.
Twist command_of(const DrivePlan& plan, const BaseMotion& base, const PolicyConfig& config,
                 const Eigen::Vector2d& target_m, double lateral_transfer, double ball_speed_mps);

}  // namespace trivela::kicking
