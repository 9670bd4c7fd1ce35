#pragma once

#include <Eigen/Core>

#include "kicking/ballistics/moving_kick.hpp"
#include "kicking/constants.hpp"
#include "kicking/geometry/goal.hpp"
#include "kicking/model/robot_model.hpp"

namespace trivela::kicking {

/// How well a robot knows itself at the release: standard deviations.
struct StateSpread {
  double position_m = 0.0;  ///< each axis
  double heading_rad = 0.0;
  double speed_mps = 0.0;  ///< each axis
  double turn_rate_radps = 0.0;
};

/// A robot at the release of the ball, in F.
struct ReleaseState {
  Eigen::Vector2d ball_m{0.0, 0.0};        ///< its centre
  Eigen::Vector2d forward{0.0, 1.0};       ///< unit vector of the heading
  Eigen::Vector2d velocity_mps{0.0, 0.0};  ///< of the robot's centre
  double omega_radps = 0.0;

  Eigen::Vector2d right() const { return {forward.y(), -forward.x()}; }
  /// v + omega x r of the ball's point.
  Eigen::Vector2d ball_point_mps(double ball_offset_m) const {
    return velocity_mps - omega_radps * ball_offset_m * right();
  }
  /// The part of it that the ball takes along: forward and sideways apart.
  Eigen::Vector2d carried_mps(const Transfer& transfer, double ball_offset_m) const {
    const double sideways_mps = velocity_mps.dot(right()) - omega_radps * ball_offset_m;
    return transfer.lateral * sideways_mps * right() + transfer.along_mps(velocity_mps.dot(forward)) * forward;
  }
};

/// A kick of a robot in that state.
struct KickExit {
  double v_kick_mps = 0.0;
  Elevation exit_angle{};
};

/// Where the ball crosses the goal line: mean and standard deviations.
struct CrossingSpread {
  double x_m = 0.0;
  double z_m = 0.0;
  double t_flight_s = 0.0;
  double sd_x_m = 0.0;
  double sd_z_m = 0.0;
};

/// Mean crossing and its spread to first order, without drag. With W = V c f + u the ball's horizontal velocity (f
/// forward, u carried along), B its centre, D the way to the line and r the ball's offset: T = D / W_y, x = B_x + W_x
/// T, z = r_ball + V s T - g T^2 / 2. An error that moves the launch by dB, the velocity by dW and the upward speed by
/// dv_z moves the ball by G = dB + T dW, and the crossing by
///
///     dx = G_x - (W_x / W_y) G_y,   dz = T dv_z + ((g T - v_z) / W_y) G_y.
///
/// Summed in squares over: exit speed and its table, elevation, direction, delay (the ball's point goes on and turns),
/// transfer forward and sideways, position, heading, velocity, turn rate. A velocity error also moves the launch, by
/// delay_s. x and z are taken to be independent. All zero with NaN heights where the ball does not fly to the line.
CrossingSpread crossing_spread(const ReleaseState& release, const KickExit& kick, const RobotModel& robot,
                               const StateSpread& state, double goal_y_m, double gravity_mps2 = kGravity_mps2);

/// Probability that a ball whose crossing is spread like that goes in: between the posts and below the bar, and not by
/// way of the floor unless it bounces in, with probability `bounce_ratio`:
///
///     P = (Phi((x_clean - x) / sd_x) - Phi((-x_clean - x) / sd_x))
///         (Phi((z_clean - z) / sd_z) - (1 - bounce_ratio) Phi((r - z) / sd_z)).
///
/// Of one that is `least` or below it may say 0.
double p_on_target(const CrossingSpread& crossing, double bounce_ratio, const Goal& goal, const Ball& ball = {},
                   double least = 0.0);

/// Height at the line that maximises p_on_target over z for a given sd_z: where the bar's density is (1 - bounce_ratio)
/// times the floor's,
///
///     z = (z_clean + r) / 2 - sd_z^2 ln(1 / (1 - bounce_ratio)) / (z_clean - r),
///
/// but not below the ball's radius.
class BestHeight {
 public:
  BestHeight(double bounce_ratio, const Goal& goal, const Ball& ball = {});
  double operator()(double sd_z_m) const;

 private:
  double least_m_;
  double middle_m_;
  double lower_per_m_;
};

}  // namespace trivela::kicking
