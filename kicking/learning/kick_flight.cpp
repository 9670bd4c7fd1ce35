#include "kicking/learning/kick_flight.hpp"

#include <cmath>

#include "kicking/outcome/crossing_spread.hpp"

namespace trivela::kicking {

LinearFlight linear_flight(const KickFlight& flight, const RobotModel& file, const KickerVector& offsets) {
  const double elevation_rad = file.exit_angle_at(flight.power) + offsets[kElevationPart];
  const double v = file.table.speed_for(flight.power) * std::exp(offsets[kSpeedPart]);
  const double c = std::cos(elevation_rad), s = std::sin(elevation_rad);
  const double omega = flight.twist.omega_radps;
  const double heading_rad = flight.release.heading_rad + omega * offsets[kDelayPart];

  const Eigen::Vector2d forward = direction(heading_rad);
  const Eigen::Vector2d right(forward.y(), -forward.x());
  const double front_mps = flight.twist.vy_mps, side_mps = flight.twist.vx_mps - omega * file.ball_offset_m;
  const Transfer& k = file.transfer_exact;
  const double carried_front = k.along_mps(front_mps) + offsets[kAlongPart] * front_mps;
  const double carried_side = (k.lateral + offsets[kSidewaysPart]) * side_mps;
  const Eigen::Vector2d kick = direction(heading_rad + file.direction_rad + offsets[kDirectionPart]);
  const Eigen::Vector2d left(-kick.y(), kick.x());

  const Eigen::Vector2d shown = flight.speed_mps * std::cos(flight.elevation_rad) * direction(flight.direction_rad);
  const Eigen::Vector2d over_floor = shown - v * c * kick - carried_front * forward - carried_side * right;
  LinearFlight linear;
  linear.speed_mps = v;
  linear.cosine = c;
  linear.sine = s;
  linear.residual << over_floor.dot(kick), over_floor.dot(left),
      flight.speed_mps * std::sin(flight.elevation_rad) - v * s,
      flight.late_s ? *flight.late_s - offsets[kDelayPart] : 0.0;
  linear.design.col(kSpeedPart) << v * c, 0.0, v * s, 0.0;
  linear.design.col(kElevationPart) << -v * s, 0.0, v * c, 0.0;
  linear.design.col(kDirectionPart) << 0.0, v * c, 0.0, 0.0;
  // What the ball takes along turns with the robot, too.
  const Eigen::Vector2d turned = omega * (carried_side * forward - carried_front * right);
  linear.design.col(kDelayPart) << turned.dot(kick), omega * v * c + turned.dot(left), 0.0, flight.late_s ? 1.0 : 0.0;
  linear.design.col(kAlongPart) << front_mps * forward.dot(kick), front_mps * forward.dot(left), 0.0, 0.0;
  linear.design.col(kSidewaysPart) << side_mps * right.dot(kick), side_mps * right.dot(left), 0.0, 0.0;
  return linear;
}

}  // namespace trivela::kicking
