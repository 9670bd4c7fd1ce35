#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/devices.hpp"
#include "hal/cia402/drive.hpp"
#include "hal/line/line.hpp"
#include "hal/line/line_thread.hpp"
#include "hal/wheels.hpp"
#include "kicking/model/omni_kinematics.hpp"

namespace trivela::hal::cia402 {

/// The drives of a base on their CAN bus, of which this is the master: a heartbeat every kHeartbeat_ns, and every cycle
/// SYNC and each drive's command, whose answers are one sample of SYNC's instant. The wheels turn while every drive is
/// in operation; if one is not, the others are told to stand, and a set-point from before counts no more when all are
/// again. The bus is opened again after a pause where it is lost.
///
/// Drives that are listened to hear SYNC alone: no heartbeat, which they would miss afterwards, no command and no stop.
class Drives final : public LineClient {
 public:
  static constexpr std::int64_t kHeartbeat_ns = 50'000'000;

  /// Throws std::runtime_error naming what does not go together: the number of drives and of wheels, nodes that are
  /// there twice.
  Drives(std::unique_ptr<Line> bus, const config::Cia402Device& settings, const kicking::WheelBase& base,
         WheelsUse use = WheelsUse::kDrive);

  void step(std::int64_t now_ns) override;
  std::int64_t next_ns() const override;
  int descriptor() const override { return bus_->descriptor(); }

  /// From the next cycle on, if the drives are up; one that is not finite is standstill.
  void drive(const kicking::Twist& set_point);

  /// One wheel's speed [rad/s], the others at rest; one that is not finite is 0.
  void drive_wheel(int wheel, double radps);

  /// Every drive is told a quick stop, and nothing is sent any more.
  void stop() noexcept;

  /// Every drive turns as it is told; of those that are listened to: has said its state.
  bool up() const;

  /// The newest sample that was not taken yet.
  std::optional<WheelSample> take_sample();

  /// Wheels::status().
  std::string status() const;

 private:
  void open(std::int64_t now_ns);
  void receive(std::int64_t now_ns);
  void take(const can::Frame& frame, std::int64_t now_ns);
  void finish_sample();
  void cycle(std::int64_t now_ns);
  void expect_answers(std::int64_t now_ns);
  bool running() const;
  std::vector<double> motor_rpm() const;
  void send(std::int64_t now_ns);
  void lose(const std::string& why, std::int64_t now_ns);

  std::unique_ptr<Line> bus_;
  config::Cia402Device settings_;
  kicking::OmniKinematics kinematics_;
  WheelsUse use_;
  std::vector<Drive> drives_;
  Drive::Frames out_;                    // to be sent
  std::array<double, 4> wheel_radps_{};  // asked for
  bool open_ = false;
  bool stopped_ = false;
  std::int64_t next_open_ns_ = 0;
  std::int64_t next_heartbeat_ns_ = 0;
  std::int64_t next_cycle_ns_ = 0;
  std::optional<std::int64_t> sync_ns_;  // its answers are not complete yet
  std::optional<WheelSample> sample_;
  std::string problem_;  // of the bus that is closed
  std::string note_;     // what the interface last said of itself
  std::int64_t note_ns_ = 0;
};

}  // namespace trivela::hal::cia402
