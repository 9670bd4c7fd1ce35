#pragma once

#include <cstdint>
#include <optional>

#include "kicking/geometry/frames.hpp"
#include "kicking/maybe.hpp"

namespace trivela::evaluator {

/// A kick as its robot predicted and saw it; nothing here is a simulator's truth.
struct WatchedKick {
  std::int64_t kick_id = 0;
  std::int64_t t_ns = 0;  ///< of the decision
  kicking::Pose robot{};  ///< at the decision, in F
  kicking::Twist twist{};
  double lead_s = 0.0;                            ///< from the decision to the expected release
  int policy = 0;                                 ///< that kicked: each predicts with an error of its own
  double goal_y_m = 0.0;                          ///< where it crosses
  double x_m = 0.0, z_m = 0.0, t_flight_s = 0.0;  ///< predicted crossing and flight
  bool seen_to_the_line = false;                  ///< not blocked, outcome known
  bool bounced = false;                           ///< it touched the floor before the line
  kicking::Maybe z_cross_m{};                     ///< observed
  kicking::Maybe exit_speed_mps{};                ///< observed, of the ball over ground
};

/// By how much a kick was stronger than predicted, measured twice: 0.03 is 3 % more speed out of the kicker. It is ln f
/// of the factor f by which the kicker's part of the ball's velocity would explain what was seen.
struct KickResidual {
  std::optional<double> height;  ///< out of where it crossed: (z - z predicted) / (dz / d ln f)
  bool height_at_most = false;   ///< it bounced: free flight would have been at the floor or below
  std::optional<double> speed;   ///< out of its exit speed: ln(v / v predicted) / (d ln v / d ln f)
  int group = 0;                 ///< kicks whose predictions have one error in common: the policy
  double metres = 0.0;           ///< dz / d ln f, m: height that a residual of 1 is
};

/// The residuals of a kick; empty where it has no such prediction, or was not seen to the line. The predicted velocity
/// at the release is that of the drag-free flight from where the robot is then to the predicted crossing; the robot's
/// own motion at the ball's place (v + omega x r) is not the kicker's and does not scale with f:
///   dz / d ln f = v_z t (1 - q) + g t^2 q,  q = k . e / |e|^2,  k = e - (v + omega x r),
/// with e the horizontal velocity and t the time of flight.
KickResidual residual_of(const WatchedKick& kick);

}  // namespace trivela::evaluator
