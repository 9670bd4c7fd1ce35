#pragma once

#include <Eigen/Core>
#include <optional>

#include "kicking/ballistics/moving_kick.hpp"
#include "kicking/constants.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/geometry/frames.hpp"

namespace trivela::kicking {

/// What leaves the robot if the order goes out now.
struct KickAction {
  double v_kick_mps = 0.0;
  Elevation exit_angle{};
  Transfer transfer{};
  double delay_s = 0.0;
  double ball_offset_m = 0.27;
};

/// Where the ball crosses the goal line, in F.
struct PredictedCrossing {
  double x_m = 0.0;
  double z_m = 0.0;  ///< height of the ball's centre; negative: it would have touched the floor before the line
  double t_flight_s = 0.0;
  Eigen::Vector2d release_m{0.0, 0.0};  ///< ball centre at the release
  double release_heading_rad = 0.0;
};

/// Forward prediction: constant twist in R during the delay; the ball at (0, r) leaves with the kick (forward,
/// elevated) plus transfer * (v + omega x r); free flight without drag, without the floor. None where it does not fly
/// towards the line.
std::optional<PredictedCrossing> predict_crossing(const Pose& pose, const Twist& twist, const KickAction& kick,
                                                  double goal_y_m, double launch_height_m = Ball{}.radius_m,
                                                  double gravity_mps2 = kGravity_mps2);

/// The same from the robot's pose at the release, advance(pose, twist, kick.delay_s).
std::optional<PredictedCrossing> crossing_of_release(const TurnedPose& release, const Twist& twist,
                                                     const KickAction& kick, double goal_y_m,
                                                     double launch_height_m = Ball{}.radius_m,
                                                     double gravity_mps2 = kGravity_mps2);

}  // namespace trivela::kicking
