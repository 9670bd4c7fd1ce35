#include "cli/calibrate/drive_needs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "bus/reader.hpp"
#include "idl/messages.hpp"

namespace trivela::cli {
namespace {

constexpr std::chrono::seconds kTimeout{2};  // in which a writer that runs is known, on a busy machine too

/// What lacks, by looking for the writers of a topic each, all within the same two seconds.
class Lacking {
 public:
  explicit Lacking(const bus::Participant& participant) : participant_(participant) {}

  template <class T>
  void unless_written(const char* topic, const char* advice) {
    bus::ReaderOptions looks_on;
    looks_on.observer = true;
    bus::Reader<T> reader{participant_, looks_on};
    const auto left = std::max<std::chrono::nanoseconds>(until_ - std::chrono::steady_clock::now(), kShortest);
    if (!reader.wait_for_writers(1, left)) what_.push_back(fmt::format("nobody writes {}: {}", topic, advice));
  }

  const std::vector<std::string>& what() const { return what_; }

 private:
  static constexpr std::chrono::milliseconds kShortest{100};  // whoever runs is known to the participant by now

  const bus::Participant& participant_;
  const std::chrono::steady_clock::time_point until_ = std::chrono::steady_clock::now() + kTimeout;
  std::vector<std::string> what_;
};

}  // namespace

void require_for_drive(const bus::Participant& participant, const config::Settings& settings,
                       const calibration::DrivePlan& plan) {
  Lacking lacking{participant};
  lacking.unless_written<msg::VisionFrame>("vision", "start your vision, or examples/vision");
  lacking.unless_written<msg::FlightFrame>("flight_camera", "start what follows the ball in flight");
  if (std::holds_alternative<config::BusDevice>(settings.hal.wheels))
    lacking.unless_written<msg::DeviceWheels>("device/wheels", "start the robot's bridge, or set hal.wheels");
  if (std::holds_alternative<config::BusDevice>(settings.hal.kicker))
    lacking.unless_written<msg::DeviceKicker>("device/kicker", "start the robot's bridge, or set hal.kicker");
  if (plan.laser && std::holds_alternative<config::SimDevice>(settings.scan_recorder.device))
    lacking.unless_written<msg::SimScan>(
        "sim/scan",
        "this drive is measured by the scanner: set scan_recorder.device, tcp://HOST:PORT or a serial device");
  if (lacking.what().empty()) return;
  throw std::runtime_error{fmt::format("{} cannot be played: {}", plan.name, fmt::join(lacking.what(), "; "))};
}

}  // namespace trivela::cli
