#pragma once

#include "hal/wheels.hpp"
#include "idl/messages.hpp"
#include "robot/odometry/wheel_odometry.hpp"

namespace trivela::robot {

/// The estimate with the sample it was made from; robot_id and seq are the node's.
msg::Odometry odometry_message(const hal::WheelSample& sample, const OdometryEstimate& estimate);

}  // namespace trivela::robot
