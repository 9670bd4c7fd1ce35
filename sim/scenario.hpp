#pragma once

#include <vector>

#include "kicking/policy/match_rules.hpp"

/// Every input of the simulated world: a named value with its unit and its source. "Assumption" marks a number that no
/// publication gives; results depend on it and reports must say so. SI throughout; angles in rad.
namespace trivela::sim {

using Field = kicking::PlayingField;

struct BallPhysics {
  double mass_kg = 0.43;                   ///< FIFA size 5: 0.43 +- 0.02 kg
  double radius_m = 0.11;                  ///< FIFA size 5: circumference 0.69 +- 0.01 m
  double air_density_kgpm3 = 1.2;          ///< air at 20 degrees C
  double drag_coefficient = 0.25;          ///< fit to Hawk-Eye flights of footballs at 7-10 m/s
  double gravity_mps2 = 9.81;              ///< standard
  double restitution_ratio = 0.65;         ///< vertical speed kept in a bounce; assumption within 0.6-0.75 for carpet
  double retention_ratio = 0.8;            ///< horizontal speed kept in a bounce; Hawk-Eye flights on grass
  double roll_below_mps = 0.3;             ///< a bounce slower than this ends in rolling; assumption
  double rolling_deceleration_mps2 = 0.5;  ///< assumption
  /// Above 0 the floor acts by friction in place of retention_ratio, and the ball has spin (sim/kicker/flight.hpp).
  double sliding_friction_ratio = 0.0;
  double frame_restitution_ratio = 0.5;  ///< speed kept when post or bar throws the ball back; assumption
  double body_restitution_ratio = 0.3;   ///< speed kept when an opponent's body throws the ball back; assumption
};

/// The robot's base while it dribbles.
struct Robot {
  double max_speed_mps = 2.2;                 ///< CAMBADA release 1.0: dribbling <= 2.2 m/s
  double max_acceleration_mps2 = 2.5;         ///< assumption, braking included
  double max_turn_rate_radps = 2.5;           ///< Falcons configuration: 2.5 rad/s with the ball
  double max_turn_acceleration_radps2 = 4.0;  ///< assumption; Falcons configuration says 3 rad/s2
  double ball_offset_m = 0.27;                ///< robot centre to ball centre; CAMBADA release 1.0
  /// Where the wheels sit, counter-clockwise from +x of R; each drives along the counter-clockwise tangent. Assumption:
  /// 30, 150 and 270 degrees, two in front, one behind.
  std::vector<double> wheel_angles_rad{0.5235987755982988, 2.6179938779914944, 4.71238898038469};
  double wheel_distance_m = 0.22;  ///< assumption for a base of 0.52 m
  double wheel_radius_m = 0.05;    ///< assumption
};

/// What the kicker does with its lever down. Its table is true as the lob's.
struct FlatKick {
  bool enabled = false;
  std::vector<double> powers{15, 20, 25, 30, 35, 40, 45, 50};
  /// Assumption: a little faster than the lob. Published: 10.3 m/s at 14 degrees (Falcons).
  std::vector<double> exit_speeds_mps{6.0, 7.4, 8.6, 9.5, 10.2, 10.6, 10.9, 11.0};
  /// 6 degrees; assumption.
  std::vector<double> exit_elevations_rad{0.1047, 0.1047, 0.1047, 0.1047, 0.1047, 0.1047, 0.1047, 0.1047};
  double delay_s = 0.060;                          ///< as the lob's
  double delay_sd_s = 0.015;                       ///< as the lob's
  double speed_sd_ratio = 0.02;                    ///< as the lob's
  double direction_sd_rad = 0.026179938779914945;  ///< 1.5 degrees, as the lob's
  double lever_s = 0.25;                           ///< that the lever takes: Falcons' ioBoard, 205 positions of 1.2 ms
};

/// The electromagnetic kicker. The table is *true*: what leaves the robot at rest, before drag. Its default is the one
/// whose drag flights give CAMBADA's published *effective* table (release 1.0 kicker.map, robot 1) when they are
/// measured by apex and range; see true_exit().
struct Kicker {
  std::vector<double> powers{15, 20, 25, 30, 35, 40, 45, 50};
  std::vector<double> exit_speeds_mps{6.087298,  7.549161,  8.721521,  9.65186,
                                      10.358872, 10.782613, 11.091813, 11.175526};
  std::vector<double> exit_elevations_rad{0.63417893, 0.63026363, 0.62666896, 0.62356544,
                                          0.62107594, 0.61953496, 0.61838909, 0.61807589};
  double speed_scale_ratio = 1.0;  ///< this robot's speed against the table; 1: as calibrated
  double drift_sd_ratio = 0.01;    ///< of the speed within the day: one factor a match and robot; assumption
                                   ///< ("differences within the same robot over time", paper, section 2)
  double drop_ratio = 0.0;  ///< a part gives way in the match: of the speed, lost from one kick to the next; 0: none
  double drop_after_kicks = 0.0;  ///< of each robot, whose ball left before that
  double delay_s =
      0.060;  ///< coil energised to ball released; assumption, CAMBADA release 1.0 says 50 ms mean, 80 ms max
  double delay_sd_s = 0.015;                       ///< assumption: the spread between those
  double speed_sd_ratio = 0.02;                    ///< assumption
  double direction_sd_rad = 0.026179938779914945;  ///< 1.5 degrees; assumption
  double transfer_forward_ratio =
      1.0;  ///< ball-point velocity that the ball keeps; assumption, 1: rigid body, no floor loss
  double transfer_backward_ratio = 1.0;  ///< the same when driving backwards; assumption
  double transfer_lateral_ratio = 1.0;   ///< the same sideways; assumption, Table 1 of the paper is explained by 1
  FlatKick flat;
  double charge_per_kick_ratio = 0.5;  ///< capacitor energy that the highest power takes; assumption
  double recharge_per_s = 0.333;       ///< capacitor energy regained a second; assumption: 3 s from empty to full
};

/// How the robot gains the ball: the distributions that each opportunity is drawn from.
struct Possession {
  double goal_distance_min_m = 3.0;                     ///< ball to goal line; assumption
  double goal_distance_max_m = 9.0;                     ///< assumption
  double lateral_max_m = 3.0;                           ///< ball to the middle line, either side; assumption
  double aim_error_sd_rad = 1.2217304763960306;         ///< 70 degrees, heading against the goal centre; assumption
  double speed_min_mps = 0.3;                           ///< assumption
  double speed_max_mps = 2.0;                           ///< assumption
  double travel_direction_sd_rad = 0.7853981633974483;  ///< 45 degrees, velocity against heading; assumption
  double time_limit_s = 8.0;                            ///< the possession ends without a kick; assumption
  double stop_s = 0.4;  ///< the referee's stop before each possession; assumption: as short as the filters allow
  double flight_limit_s = 3.0;    ///< a ball that has not crossed by then is short; assumption
  double after_crossing_s = 0.2;  ///< play goes on so that cameras see the ball behind the line; assumption
};

/// Opponents: each keeps up with the ball and closes at its own constant rate.
struct Opponent {
  double count = 1.0;               ///< 1 to 5
  double distance_median_m = 1.5;   ///< the nearest one, log-normal; published MSL log of 2016, n = 19: median 1.50 m
  double distance_sigma_ln = 0.55;  ///< the same log: quartiles 1.24 and 2.01 m
  double further_median_m = 4.0;    ///< every further one, log-normal, not nearer than the nearest; assumption
  double closing_min_mps = 0.8;     ///< assumption
  double closing_max_mps = 2.0;     ///< assumption
  double dispute_distance_m = 0.5;  ///< opponent centre to ball centre; assumption
  double body_radius_m = 0.26;      ///< rules: 52 x 52 x 80 cm
  double body_height_m = 0.8;       ///< rules: 52 x 52 x 80 cm
};

/// A robot that stands in a ball's way on a line of its own and moves along it (sim/guard.hpp).
struct Guard {
  double reaction_s = 0.25;   ///< it acts on what the ball did so long ago; assumption
  double sight_sd_mps = 0.5;  ///< error of the ball's speed across its way, one a kick; assumption: a line through 8
                              ///< pictures of a quarter of a second, each 0.1 m off
  double speed_mps = 2.0;     ///< sideways; Falcons configuration, robot 1 (the keeper): 2.0 m/s
  double acceleration_mps2 = 4.5;  ///< the same file: 4.5 m/s2
  double half_width_m = 0.26;      ///< rules: 52 cm wide
  double height_m = 0.8;           ///< rules: 80 cm high
  double overlap_m = 0.05;         ///< of ball and body; a ball that overlaps less goes on. Assumption
};

/// The opponents' keeper. Off where shots between posts and bar are counted, as Table 2 of the paper does.
struct Keeper {
  bool enabled = false;
  Guard guard;
  double side_extension_m =
      0.08;  ///< of a frame that it pushes out to one side ...; rules of 2016, RC-4.2.0: 60 x 60 x 90 cm
  double up_extension_m = 0.1;  ///< ... or up, one at a time; the same rule
  double extension_s = 0.1;     ///< until the frame is out; assumption
  double advance_m = 0.0;  ///< it stands so far before the goal line, on the line from the ball to the goal's middle
  double guess_m = 0.0;    ///< as the ball leaves it drives so far to a side drawn by lot; 0: it waits and looks
};

/// Opponents that stand before their goal and stop what comes low. Off in most worlds.
struct Defenders {
  double count = 0.0;            ///< 0: none
  double line_distance_m = 1.0;  ///< of their line before the goal line; assumption: outside the goal area (0.75 m)
  double spread_sd_m = 0.5;      ///< of each one's place about the line from the ball to the goal's middle; assumption
  Guard guard;
};

/// The referee.
struct Referee {
  double stops_per_min = 0.5;  ///< whistles in a minute of carrying the ball; assumption
  double half_minutes = 5.0;   ///< length of a half where nobody says another; a choice, the paper's have 15
  bool set_pieces = false;     ///< each possession is a set piece of ours: it is announced in the stop before it, the
                               ///< robot stands, and who has not kicked within rules.set_piece_s is stopped
};

/// Our robots. One of them, drawn for each possession, gains the ball.
struct Team {
  double robots = 1.0;                     ///< 1 to 5
  std::vector<double> speed_scale_ratios;  ///< of each robot's kicker, times kicker.speed_scale_ratio; empty: all 1
};

/// Noise of wheels and gyro.
struct Odometry {
  double wheel_sd_radps = 0.6;       ///< white, each sample; assumption: 3 cm/s at the rim
  double slip_sd_ratio = 0.02;       ///< scale error of a wheel, constant in a possession; assumption
  double gyro_sd_radps = 0.02;       ///< white, each sample; assumption
  double gyro_bias_sd_radps = 0.01;  ///< constant in a possession; assumption
};

/// The robot's camera. Its pose error has a white part and a slow one that a filter cannot average away:
/// sqrt(0.05^2 + 0.11^2) m gives the published localisation noise of 0.12 m.
struct Vision {
  double latency_s = 0.06;              ///< exposure to publication; assumption within CAMBADA's 140 ms sense-to-act
  double position_white_sd_m = 0.05;    ///< per axis and frame; assumption
  double position_slow_sd_m = 0.11;     ///< per axis, Gauss-Markov; assumption
  double heading_white_sd_rad = 0.010;  ///< assumption
  double heading_slow_sd_rad = 0.010;   ///< Gauss-Markov; assumption
  double slow_time_s = 2.0;             ///< correlation time of the slow parts; assumption
  double ball_sd_m = 0.02;              ///< per axis, a ball at the robot; assumption
  double ball_sd_ratio = 0.02;          ///< grows with the distance; assumption
  double ball_range_m = 8.0;            ///< farther balls are not seen; assumption
  double ball_height_max_m = 0.4;       ///< higher balls are not taken for a ball on the floor; assumption
  double opponent_sd_m = 0.14;          ///< per axis; MSL log of 2016: obstacle against robot, median 0.20 m
  double opponent_range_m = 6.0;        ///< assumption
  double dropout_ratio = 0.02;          ///< frames without a pose, a ball, an opponent, each; assumption
};

/// The camera that follows the ball in flight, referred to the goal seen in the same picture.
struct FlightCamera {
  double latency_s = 0.04;      ///< assumption
  double period_s = 0.02;       ///< between exposures; one a cycle at most; assumption: 50 frames a second
  double position_sd_m = 0.03;  ///< per axis and frame; assumption
  double dropout_ratio = 0.02;  ///< frames without a ball; assumption
  double bias_x_m = 0.0;        ///< of every sighting, in F: the camera, or the goal that it is referred to, is ...
  double bias_y_m = 0.0;        ///< ... elsewhere than it is taken to be
  double bias_z_m = 0.0;
};

/// A laser range finder beside the field (sim/laser/). Off in a match: it is for the calibration.
struct Laser {
  bool enabled = false;
  double x_m = 0.0;                                 ///< in F; assumption: on the axis of the field ...
  double y_m = 1.0;                                 ///< ... and 4 m before the ball of a robot 12 m from the goal line
  double z_m = 0.05;                                ///< over the floor; assumption: it lies on its side
  double heading_rad = 0.0;                         ///< of the scan plane: 0 faces +y
  double front_elevation_rad = 1.5707963267948966;  ///< 90 degrees: it looks straight up; assumption
  double range_sd_m = 0.010;                        ///< UTM-30LX and URG-04LX: 4 to 16 mm measured at 1 to 4 m
  double dropout_ratio = 0.005;                     ///< UTM-30LX recording: 0.7 % invalid
  double mixed_ratio = 0.3;                         ///< of the beams that just miss the ball; assumption
  double mixed_depth_m = 0.5;                       ///< behind the ball's edge; assumption
  double wall_ahead_m = 12.0;                       ///< upright wall before the scanner; assumption
};

/// How the old height table was made by hand, for arms that play with it (sim/kicker/hand_table.hpp). No number of it
/// was published: the paper says how the table was made, not how well.
struct HandTable {
  std::vector<double> distances_m{3, 4, 5, 6, 7, 8, 9};  ///< ball to goal line; assumption
  double target_height_m = 0.70;                         ///< CAMBADA release 1.0 kicker.map
  double kicks_per_distance = 3.0;                       ///< whose mean is judged; assumption
  double eye_height_sd_m = 0.15;                         ///< of a height judged by eye; assumption: a ball's radius up
                                                         ///< to its diameter
  double eye_bias_sd_m = 0.0;  ///< of one more error that all heights of a table share: what its maker takes for a good
                               ///< height; assumption: none
  double day_sd_ratio = 0.04;  ///< kicker speed, day of the table against the match; assumption ("differences within
                               ///< the same robot over time", paper, section 2)
  bool one_for_all = false;    ///< robot 1's table serves everybody; paper: "configured individually for each robot"
};

struct Scenario {
  double cycle_s = 0.02;    ///< control cycle; CAMBADA release 1.0: MOTION_TICK 20 ms
  double substep_s = 0.02;  ///< longest step of the physics; numerical choice
  Field field;
  kicking::MatchRules rules;  ///< who carries the ball farther is stopped by the referee
  BallPhysics ball;
  Robot robot;
  Kicker kicker;
  Possession possession;
  Opponent opponent;
  Keeper keeper;
  Defenders defenders;
  Referee referee;
  Team team;
  Odometry odometry;
  Vision vision;
  FlightCamera flight_camera;
  Laser laser;
  HandTable hand_table;
};

}  // namespace trivela::sim
