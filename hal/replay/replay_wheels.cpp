#include "hal/replay/replay_wheels.hpp"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

#include "hal/open.hpp"
#include "kicking/maybe.hpp"

namespace trivela::hal {

std::optional<WheelSample> ReplayWheels::read(std::chrono::nanoseconds) {
  const auto row = samples_.next();
  if (!row) return std::nullopt;
  WheelSample sample{.t_ns = row->t_ns, .wheel_count = 0, .wheel_radps = {}, .gyro_radps = row->gyro_radps};
  for (const kicking::Maybe speed_radps :
       {row->wheel_0_radps, row->wheel_1_radps, row->wheel_2_radps, row->wheel_3_radps}) {
    if (!speed_radps) break;
    sample.wheel_radps[static_cast<std::size_t>(sample.wheel_count++)] = *speed_radps;
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

namespace trivela::config {

std::unique_ptr<hal::Wheels> wheels_of(const ReplayDevice&, const Hal& devices, const hal::Owner& owner,
                                       hal::WheelsUse) {
  return std::make_unique<hal::ReplayWheels>(hal::ReplayLog::open(devices.replay_log, owner.robot_id));
}

}  // namespace trivela::config
