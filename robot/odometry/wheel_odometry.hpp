#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "config/settings.hpp"
#include "hal/wheels.hpp"
#include "idl/messages.hpp"
#include "kicking/geometry/frames.hpp"
#include "robot/odometry/omni_kinematics.hpp"

namespace trivela::robot {

/// What wheel odometry knows after a sample: twist in R, pose integrated in the frame where it started, variances.
struct OdometryEstimate {
  kicking::Twist twist{};
  kicking::Pose pose{};
  double var_v_m2ps2 = 0.0;
  double var_omega_rad2ps2 = 0.0;
  double var_position_m2 = 0.0;
  double var_heading_rad2 = 0.0;
};

/// Integrates wheel and gyro samples.
///
/// The turn rate is the variance-weighted mean of wheels and gyro; the pose follows the mean twist of the cycle's two
/// ends in closed form (that of its end alone would lead by half a cycle of every change of speed); position variance
/// grows by (drift_ratio * path)^2 and heading variance by (heading_drift_ratio * turn)^2 plus the turn rate's own
/// noise over the cycle.
class WheelOdometry {
 public:
  WheelOdometry(const config::WheelBase& base, const config::Odometry& noise)
      : kinematics_(base), noise_(noise), variance_(kinematics_.twist_variance(noise.wheel_sd_radps)) {}

  /// Takes the samples of instant `t_ns`; the first one sets the clock and moves nothing. Samples that are not finite,
  /// faster than 1000 rad/s or not newer than the last one are ignored (nullopt).
  std::optional<OdometryEstimate> update(std::int64_t t_ns, std::span<const double> wheel_radps,
                                         const std::optional<double>& gyro_radps);

  const OmniKinematics& kinematics() const { return kinematics_; }

 private:
  OmniKinematics kinematics_;
  config::Odometry noise_;
  Eigen::Vector3d variance_;  // of a twist by wheels alone
  std::optional<std::int64_t> last_t_ns_;
  OdometryEstimate estimate_;
};

/// The estimate with the sample it was made from; robot_id and seq are the node's.
msg::Odometry odometry_message(const hal::WheelSample& sample, const OdometryEstimate& estimate);

}  // namespace trivela::robot
