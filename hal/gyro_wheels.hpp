#pragma once

#include <memory>
#include <utility>

#include "hal/gyro.hpp"
#include "hal/wheels.hpp"

namespace trivela::hal {

/// Wheels of one device, and the gyro of another: their samples carry its newest where it is of about the same instant,
/// else none. Wheels go on without it.
class GyroWheels final : public Wheels {
 public:
  static constexpr std::int64_t kSameInstant_ns = 50'000'000;

  GyroWheels(std::unique_ptr<Wheels> wheels, std::unique_ptr<Gyro> gyro)
      : wheels_(std::move(wheels)), gyro_(std::move(gyro)) {}

  bool connected(std::chrono::nanoseconds timeout) override { return wheels_->connected(timeout); }
  std::optional<WheelSample> read(std::chrono::nanoseconds timeout) override;
  void drive(const kicking::Twist& set_point, std::int64_t t_ns) override { wheels_->drive(set_point, t_ns); }
  bool ended() const override { return wheels_->ended(); }
  std::string status() const override;

 private:
  std::unique_ptr<Wheels> wheels_;
  std::unique_ptr<Gyro> gyro_;
};

}  // namespace trivela::hal
