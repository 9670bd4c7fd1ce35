#pragma once

#include <span>
#include <vector>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/model/robot_model.hpp"

namespace trivela::kicking {

/// One entry of a height table: from this distance a robot at rest kicks with this set-point.
struct DistancePoint {
  double distance_m = 0.0;  ///< ball to goal line
  double power = 0.0;
};

/// The way before the laser (paper, section 2.2): "a table relating distance with kick power, extracted by having the
/// robot kick from several setpoint distances". It knows no speeds and no height law: the height of the target is in
/// the eye of whoever made it.
struct DistanceTable {
  std::vector<DistancePoint> points;
};

/// The table as the laws of the policies read it: the believed exit speed of an entry is the drag-free speed that `law`
/// asks for from that distance, at the robot's exit angle, for the centre of the ball at `target_height_m` over the
/// floor. A robot at rest that decides by the same law and height then kicks with exactly the table's power; in motion
/// the laws correct the power as they would with any table.
/// Throws std::invalid_argument for fewer than 2 or more than PowerTable::kCapacity points, distances or powers that
/// are not finite and rising, and a distance from which no speed reaches the height or at which it does not rise.
EffectiveTable effective_table(const DistanceTable& table, HeightLaw law, double target_height_m,
                               const RobotModel& robot);

/// The robot with that table in place of its own, one exit angle for all powers; every other figure stays.
RobotModel with_distance_table(const RobotModel& robot, const DistanceTable& table, HeightLaw law,
                               double target_height_m);

}  // namespace trivela::kicking
