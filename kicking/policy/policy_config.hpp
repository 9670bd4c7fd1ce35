#pragma once

#include <optional>
#include <vector>

#include "kicking/alignment/alignment.hpp"
#include "kicking/ballistics/crossing.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/outcome/opponents.hpp"
#include "kicking/policy/drives/test_drive_config.hpp"
#include "kicking/policy/learned_model.hpp"
#include "kicking/policy/match_rules.hpp"
#include "kicking/policy/predictive/predictive_config.hpp"

namespace trivela::kicking {

/// Exit speed of a moving robot. kPaper: V_kick = V0 - k v cos(theta) (section 2.2), distance as of now.
/// kExact: velocities added at the ball's point, at the release.
enum class MotionLaw { kPaper, kExact };

/// Direction of a moving robot's kick. kPaperLine: alpha and beta are lines through the origin (sections 3.2, 3.3).
/// kPhysical: alpha by velocity addition at the ball's point, beta the turn until the release (delay and half a cycle).
enum class AlphaLaw { kPaperLine, kPhysical };

/// What a kick is for. kGoal where a keeper is tracked: past it, into a corner; elsewhere, and kOnTarget always:
/// between the posts and below the bar, as the paper counts.
enum class Objective { kOnTarget, kGoal };

/// How to decide and to drive. The defaults are those that play best in the default world
/// (config/policies/tuned_*.toml, docs/decisions/0021): heights by the paper's range law, speeds by the exact one,
/// direction by the paper's lines. The paper as printed is kPaper, kPaper, kPaperLine and half a width of 0.1 m
/// (config/policies/paper.toml); the released code is kExtendedRange, kPaper.
struct PolicyConfig {
  HeightLaw height_law = HeightLaw::kPaper;
  MotionLaw motion_law = MotionLaw::kExact;
  AlphaLaw alpha_law = AlphaLaw::kPaperLine;
  /// S1 and S2 of the moving policy (paper, section 3.4).
  AlignmentRule alignment{.half_width_m = 0.8};

  Objective objective = Objective::kGoal;
  KeeperConfig keeper{};  ///< of the opponents
  /// Past a keeper a kick is aimed so far inside of a post (ball's centre from where it is clean; tuned).
  double corner_margin_m = 0.15;
  /// In place of dribble_mps, since near the goal a keeper has less time (tuned).
  double goal_dribble_mps = 2.0;

  /// Aim point on the goal line: x in F; height of the ball's centre over the floor (kicker.map: 0.70 m), which the
  /// paper's height law does not have. Test drives aim at it by the exact law.
  double target_x_m = 0.0;
  double target_height_m = 0.70;
  /// Older world states and kicker statuses are not acted upon: the released predictor's 140 ms from sensing to
  /// release.
  double max_state_age_s = 0.14;
  /// Control cycle (CAMBADA release 1.0: MOTION_TICK 20 ms).
  double cycle_s = 0.02;
  /// After an order the same possession fires again only when this long has passed: the order was refused (assumed).
  double order_hold_s = 0.5;

  /// Stopped policy: heading tolerance and time at rest, both tuned (CAMBADA release 1.0 has 1 degree, the Falcons
  /// 0.25 s). Settling goes on up to twice the tolerance, a kick needs the tolerance itself.
  double aim_tolerance_rad = radians(5.0);
  double settle_s = 0.0;
  /// At rest below these: tuned, and no faster than what still is one that stops (0.3 m/s, 0.5 rad/s).
  double rest_speed_mps = 0.3;
  double rest_turn_rate_radps = 0.5;
  /// How sharply the stopped policy turns onto the target: turn rate per heading error near zero (assumed).
  double stopped_turn_gain_hz = 6.0;
  /// The same for the moving policy, which turns through the target instead of creeping up to it: above 1 / beta slope
  /// (assumed).
  double moving_turn_gain_hz = 12.0;

  /// Limits with the ball: forward (CAMBADA: dribbling 2.2 m/s), sideways and backward (Falcons: 0.5 m/s).
  double max_forward_mps = 2.2;
  double max_sideways_mps = 0.5;
  /// Speed over ground that both policies drive towards the goal with; the stopped one only while out of range
  /// (assumed).
  double dribble_mps = 1.2;
  /// Neither policy drives the robot's centre closer to the target than this, braking with max_brake (assumed).
  double keep_off_m = 2.5;
  double max_brake_mps2 = 2.5;
  /// Turning with the ball (Falcons: 2.5 rad/s; acceleration assumed 4 rad/s2, of which the profile uses three
  /// quarters).
  double max_turn_rate_radps = 2.5;
  double max_turn_acceleration_radps2 = 4.0;

  /// Of the match; test drives have none.
  MatchRules rules{};
  /// A ball is in the opponents' half whose centre is so far beyond the half-way line: as well as one's own place is
  /// known (VDL Robotsports, role_assigner, min_y_for_lob_shot: 0.25 m).
  double half_line_margin_m = 0.25;
  /// The policies carry the ball so much less far than they may (assumed: errors of the place, and of braking).
  double carry_margin_m = 0.3;

  /// Of policy kLearned, which is not played without one.
  std::optional<LearnedModel> learned{};

  PredictiveConfig predictive{};

  TestDriveConfig test_drive{};

  /// Settings of the policies from outside, in the order of their places behind kPolicyCount; usual ones may lack.
  std::vector<std::vector<double>> own{};
};

}  // namespace trivela::kicking
