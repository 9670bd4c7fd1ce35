#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

#include "config/settings.hpp"
#include "kicking/geometry/frames.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::robot {

/// The odometry poses of the last `span_s`, to look up any instant in between.
class PoseHistory {
 public:
  explicit PoseHistory(double span_s) : span_ns_(kicking::nanoseconds(span_s)) {}

  /// Appends; an instant that is not newer than the last one starts the history again.
  void add(std::int64_t t_ns, const kicking::Pose& pose);

  bool empty() const { return count_ == 0; }
  const kicking::TurnedPose& latest() const { return entry(count_ - 1).pose; }

  /// Linear interpolation between the neighbours; the oldest or newest entry outside the span; nullopt when empty.
  std::optional<kicking::TurnedPose> at(std::int64_t t_ns) const;

 private:
  struct Entry {
    std::int64_t t_ns;
    kicking::TurnedPose pose;
  };
  std::size_t place(std::size_t i) const { return (first_ + i) & mask_; }
  const Entry& entry(std::size_t i) const { return ring_[place(i)]; }  // 0: the oldest
  void grow();

  std::int64_t span_ns_;
  std::vector<Entry> ring_ = std::vector<Entry>(64);  // a power of two; grows where more fit into the span
  std::size_t mask_ = ring_.size() - 1;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

/// Where the robot is: odometry carried forward, corrected by self-localisation at the instant its picture was taken.
///
/// A frame exposed at t_e is compared with the pose that odometry gives for t_e; the correction
///
///     pose(t_e) += K (seen - pose(t_e)),   K = P / (P + R)
///
/// is then carried to now along the odometry driven since. P grows with odometry's variance. A run of
/// `relocalise_frames` innovations beyond `relocalise_distance_m` or 0.2 rad that agree within these means that
/// somebody moved the robot: the pose is set.
class PoseFilter {
 public:
  explicit PoseFilter(const config::WorldState& settings) : settings_(settings), history_(settings.history_s) {}

  /// Odometry's pose in its own frame and its accumulated variances at t_ns.
  void predict(std::int64_t t_ns, const kicking::Pose& odometry, double var_position_m2, double var_heading_rad2);

  /// Self-localisation of a picture taken at `t_exposure_ns`; ignored before the first predict().
  void correct(std::int64_t t_exposure_ns, const kicking::Pose& seen);

  /// Pose in F at the last prediction; nullptr before the first correction.
  const kicking::TurnedPose* pose() const { return localised_ ? &pose_ : nullptr; }
  double sd_position_m() const;
  double sd_heading_rad() const;

  /// The pose in F that the robot had at t_ns within the history, by the present estimate.
  std::optional<kicking::TurnedPose> pose_at(std::int64_t t_ns) const;

 private:
  /// Carries pictured_, the belief about the instant of a picture, to now.
  void carry(std::int64_t t_exposure_ns, const kicking::Pose& driven_since);
  void count_far_frames(double innovation_x_m, double innovation_y_m, double innovation_rad);

  config::WorldState settings_;
  PoseHistory history_;
  bool localised_ = false;
  kicking::TurnedPose pose_{};
  kicking::TurnedPose pictured_{};  // pose_ at the instant of the last picture that was believed
  std::optional<std::int64_t> pictured_t_ns_;
  double var_position_m2_ = 0.0;
  double var_heading_rad2_ = 0.0;
  double last_var_position_m2_ = 0.0;
  double last_var_heading_rad2_ = 0.0;
  std::uint32_t far_frames_ = 0;
  double far_x_m_ = 0.0, far_y_m_ = 0.0, far_rad_ = 0.0;  // innovation of the last frame
};

}  // namespace trivela::robot
