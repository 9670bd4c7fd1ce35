#pragma once

#include "bus/messages.hpp"
#include "hal/wheels.hpp"
#include "nodes/odometry/wheel_odometry.hpp"

namespace trivela::nodes {

/// The estimate with the sample it was made from; robot_id and seq are the node's.
msg::Odometry odometry_message(const hal::WheelSample& sample, const OdometryEstimate& estimate);

}  // namespace trivela::nodes
