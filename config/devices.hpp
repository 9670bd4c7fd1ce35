#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace trivela::hal {
class Kicker;
class Wheels;
struct Owner;
enum class WheelsUse;
}  // namespace trivela::hal

/// Devices as a file names them: a variant of backends, which hal/open.hpp opens by the functions that each declares as
/// its friends; their bodies stand with the backend. One with settings of its own lists them in `fields`; they stand in
/// the table that has its name, beside the device's key.
namespace trivela::config {

struct Hal;

/// Behind a bridge on the bus, of which the simulator is one (idl/README.md); once called sim.
struct BusDevice {
  static constexpr std::string_view kName = "bus";
  static constexpr bool kInLockstep = true;  ///< its samples may be of simulated time
  friend std::unique_ptr<hal::Kicker> kicker_of(const BusDevice&, const Hal&, const hal::Owner&);
  friend std::unique_ptr<hal::Wheels> wheels_of(const BusDevice&, const Hal&, const hal::Owner&, hal::WheelsUse);
};

/// The simulator's laser, over the bus.
struct SimDevice {
  static constexpr std::string_view kName = "sim";
  static constexpr bool kInLockstep = true;
};

/// The Falcons' ioBoard on a serial line (docs/devices/ioboard.md).
struct IoBoardDevice {
  static constexpr std::string_view kName = "ioboard";
  static constexpr std::string_view kUnarmed = "the in-play or the software-on switch is open";
  std::string port = "/dev/ttyUSB0";
  double pulse_us_per_power = 128.0;    ///< the coil's pulse for one unit of the table's set-points
  std::optional<std::uint8_t> lever{};  ///< height, 0 home to 205; none: the table's (Robot::lever), if it says one
  double charge_time_s = 3.0;           ///< from empty to full (assumed): the board does not say its charge
  std::vector<std::uint8_t> levers{};  ///< heights of all kinds of kick, by hal_for() from the robot's file; one: empty
  double lever_s = 0.0;                ///< how long the lever moves, from there too
  friend std::unique_ptr<hal::Kicker> kicker_of(const IoBoardDevice&, const Hal&, const hal::Owner&);
};

/// A ReKick board on a CAN bus (docs/devices/rekick.md).
struct ReKickDevice {
  static constexpr std::string_view kName = "rekick";
  static constexpr std::string_view kUnarmed = "the kicker's supply is off";
  std::string port = "can0";                ///< an interface, or the path of an emulator's socket
  double pulse_us_per_power = 100.0 / 3.0;  ///< of the coil: set-points in percent, as those of its public host
  std::uint16_t max_voltage_v = 330;        ///< that it charges to
  friend std::unique_ptr<hal::Kicker> kicker_of(const ReKickDevice&, const Hal&, const hal::Owner&);
};

/// A base whose drives follow CiA 402 on a CAN bus (docs/devices/cia402.md).
struct Cia402Device {
  static constexpr std::string_view kName = "cia402";
  std::string port = "can0";                       ///< an interface, or the path of an emulator's socket
  std::vector<std::uint8_t> nodes{1, 2, 3};        ///< of the drives, in the order of the robot's wheel_angles_rad
  std::vector<std::uint8_t> reversed{};            ///< those of them whose positive turns drive their wheel clockwise
  std::optional<double> gear{};                    ///< turns of the motor for one of the wheel; none: the drive's 6091
  std::optional<double> rpm_per_unit{};            ///< of the drive's velocity; none: the drive's 60A9, maxon's 1 rpm
  double max_motor_rpm = 10000.0;                  ///< a set-point beyond it is scaled down as a whole
  std::optional<std::uint32_t> ramp{};             ///< 6083 and 6084 in the drive's unit; none: as it is
  std::optional<std::uint32_t> quick_stop_ramp{};  ///< 6085, the same
  std::uint8_t master = 127;                       ///< the node number of this computer
  double heartbeat_s = 0.2;  ///< so long after our last heartbeat, or a drive's, its wheel is stopped
  double cycle_s = 0.01;     ///< of set-points and samples
  friend std::unique_ptr<hal::Wheels> wheels_of(const Cia402Device&, const Hal&, const hal::Owner&, hal::WheelsUse);
};

/// An Xsens MTi on a serial line, in place of the gyro of the wheels' device (docs/devices/mti.md).
struct MtiDevice {
  static constexpr std::string_view kName = "mti";
  std::string port = "/dev/ttyUSB1";
  bool upside_down = false;  ///< its z axis shows down
};

/// The turn rate that the wheels' device measures itself, if it does.
struct WheelsGyro {
  static constexpr std::string_view kName = "wheels";
  static constexpr bool kInLockstep = true;
};

/// A scanner that speaks SCIP, by its address.
struct ScipDevice {
  static constexpr std::string_view kName = "tcp://HOST:PORT (Hokuyo's port is 10940) or the path of a device";
  std::string address;     ///< as it was written; without a port the path of a serial device
  std::string host;        ///< an IPv6 address without its brackets
  std::uint16_t port = 0;  ///< 0: none
};

using WheelsDevice = std::variant<BusDevice, Cia402Device>;
using GyroDevice = std::variant<WheelsGyro, MtiDevice>;
using KickerDevice = std::variant<BusDevice, IoBoardDevice, ReKickDevice>;
using RangeFinderDevice = std::variant<SimDevice, ScipDevice>;

/// The devices of a robot that plays.
struct Hal {
  WheelsDevice wheels;
  KickerDevice kicker;
  GyroDevice gyro{};
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

/// What stands in the way of firing where the backend says that it is not armed.
inline std::string_view unarmed_by(const KickerDevice& device) {
  return std::visit(
      []<class Backend>(const Backend&) -> std::string_view {
        if constexpr (requires { Backend::kUnarmed; }) return Backend::kUnarmed;
        return "the arm switch is open";
      },
      device);
}

/// From empty to full, of a board whose charge is modelled from its opening on; 0: it is measured.
inline double modelled_charge_s(const KickerDevice& device) {
  return std::visit(
      [](const auto& backend) {
        if constexpr (requires { backend.charge_time_s; }) return backend.charge_time_s;
        return 0.0;
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
