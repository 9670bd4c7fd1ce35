#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "config/devices.hpp"
#include "hal/gyro.hpp"
#include "hal/kicker.hpp"
#include "hal/range_finder.hpp"
#include "hal/wheels.hpp"
#include "kicking/model/omni_kinematics.hpp"

namespace trivela::bus {
class Participant;
}

/// The one door to every device. Throws std::runtime_error with what the backend says.
namespace trivela::hal {

/// Whose device it is.
struct Owner {
  const bus::Participant& participant;
  std::uint8_t robot_id = 1;
  kicking::WheelBase base{};  ///< for wheels that are driven one by one
};

/// kListen is for backends that power motors; a bridge on the bus and a recording are opened as ever.
std::unique_ptr<Wheels> open_wheels(const config::Hal& devices, const Owner& owner, WheelsUse use = WheelsUse::kDrive);
std::unique_ptr<Kicker> open_kicker(const config::Hal& devices, const Owner& owner);
std::unique_ptr<RangeFinder> open_range_finder(const config::RangeFinderDevice& device, const Owner& owner);

/// A gyro that is a device of its own, as open_wheels() puts it beside the wheels; null: the wheels have it.
std::unique_ptr<Gyro> open_gyro(const config::GyroDevice& device);

/// A SCIP scanner needs no bus. Nothing is opened yet: connected() and read() do, and a scanner that is not there shows
/// in status().
std::unique_ptr<RangeFinder> open_range_finder(const config::ScipDevice& scanner);

/// The same by its address: "tcp://HOST:PORT" or the path of a serial device, as "/dev/ttyACM0". Throws
/// std::runtime_error naming an address of another form.
std::unique_ptr<RangeFinder> open_range_finder(const std::string& address);

}  // namespace trivela::hal
