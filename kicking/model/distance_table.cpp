#include "kicking/model/distance_table.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace trivela::kicking {

EffectiveTable effective_table(const DistanceTable& table, HeightLaw law, double target_height_m,
                               const RobotModel& robot) {
  const Elevation exit_angle = robot.exit_angle_rad;
  std::vector<SetPoint> points;
  for (std::size_t i = 0; i < table.points.size(); ++i) {
    const DistancePoint& point = table.points[i];
    const FlightPoint target{point.distance_m, target_height_m - robot.ball.radius_m};
    const auto speed_mps = crossing_speed(point_by(law, target, exit_angle), exit_angle);
    const auto fail = [&](const std::string& why) {
      throw std::invalid_argument("height table: distances_m[" + std::to_string(i) +
                                  "] = " + std::to_string(point.distance_m) + ": " + why);
    };
    if (!speed_mps || !std::isfinite(*speed_mps)) fail("no speed reaches the target's height from there");
    if (!points.empty() && !(*speed_mps > points.back().speed_mps)) {
      fail("the speed that it needs must lie above its predecessor's");
    }
    points.push_back({point.power, *speed_mps});
  }
  return EffectiveTable{std::span<const SetPoint>(points)};
}

RobotModel with_distance_table(const RobotModel& robot, const DistanceTable& table, HeightLaw law,
                               double target_height_m) {
  RobotModel model = robot;
  model.table = effective_table(table, law, target_height_m, robot);
  model.exit_angles.reset();
  return model;
}

}  // namespace trivela::kicking
