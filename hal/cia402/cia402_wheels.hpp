#pragma once

#include <memory>
#include <optional>
#include <string>

#include "config/devices.hpp"
#include "hal/cia402/drives.hpp"
#include "hal/line/line_thread.hpp"
#include "hal/wheels.hpp"

namespace trivela::hal::cia402 {

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
