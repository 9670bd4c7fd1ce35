#pragma once

#include <spdlog/logger.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "bus/stop.hpp"
#include "config/settings.hpp"
#include "emulators/board/emulated_kicker.hpp"
#include "emulators/cia402/emulated_wheels.hpp"
#include "emulators/mti/emulated_mti.hpp"
#include "emulators/refbox/emulated_box.hpp"
#include "emulators/refbox/referee_output.hpp"
#include "sim/sensors.hpp"

namespace trivela::nodes {

/// What the nodes of a robot meet in place of the simulator's topics where simulator.devices = "emulated": the board
/// that hal.kicker names, the drives that hal.wheels names and the gyro that hal.gyro names, at their ends of their
/// lines, and a referee box on a TCP port. Each pulse and each word of the box is logged at level info with its
/// instant.
class EmulatedDevices {
 public:
  /// Throws std::runtime_error where the settings have no such devices, naming the key, and where the system refuses.
  EmulatedDevices(const config::Settings& settings, const kicking::WheelBase& base,
                  std::shared_ptr<spdlog::logger> logger);

  /// Settings by which the nodes find them, as --set takes them.
  std::vector<std::string> settings() const;

  /// Waits until the driver asks the board, odometry has the drives in operation and the node refbox has come. False:
  /// the stop was requested first. Throws std::runtime_error naming who is missing when it does not come.
  [[nodiscard]] bool wait_for_nodes(const bus::Stop& stop);

  /// The kicker has a board: it is not on the bus.
  bool has_board() const { return kicker_ != nullptr; }

  /// The base has drives: its wheels are not on the bus.
  bool has_drives() const { return base_ != nullptr; }

  /// What the world has come to: the drives measure its wheels, the gyro its turn rate, the
  /// board stands so, and the box says what is new.
  void show(const sim::Sensors& sensors);

  /// What the drives are told; only where there are any.
  kicking::Twist set_point() { return base_->set_point(); }

  /// Kind of kick for which the board's lever was told to stand.
  std::uint8_t lever_kind() { return kicker_ ? kicker_->lever_kind() : std::uint8_t{0}; }

  /// The board's pulses since the last call.
  std::vector<hal::CoilPulse> take_pulses();

  /// The match is over.
  void say_over();

 private:
  void say(const std::vector<hal::refbox::BoxCommand>& words);

  std::shared_ptr<spdlog::logger> logger_;
  std::unique_ptr<hal::EmulatedKicker> kicker_;  // none: on the bus
  std::unique_ptr<hal::EmulatedWheels> base_;    // none: on the bus
  std::unique_ptr<hal::EmulatedGyro> gyro_;      // none: the wheels' own
  hal::refbox::EmulatedBox box_;
  hal::refbox::RefereeOutput referee_output_;
};

}  // namespace trivela::nodes
