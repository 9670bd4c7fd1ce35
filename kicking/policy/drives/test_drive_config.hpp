#pragma once

#include <cstdint>
#include <vector>

#include "kicking/geometry/angle.hpp"

namespace trivela::kicking {

/// What the test drives do (paper, sections 2.1, 3.2, 3.3). A drive goes through its list once: kicks_per_level kicks
/// with each entry, for the turn drive a bisection with each. Then it kicks no more.
struct TestDriveConfig {
  /// Kicks with each entry; "two kicks a set-point" are the least that show a spread.
  std::uint32_t kicks_per_level = 2;

  /// Every drive but the turn drive kicks a robot at rest, or starts from rest: heading within this, speed and turn
  /// rate below these for so long. Measuring wants a robot that stands, whatever the stopped policy is content with in
  /// play (CAMBADA release 1.0: kick_max_deg_error 1; Falcons: 0.25 s; three standard deviations of filtered odometry
  /// noise).
  double aim_tolerance_rad = radians(1.0);
  double settle_s = 0.25;
  double rest_speed_mps = 0.15;
  double rest_turn_rate_radps = 0.15;

  /// Standing: set-points of the kicker (those of CAMBADA's kicker.map).
  std::vector<double> powers{15, 20, 25, 30, 35, 40, 45, 50};
  /// Standing: kind of kick, as in RobotModel::kind().
  std::uint32_t kick_kind = 0;

  /// Lateral: robot's centre to target at the kick (paper, Table 1: d = 6.0 m).
  double distance_m = 6.0;
  /// Straight: the same. Far: the flight camera sees the ball for longer, and the error of its velocity falls with the
  /// 3/2 power of that; and the lateral drive's kicks are then of the same power, and references for these.
  double straight_distance_m = 6.0;
  /// Both: from the start mark to that place: room to gain speed and to settle (assumed).
  double run_up_m = 1.6;
  /// Over ground to the start mark (assumed).
  double approach_mps = 1.2;
  /// Lateral: velocities past the target's axis, to the right positive (Table 1, both ways).
  std::vector<double> lateral_mps{0.5, -0.5, 1.0, -1.0, 2.0, -2.0};
  /// Straight: velocities along the axis, towards the goal positive (assumed; the information on the transfer grows
  /// with their square).
  std::vector<double> straight_mps{0.0, 0.75, -0.75, 1.5, -1.5};

  /// Turn: turn rates, counter-clockwise positive (assumed; Falcons turn at up to 2.5 rad/s with the ball).
  std::vector<double> turn_radps{0.75, -0.75, 1.5, -1.5, 2.25, -2.25};
  /// Turn: the sweep begins so far before the target (assumed): room to gain the turn rate.
  double turn_lead_rad = radians(70.0);
  /// Turn: the bisection looks for the allowed error between 0 and the length that this angle cuts off (assumed:
  /// 0.15 s at 2.25 rad/s, and half as much again).
  double turn_widest_rad = radians(30.0);
  /// Turn: halvings of that interval, and kicks whose mean decides each: single kicks scatter (assumed).
  std::uint32_t turn_steps = 5;
  std::uint32_t turn_kicks_per_step = 3;
};

}  // namespace trivela::kicking
