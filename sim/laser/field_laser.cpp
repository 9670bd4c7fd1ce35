#include "sim/laser/field_laser.hpp"

#include <utility>

namespace trivela::sim {

LaserModel laser_model(const Laser& laser) {
  LaserModel model;
  model.x_m = laser.x_m;
  model.y_m = laser.y_m;
  model.z_m = laser.z_m;
  model.heading_rad = laser.heading_rad;
  model.front_elevation_rad = laser.front_elevation_rad;
  model.range_sd_m = laser.range_sd_m;
  model.dropout_ratio = laser.dropout_ratio;
  model.mixed_ratio = laser.mixed_ratio;
  model.mixed_depth_m = laser.mixed_depth_m;
  model.wall_ahead_m = laser.wall_ahead_m;
  return model;
}

FieldLaser::FieldLaser(const Laser& laser, double ball_radius_m) {
  if (laser.enabled) builder_.emplace(laser_model(laser), ball_radius_m, kicking::Draws{0, 0});
}

void FieldLaser::begin(const kicking::Draws& draws) {
  if (builder_) builder_->use(draws);
  ball_was_moved_ = true;
}

void FieldLaser::see(std::int64_t t_ns, const Eigen::Vector3d& ball_m) {
  if (!builder_) return;
  // Between two places of a ball that was carried there is no line that it flew.
  builder_->advance(t_ns, ball_was_moved_ ? std::nullopt : std::optional{ball_m});
  ball_was_moved_ = false;
  while (auto scan = builder_->take()) scans_.push_back(std::move(*scan));
}

}  // namespace trivela::sim
