#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "config/settings.hpp"
#include "hal/wheels.hpp"
#include "idl/messages.hpp"
#include "kicking/geometry/frames.hpp"
#include "kicking/model/omni_kinematics.hpp"

namespace trivela::robot {

/// Integrates wheel and gyro samples.
///
/// The turn rate is the variance-weighted mean of wheels and gyro; the pose follows the mean twist of the cycle's two
/// ends in closed form (that of its end alone would lead by half a cycle of every change of speed); position variance
/// grows by (drift_ratio * path)^2 and heading variance by (heading_drift_ratio * turn)^2 plus the turn rate's own
/// noise over the cycle.
class WheelOdometry {
 public:
  WheelOdometry(const kicking::WheelBase& base, const config::Odometry& noise)
      : kinematics_(base), noise_(noise), variance_(kinematics_.twist_variance(noise.wheel_sd_radps)) {}

  /// The estimate with the sample that it was made from, until the next call; robot_id and seq are the caller's. The
  /// first sample sets the clock and moves nothing; one that is not finite, faster than 1000 rad/s, of too few wheels
  /// or not newer than the last one is ignored (nullptr).
  [[nodiscard]] const msg::Odometry* update(const hal::WheelSample& sample);

 private:
  double var_v_m2ps2() const { return std::max(variance_.x(), variance_.y()); }

  kicking::OmniKinematics kinematics_;
  config::Odometry noise_;
  Eigen::Vector3d variance_;  // of a twist by wheels alone
  std::optional<std::int64_t> last_t_ns_;
  kicking::Pose pose_{};  // in the frame where it started, its heading not wrapped
  msg::Odometry now_{};   // the last estimate
};

}  // namespace trivela::robot
