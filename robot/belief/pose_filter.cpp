#include "robot/belief/pose_filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trivela::robot {

using kicking::Pose;
using kicking::TurnedPose;

void PoseHistory::grow() {
  std::vector<Entry> larger(2 * ring_.size());
  for (std::size_t i = 0; i < count_; ++i) larger[i] = entry(i);
  ring_ = std::move(larger);
  mask_ = ring_.size() - 1;
  first_ = 0;
}

void PoseHistory::add(std::int64_t t_ns, const Pose& pose) {
  if (count_ > 0 && t_ns <= entry(count_ - 1).t_ns) count_ = 0;
  while (count_ > 0 && entry(0).t_ns < t_ns - span_ns_) {
    first_ = place(1);
    --count_;
  }
  if (count_ == ring_.size()) grow();
  ring_[place(count_++)] = {t_ns, TurnedPose{pose}};
}

std::optional<TurnedPose> PoseHistory::at(std::int64_t t_ns) const {
  if (count_ == 0) return std::nullopt;
  if (entry(count_ - 1).t_ns < t_ns) return entry(count_ - 1).pose;
  std::size_t after = count_ - 1;  // the first that is not before t_ns; pictures are of a few cycles ago
  while (after > 0 && entry(after - 1).t_ns >= t_ns) --after;
  const Entry& next = entry(after);
  if (after == 0 || next.t_ns == t_ns) return next.pose;
  const Entry& before = entry(after - 1);
  const double share = static_cast<double>(t_ns - before.t_ns) / static_cast<double>(next.t_ns - before.t_ns);
  const Pose step = relative(before.pose, next.pose);
  return TurnedPose{compose(before.pose, {step.x_m * share, step.y_m * share, step.heading_rad * share})};
}

namespace {
constexpr double kTurned_rad = 0.2;  // far beyond the noise of a frame and the drift between two

}  // namespace

void PoseFilter::predict(std::int64_t t_ns, const Pose& odometry, double var_position_m2, double var_heading_rad2) {
  if (pictured_t_ns_ && t_ns <= *pictured_t_ns_) pictured_t_ns_.reset();  // time begins again
  if (!history_.empty()) {
    pose_ = TurnedPose{compose(pose_, relative(history_.latest(), odometry))};
    var_position_m2_ += std::max(0.0, var_position_m2 - last_var_position_m2_);
    var_heading_rad2_ += std::max(0.0, var_heading_rad2 - last_var_heading_rad2_);
  }
  last_var_position_m2_ = var_position_m2;
  last_var_heading_rad2_ = var_heading_rad2;
  history_.add(t_ns, odometry);
}

std::optional<TurnedPose> PoseFilter::pose_at(std::int64_t t_ns) const {
  if (localised_ && pictured_t_ns_ == t_ns) return pictured_;
  const auto then = history_.at(t_ns);
  if (!then || !localised_) return std::nullopt;
  return TurnedPose{compose(pose_, relative(history_.latest(), *then))};
}

/// Far frames that do not agree with each other are wild ones: each starts the count again.
void PoseFilter::count_far_frames(double innovation_x_m, double innovation_y_m, double innovation_rad) {
  const auto beyond = [limit_m = settings_.relocalise_distance_m](double x_m, double y_m, double angle_rad) {
    return x_m * x_m + y_m * y_m > limit_m * limit_m || std::abs(angle_rad) > kTurned_rad;
  };
  const bool far = beyond(innovation_x_m, innovation_y_m, innovation_rad);
  const bool agrees =
      !beyond(innovation_x_m - far_x_m_, innovation_y_m - far_y_m_, kicking::wrap_angle(innovation_rad - far_rad_));
  if (!far) {
    far_frames_ = 0;
  } else {
    far_frames_ = agrees ? far_frames_ + 1 : 1;
  }
  far_x_m_ = innovation_x_m;
  far_y_m_ = innovation_y_m;
  far_rad_ = innovation_rad;
}

void PoseFilter::correct(std::int64_t t_exposure_ns, const Pose& seen) {
  const auto odometry_then = history_.at(t_exposure_ns);
  if (!odometry_then || !std::isfinite(seen.x_m + seen.y_m + seen.heading_rad)) return;
  const Pose driven_since = relative(*odometry_then, history_.latest());
  const double var_seen_m2 = settings_.pose_sd_m * settings_.pose_sd_m;
  const double var_seen_rad2 = settings_.pose_sd_heading_rad * settings_.pose_sd_heading_rad;
  const Pose then = compose(pose_, relative(history_.latest(), *odometry_then));
  const double dx_m = seen.x_m - then.x_m;
  const double dy_m = seen.y_m - then.y_m;
  const double turn_rad = kicking::wrap_angle(seen.heading_rad - then.heading_rad);
  count_far_frames(dx_m, dy_m, turn_rad);
  if (!localised_ || far_frames_ >= settings_.relocalise_frames) {
    localised_ = true;
    far_frames_ = 0;
    var_position_m2_ = var_seen_m2;
    var_heading_rad2_ = var_seen_rad2;
    pictured_ = TurnedPose{seen};
    return carry(t_exposure_ns, driven_since);
  }
  if (far_frames_ > 0) return;
  const double gain = var_position_m2_ / (var_position_m2_ + var_seen_m2);
  const double gain_heading = var_heading_rad2_ / (var_heading_rad2_ + var_seen_rad2);
  var_position_m2_ *= 1.0 - gain;
  var_heading_rad2_ *= 1.0 - gain_heading;
  pictured_ = TurnedPose{then.x_m + gain * dx_m, then.y_m + gain * dy_m, then.heading_rad + gain_heading * turn_rad};
  carry(t_exposure_ns, driven_since);
}

void PoseFilter::carry(std::int64_t t_exposure_ns, const Pose& driven_since) {
  pictured_t_ns_ = t_exposure_ns;
  pose_ = TurnedPose{compose(pictured_, driven_since)};
}

double PoseFilter::sd_position_m() const { return std::sqrt(var_position_m2_); }
double PoseFilter::sd_heading_rad() const { return std::sqrt(var_heading_rad2_); }

}  // namespace trivela::robot
