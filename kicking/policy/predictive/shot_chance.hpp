#pragma once

#include <optional>

#include "kicking/model/robot_model.hpp"
#include "kicking/outcome/crossing_spread.hpp"
#include "kicking/policy/policy_config.hpp"

namespace trivela::kicking {

/// The best kick of a robot in one state of motion, and what it is worth.
struct ShotChance {
  double p = 0.0;       ///< on target, nobody in the way
  double p_goal = 0.0;  ///< and past the keeper, where one is tracked
  double power = 0.0;
  double aim_height_m = 0.0;  ///< over the goal line
  KickExit exit{};            ///< that the power gives
  CrossingSpread crossing{};
  bool out_of_range = false;  ///< full power falls to the floor before the line
};

/// What is known of a shot before it is computed: of the last one, a few centimetres away.
struct ShotGuess {
  double sd_z_m = 0.2;
  Elevation exit_angle{};
};

/// Whether no kick of this kind rises to the bar at full power, v_z^2 / (2 g) + 2 r below it. Such a kind has no height
/// to choose: it is kicked at full power, and its ball may touch the floor.
bool low_kick(const RobotModel& robot, const Goal& goal);

/// Aims a robot that is released in some state: direction and side are the state's, the height is the one that
/// maximises P (BestHeight), the power follows in closed form (directed_kick), P by crossing_spread and p_on_target. A
/// low kick has full power; where it falls to the floor before the line its time is floor_time_s().
class ShotModel {
 public:
  /// `keeper`: to be passed; none: nobody.
  ShotModel(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const StateSpread& state,
            const std::optional<KeeperPlace>& keeper = std::nullopt)
      : config_(config),
        robot_(robot),
        goal_(goal),
        state_(state),
        keeper_(keeper),
        best_height_(config.predictive.bounce_ratio, goal, robot.ball),
        low_(low_kick(robot, goal)) {}

  /// The guess is improved. Of a chance of `least` or below it may say 0.
  ShotChance chance(const ReleaseState& release, ShotGuess& guess, double least = 0.0) const;

 private:
  bool aim(const ReleaseState& release, const Eigen::Vector2d& carried_mps, ShotGuess& guess, ShotChance& out) const;
  void go_over_floor(const ReleaseState& release, const Eigen::Vector2d& carried_mps, ShotChance& out) const;

  const PolicyConfig& config_;
  const RobotModel& robot_;
  const Goal& goal_;
  StateSpread state_;
  std::optional<KeeperPlace> keeper_;
  BestHeight best_height_;
  bool low_;
};

/// Probability that an opponent at this distance from the ball, anywhere around it, is in a ball's way: it covers
/// asin(R / r) / pi of the circle, R its radius and the ball's, unless the ball clears its height where they meet.
double p_blocked(const PredictiveConfig& config, double distance_m, const ShotChance& shot, const Ball& ball,
                 double gravity_mps2 = kGravity_mps2);

}  // namespace trivela::kicking
