#pragma once

#include "kicking/geometry/angle.hpp"

namespace trivela::kicking {

/// The predictive policy's own settings; limits of the base and the cycle are PolicyConfig's. Every number is assumed
/// but where a source stands.
struct PredictiveConfig {
  /// Least probability of a ball on target that it fires at. Raising it trades kicks for efficiency.
  double threshold = 0.3;
  /// The same of a goal past a tracked keeper.
  double goal_threshold = 0.02;
  /// How far ahead it looks for a better moment than now, and in which steps.
  double horizon_s = 1.2;
  double step_s = 0.05;
  /// Chance that a ball which touches the floor before the line still goes in, against one that does not. Below 1 the
  /// best height is not the floor.
  double bounce_ratio = 0.9;
  /// The same of a low kick, which meets the floor at a few degrees (low_kick()).
  double low_bounce_ratio = 0.98;
  /// Sliding friction of ball and floor, for the time that a low kick takes.
  double floor_friction_ratio = 0.3;

  /// What the robot does not know of itself, beside what its filters say: they cannot see the slow errors of
  /// self-localisation (0.12 m is the published localisation noise).
  double position_sd_m = 0.12;
  double heading_sd_rad = radians(0.8);
  double speed_sd_mps = 0.05;  ///< each axis
  double turn_rate_sd_radps = 0.05;
  /// The twist that comes in is so much older than the pose: the velocity filter's lag.
  double twist_lag_s = 0.02;

  /// The ball is lost when the nearest opponent's centre is so near.
  double dispute_distance_m = 0.5;
  /// How fast opponents come before one has been watched: mean, spread.
  double closing_mps = 1.3;
  double closing_sd_mps = 0.5;
  double closing_walk_mps2 = 0.5;  ///< how much that changes in a second
  double opponent_sd_m = 0.15;     ///< of one observation of its distance (match log of 2016: 0.14 m an axis)
  double opponent_lag_s = 0.06;    ///< age of that observation
  /// Losing the ball otherwise: opponents that nobody sees, referees, time limits.
  double hazard_per_s = 0.1;
  /// An opponent is a cylinder (rules: 52 x 52 x 80 cm) that a ball must pass or clear.
  double opponent_radius_m = 0.26;
  double opponent_height_m = 0.8;
  /// Whether it goes by where tracked opponents stand; else the nearest is somewhere around the ball.
  bool opponent_places = false;
};

}  // namespace trivela::kicking
