#include "hal/open.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <stdexcept>
#include <utility>

#include "hal/bus/sim_range_finder.hpp"
#include "hal/line/line.hpp"
#include "hal/mti/mti.hpp"
#include "hal/scip/scip_range_finder.hpp"

namespace trivela::hal {
namespace {

using config::Hal, config::ScipDevice, config::SimDevice;

/// Whether the port's other end is a program.
bool is_pseudo_terminal(const std::string& port) {
  std::error_code none;
  return std::filesystem::canonical(port, none).string().starts_with("/dev/pts/");
}

std::unique_ptr<Gyro> gyro_of(const config::WheelsGyro&) { return nullptr; }
std::unique_ptr<Gyro> gyro_of(const config::MtiDevice& gyro) {
  return std::make_unique<mti::MtiGyro>(serial_line(gyro.port), gyro);
}

bool is_emulated(const config::WheelsGyro&) { return false; }
bool is_emulated(const config::MtiDevice& gyro) { return is_pseudo_terminal(gyro.port); }

std::unique_ptr<RangeFinder> range_finder(const SimDevice&, const Owner& owner) {
  return std::make_unique<SimRangeFinder>(owner.participant, owner.robot_id);
}
std::unique_ptr<RangeFinder> range_finder(const ScipDevice& scanner, const Owner&) {
  return open_range_finder(scanner);
}

}  // namespace

std::unique_ptr<Wheels> open_wheels(const Hal& devices, const Owner& owner, WheelsUse use) {
  auto opened =
      std::visit([&](const auto& backend) { return wheels_of(backend, devices, owner, use); }, devices.wheels);
  auto gyro = open_gyro(devices.gyro);
  if (!gyro) return opened;
  const bool emulated = std::visit([](const auto& backend) { return is_emulated(backend); }, devices.gyro);
  return std::make_unique<GyroWheels>(std::move(opened), std::move(gyro), emulated);
}

std::unique_ptr<Gyro> open_gyro(const config::GyroDevice& device) {
  return std::visit([](const auto& backend) { return gyro_of(backend); }, device);
}

std::unique_ptr<Kicker> open_kicker(const Hal& devices, const Owner& owner) {
  return std::visit([&](const auto& backend) { return kicker_of(backend, devices, owner); }, devices.kicker);
}

std::unique_ptr<RangeFinder> open_range_finder(const config::RangeFinderDevice& device, const Owner& owner) {
  return std::visit([&](const auto& backend) { return range_finder(backend, owner); }, device);
}

std::unique_ptr<RangeFinder> open_range_finder(const ScipDevice& scanner) {
  return std::make_unique<scip::ScipRangeFinder>(scanner.port != 0 ? tcp_line(scanner.host, scanner.port)
                                                                   : serial_line(scanner.address));
}

std::unique_ptr<RangeFinder> open_range_finder(const std::string& address) {
  if (const auto scanner = config::backend_of<ScipDevice>(address)) return open_range_finder(*scanner);
  throw std::runtime_error{fmt::format("range finder '{}': an address is {}", address, ScipDevice::kName)};
}

}  // namespace trivela::hal
