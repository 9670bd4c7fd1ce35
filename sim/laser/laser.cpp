#include "sim/laser/laser.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "kicking/geometry/time.hpp"

namespace trivela::sim {
namespace {

constexpr std::uint32_t kNoAnswer_mm = 1;  // an error code of SCIP 2.0

double background_m(const LaserModel& laser, double cos_a, double sin_a) {
  double range_m = std::numeric_limits<double>::infinity();
  const auto plane = [&](double distance_m, double approach) {
    if (approach > 0.0) range_m = std::min(range_m, distance_m / approach);
  };
  plane(laser.z_m, -sin_a);
  if (laser.wall_ahead_m) plane(*laser.wall_ahead_m, cos_a);
  if (laser.wall_behind_m) plane(*laser.wall_behind_m, -cos_a);
  if (laser.ceiling_m) plane(*laser.ceiling_m - laser.z_m, sin_a);
  return range_m;
}

}  // namespace

ScanBuilder::ScanBuilder(const LaserModel& laser, double ball_radius_m, const kicking::Draws& draws,
                         std::int64_t first_t_ns)
    : laser_(laser), radius_m_(ball_radius_m), draws_(draws), first_t_ns_(first_t_ns), t_ns_(first_t_ns) {
  const auto& geometry = laser_.geometry;
  if (geometry.beams == 0 || !(geometry.beam_period_s > 0.0) || !(geometry.scan_period_s > 0.0)) {
    throw std::invalid_argument("laser: beams = " + std::to_string(geometry.beams) +
                                ", beam_period_s = " + std::to_string(geometry.beam_period_s) +
                                " and scan_period_s = " + std::to_string(geometry.scan_period_s) + " must be positive");
  }
  for (std::size_t i = 0; i < geometry.beams; ++i) {
    const double angle = geometry.first_angle_rad + static_cast<double>(i) * geometry.step_rad;
    const double elevation = laser_.front_elevation_rad + (laser_.mirrored ? -angle : angle);
    const double cos_a = std::cos(elevation), sin_a = std::sin(elevation);
    beams_.push_back({cos_a, sin_a, background_m(laser_, cos_a, sin_a)});
  }
  scan_ = {first_t_ns_, std::vector<std::uint32_t>(geometry.beams)};
}

std::int64_t ScanBuilder::beam_t_ns(std::size_t i) const {
  return scan_.t_ns + kicking::nanoseconds(static_cast<double>(i) * laser_.geometry.beam_period_s);
}

Eigen::Vector3d ScanBuilder::in_plane(const Eigen::Vector3d& ball) const {
  const double dx = ball.x() - laser_.x_m, dy = ball.y() - laser_.y_m;
  const double cos_h = std::cos(laser_.heading_rad), sin_h = std::sin(laser_.heading_rad);
  return {-sin_h * dx + cos_h * dy, -cos_h * dx - sin_h * dy, ball.z() - laser_.z_m};
}

void ScanBuilder::advance(std::int64_t t_ns, const std::optional<Eigen::Vector3d>& ball) {
  if (t_ns < t_ns_) {
    throw std::invalid_argument("laser: t_ns = " + std::to_string(t_ns) + " is before " + std::to_string(t_ns_));
  }
  const std::optional<Eigen::Vector3d> next = ball ? std::optional(in_plane(*ball)) : std::nullopt;
  for (std::int64_t beam_t = beam_t_ns(next_beam_); beam_t <= t_ns; beam_t = beam_t_ns(next_beam_)) {
    std::optional<Eigen::Vector3d> now;
    if (ball_ && next) {
      const double part = t_ns == t_ns_ ? 1.0 : static_cast<double>(beam_t - t_ns_) / static_cast<double>(t_ns - t_ns_);
      now = Eigen::Vector3d{std::lerp(ball_->x(), next->x(), part), std::lerp(ball_->y(), next->y(), part),
                            std::lerp(ball_->z(), next->z(), part)};
    }
    measure(next_beam_, now);
    if (++next_beam_ < beams_.size()) continue;
    complete_.push_back(std::exchange(scan_, {0, std::vector<std::uint32_t>(beams_.size())}));
    ++scan_index_;
    scan_.t_ns = first_t_ns_ + kicking::nanoseconds(scan_index_ * laser_.geometry.scan_period_s);
    next_beam_ = 0;
    edge_m_.reset();
  }
  t_ns_ = t_ns;
  ball_ = next;
}

std::optional<kicking::lob::Scan> ScanBuilder::take() {
  if (complete_.empty()) return std::nullopt;
  std::optional<kicking::lob::Scan> oldest = std::move(complete_.front());
  complete_.pop_front();
  return oldest;
}

std::optional<double> ScanBuilder::ball_range(const Beam& beam, const Eigen::Vector3d& ball) const {
  const double along = ball.x() * beam.cos_a + ball.z() * beam.sin_a;
  const double q = ball.x() * beam.sin_a - ball.z() * beam.cos_a;
  const double depth2 = radius_m_ * radius_m_ - ball.y() * ball.y() - q * q;  // (rho^2 - q^2)
  if (along <= 0.0 || depth2 <= 0.0) return std::nullopt;
  const double range_m = along - std::sqrt(depth2);
  return range_m < beam.background_m ? std::optional(range_m) : std::nullopt;
}

void ScanBuilder::measure(std::size_t i, const std::optional<Eigen::Vector3d>& ball) {
  const auto hit_m = ball ? ball_range(beams_[i], *ball) : std::nullopt;
  scan_.range_mm[i] = answer(i, hit_m.value_or(beams_[i].background_m));
  if (hit_m && !edge_m_ && i > 0) mix(i - 1, *hit_m);
  if (!hit_m && edge_m_) mix(i, *edge_m_);
  edge_m_ = hit_m;
}

void ScanBuilder::mix(std::size_t i, double edge_m) {
  const double u = draws_.uniform(kicking::Role::kLaserMixed, scan_index_, static_cast<std::uint32_t>(i));
  if (u >= laser_.mixed_ratio) return;
  const double far_m = std::max(edge_m, std::min(beams_[i].background_m, edge_m + laser_.mixed_depth_m));
  scan_.range_mm[i] = answer(i, std::lerp(edge_m, far_m, u / laser_.mixed_ratio));
}

std::uint32_t ScanBuilder::answer(std::size_t i, double range_m) const {
  if (!(range_m >= laser_.geometry.min_range_m && range_m <= laser_.geometry.max_range_m)) return kNoAnswer_mm;
  const auto beam = static_cast<std::uint32_t>(i);
  if (draws_.uniform(kicking::Role::kLaserDropout, scan_index_, beam) < laser_.dropout_ratio) return kNoAnswer_mm;
  const double noise = draws_.normals(kicking::Role::kLaserNoise, scan_index_, beam / 4)[beam % 4];
  return static_cast<std::uint32_t>(std::max(0L, std::lround(1000.0 * (range_m + laser_.range_sd_m * noise))));
}

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
