#include "emulators/mti/emulated_gyro.hpp"

#include <fmt/core.h>

#include <variant>

namespace trivela::hal {

std::string EmulatedGyro::setting() const {
  return fmt::format("hal.{}.port=\"{}\"", config::MtiDevice::kName, emulator_.address());
}

void EmulatedGyro::show(double gyro_radps) {
  emulator_.with_board([&](mti::EmulatedMti& mti) { mti.rate_radps = sign_ * gyro_radps; });
}

std::unique_ptr<EmulatedGyro> emulated_gyro(const config::GyroDevice& host) {
  const auto* const gyro = std::get_if<config::MtiDevice>(&host);
  return gyro == nullptr ? nullptr : std::make_unique<EmulatedGyro>(*gyro);
}

}  // namespace trivela::hal
