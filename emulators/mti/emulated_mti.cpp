#include "emulators/mti/emulated_mti.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <variant>

#include "hal/mti/mti.hpp"

namespace trivela::hal::mti {
namespace {

const std::string kPacketCounter{"\x10\x20\x02", 3};

}  // namespace

std::vector<std::string> EmulatedMti::tick(std::int64_t now_ns) {
  const std::int64_t t_ns = next_ns_ == 0 ? now_ns : next_ns_;
  next_ns_ = std::max(t_ns, now_ns - kPeriod_ns) + kPeriod_ns;
  ++said_;
  if (faults.silent) return {};
  Reading reading{.sample_time = static_cast<std::uint32_t>(t_ns / Reading::kTick_ns), .rate_radps = {}};
  if (!faults.no_rate) reading.rate_radps = {0.0, 0.0, rate_radps};
  Message message = message_of(reading);
  const std::string counter{static_cast<char>(said_ >> 8U & 0xFFU), static_cast<char>(said_ & 0xFFU)};
  message.data = kPacketCounter + counter + message.data;
  std::string bytes = encode(message);
  if (hits(faults.wrong_sums_every)) bytes.back() = static_cast<char>(bytes.back() + 1);
  if (hits(faults.garbled_every)) bytes = bytes.substr(bytes.size() / 2);
  return {bytes};
}

}  // namespace trivela::hal::mti

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
