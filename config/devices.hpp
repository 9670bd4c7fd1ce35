#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

/// Devices as a file names them: a variant of backends, which hal/open.hpp opens. A backend with settings of its own
/// lists them in `fields`; they stand in the table that has its name, beside the device's key.
namespace trivela::config {

/// Behind a bridge on the bus, of which the simulator is one (idl/README.md); once called sim.
struct BusDevice {
  static constexpr std::string_view kName = "bus";
  static constexpr bool kInLockstep = true;  ///< its samples may be of simulated time
};

/// The simulator's laser, over the bus.
struct SimDevice {
  static constexpr std::string_view kName = "sim";
};

/// What hal.replay_log recorded; nothing that is ordered is done.
struct ReplayDevice {
  static constexpr std::string_view kName = "replay";
  static constexpr bool kInLockstep = true;
};

/// The Falcons' ioBoard on a serial line (docs/devices/ioboard.md).
struct IoBoardDevice {
  static constexpr std::string_view kName = "ioboard";
  std::string port = "/dev/ttyUSB0";
  double pulse_us_per_power = 128.0;    ///< the coil's pulse for one unit of the table's set-points
  std::optional<std::uint8_t> lever{};  ///< height, 0 home to 205; none: the table's (Robot::lever), if it says one
  double charge_time_s = 3.0;           ///< from empty to full (assumed): the board does not say its charge
};

/// A ReKick board on a CAN bus (docs/devices/rekick.md).
struct ReKickDevice {
  static constexpr std::string_view kName = "rekick";
  std::string port = "can0";                ///< an interface, or the path of an emulator's socket
  double pulse_us_per_power = 100.0 / 3.0;  ///< of the coil: set-points in percent, as those of its public host
  std::uint16_t max_voltage_v = 330;        ///< that it charges to
};

/// A scanner that speaks SCIP, by its address.
struct ScipDevice {
  static constexpr std::string_view kName = "tcp://HOST:PORT (Hokuyo's port is 10940) or the path of a device";
  std::string address;     ///< as it was written; without a port the path of a serial device
  std::string host;        ///< an IPv6 address without its brackets
  std::uint16_t port = 0;  ///< 0: none
};

using WheelsDevice = std::variant<BusDevice, ReplayDevice>;
using KickerDevice = std::variant<BusDevice, ReplayDevice, IoBoardDevice, ReKickDevice>;
using RangeFinderDevice = std::variant<SimDevice, ScipDevice>;

/// The devices of a robot that plays.
struct Hal {
  WheelsDevice wheels;
  KickerDevice kicker;
  std::string replay_log;  ///< the match log that `replay` reads
};

/// The backend that `text` stands for, if it does.
template <class Backend>
std::optional<Backend> backend_of(std::string_view text) {
  return text == Backend::kName ? std::optional{Backend{}} : std::nullopt;
}
template <>
inline std::optional<BusDevice> backend_of(std::string_view text) {
  return text == BusDevice::kName || text == "sim" ? std::optional{BusDevice{}} : std::nullopt;
}
template <>
std::optional<ScipDevice> backend_of(std::string_view text);

/// Whether a node may wait for its samples in lockstep: a device of the real world has its own time.
template <class... Backends>
bool plays_in_lockstep(const std::variant<Backends...>& device) {
  return std::visit(
      []<class Backend>(const Backend&) {
        return requires { Backend::kInLockstep; };
      },
      device);
}

/// How a file writes it.
template <class Backend>
std::string text_of(const Backend&) {
  return std::string{Backend::kName};
}
inline std::string text_of(const ScipDevice& scanner) { return scanner.address; }
template <class... Backends>
std::string text_of(const std::variant<Backends...>& device) {
  return std::visit([](const auto& backend) { return text_of(backend); }, device);
}

}  // namespace trivela::config
