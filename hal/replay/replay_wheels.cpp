#include "hal/replay/replay_wheels.hpp"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

namespace trivela::hal {

ReplayWheels::ReplayWheels(const ReplayLog& log)
    : rows_(log, "odometry",
            {"t_ns", "wheel_0_radps", "wheel_1_radps", "wheel_2_radps", "wheel_3_radps", "gyro_radps"}) {}

std::optional<WheelSample> ReplayWheels::read(std::chrono::nanoseconds) {
  const auto row = rows_.next();
  if (!row) return std::nullopt;
  WheelSample sample{.t_ns = row->integer(0), .wheel_count = 0, .wheel_radps = {}, .gyro_radps = row->number(5)};
  for (std::size_t i = 0; i < sample.wheel_radps.size(); ++i) {
    const auto speed = row->number(1 + i);
    if (!speed) break;
    sample.wheel_radps[i] = *speed;
    ++sample.wheel_count;
  }
  if (sample.wheel_count == 0) {
    throw std::runtime_error{fmt::format("replay: the odometry at t_ns {} has no wheel", sample.t_ns)};
  }
  return sample;
}

void ReplayWheels::drive(const kicking::Twist& set_point, std::int64_t t_ns) {
  const bool finite =
      std::isfinite(set_point.vx_mps) && std::isfinite(set_point.vy_mps) && std::isfinite(set_point.omega_radps);
  drives_.push_back({t_ns, finite ? set_point : kicking::Twist{}});
}

}  // namespace trivela::hal
