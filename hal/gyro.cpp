#include "hal/gyro.hpp"

#include <cstdlib>

namespace trivela::hal {

std::optional<WheelSample> GyroWheels::read(std::chrono::nanoseconds timeout) {
  auto sample = wheels_->read(timeout);
  if (!sample) return sample;
  const auto turn = gyro_->newest();
  const bool same = turn && std::abs(turn->t_ns - sample->t_ns) <= kSameInstant_ns;
  sample->gyro_radps = same ? kicking::OptionalDouble{turn->gyro_radps} : std::nullopt;
  sample->gyro_emulated = same && emulated_;
  return sample;
}

std::string GyroWheels::status() const {
  const std::string wheels = wheels_->status(), gyro = gyro_->status();
  return wheels.empty() || gyro.empty() ? wheels + gyro : wheels + "; " + gyro;
}

}  // namespace trivela::hal
