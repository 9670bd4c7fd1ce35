#pragma once

#include <array>
#include <cstddef>

namespace trivela::kicking {

/// A way to drive towards the goal, beside how it turns. With 1, 1, 1 and 0 the robot drives as `predictive` does.
struct DriveStyle {
  double speed_ratio = 1.0;  ///< of the dribbling speed; below 0 the robot drives back
  double side_ratio = 1.0;   ///< of the sideways part of that velocity, up to the greatest sideways speed
  double brake_ratio = 1.0;  ///< of the deceleration with which it turns onto the target
  double aim_ratio = 0.0;    ///< of half the goal's width: aims so far from the target towards where it heads
};

inline constexpr std::size_t kDriveStyles = 4;

/// What a situation looks like when a robot may fire: 1, P of now, |turn rate| / 2.5 rad/s, time until the best later
/// moment [s], chance to lose the ball within 0.1 s, distance / 6 m - 1.
inline constexpr std::array<const char*, 6> kFireFeatureNames{"one",     "p_now",         "turning",
                                                              "later_s", "loss_in_100ms", "distance"};
inline constexpr std::size_t kFireFeatures = kFireFeatureNames.size();

/// What a policy search may change of how `predictive` decides and drives (docs/policies.md, "learned"). The defaults
/// change nothing.
struct LearnedDecision {
  /// w: fires where value_now exp(w f) >= value_later.
  std::array<double, kFireFeatures> fire_weights{};
  double threshold_ratio = 1.0;       ///< of the least probability of a ball on target
  double goal_threshold_ratio = 1.0;  ///< of the least probability of a goal
  double position_ratio = 1.0;        ///< of position_sd_m; the next three of the like
  double heading_ratio = 1.0;
  double speed_ratio = 1.0;
  double turn_rate_ratio = 1.0;
  double hazard_ratio = 1.0;
  double dispute_shift_m = 0.0;  ///< on dispute_distance_m
  double switch_margin = 2e-3;   ///< so much more a way must promise than the one that is driven
  double blocking_ratio = 1.0;   ///< of the probability that an opponent is in the way
  bool opponent_places = false;  ///< it goes by where opponents stand, whatever the settings say
  double lever_worth = 0.85;     ///< of a kick for which the lever moves first
  std::size_t styles = 1;        ///< of those below; the first is the one that a possession begins with
  std::array<DriveStyle, kDriveStyles> style{};
};

}  // namespace trivela::kicking
