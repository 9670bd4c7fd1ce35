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

/// A base of CiA 402 drives, spoken to by a thread of its own with the priority of whoever makes it. A set-point goes
/// out with the next cycle, whatever instant it is of, and again with each that follows. read() gives the newest
/// sample.
class Cia402Wheels final : public Wheels {
 public:
  /// Starts the thread. Throws as Drives and as LineThread.
  Cia402Wheels(std::unique_ptr<Line> bus, const config::Cia402Device& settings, const kicking::WheelBase& base,
               WheelsUse use = WheelsUse::kDrive)
      : drives_(std::move(bus), settings, base, use), thread_(drives_, "wheels") {}
  ~Cia402Wheels() override {
    thread_.with_client([this] { drives_.stop(); });
  }
  Cia402Wheels(const Cia402Wheels&) = delete;
  Cia402Wheels& operator=(const Cia402Wheels&) = delete;

  /// Every drive is in operation; of those that are listened to: says its state.
  bool connected(std::chrono::nanoseconds timeout) override {
    return thread_.wait(timeout, [this] { return drives_.up(); });
  }
  std::optional<WheelSample> read(std::chrono::nanoseconds timeout) override {
    std::optional<WheelSample> sample;
    thread_.wait(timeout, [&] { return (sample = drives_.take_sample()).has_value(); });
    return sample;
  }
  void drive(const kicking::Twist& set_point, std::int64_t /*t_ns*/) override {
    thread_.with_client([&] { drives_.drive(set_point); });
  }
  bool drive_wheel(int wheel, double radps, std::int64_t /*t_ns*/) override {
    thread_.with_client([&] { drives_.drive_wheel(wheel, radps); });
    return true;
  }
  std::string status() const override {
    return thread_.with_client([this] { return drives_.status(); });
  }

 private:
  Drives drives_;
  LineThread thread_;
};

}  // namespace trivela::hal::cia402
