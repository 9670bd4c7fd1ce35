#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "hal/wheels.hpp"

namespace trivela::hal {

/// One reading of a gyro.
struct GyroSample {
  std::int64_t t_ns = 0;    ///< of the sample on the steady clock, as in hal/kicker.hpp
  double gyro_radps = 0.0;  ///< counter-clockwise
};

/// A gyro that is a device of its own. For any thread.
class Gyro {
 public:
  virtual ~Gyro() = default;

  /// The newest sample, however old; none: there was none yet.
  virtual std::optional<GyroSample> newest() const = 0;

  /// One line on the state of the link, for a human; empty: nothing to say.
  virtual std::string status() const = 0;
};

/// Wheels of one device, and the gyro of another: their samples carry its newest where it is of about the same instant,
/// else none. Wheels go on without it.
class GyroWheels final : public Wheels {
 public:
  static constexpr std::int64_t kSameInstant_ns = 50'000'000;

  /// `emulated`: the gyro is a program.
  GyroWheels(std::unique_ptr<Wheels> wheels, std::unique_ptr<Gyro> gyro, bool emulated = false)
      : wheels_(std::move(wheels)), gyro_(std::move(gyro)), emulated_(emulated) {}

  bool connected(std::chrono::nanoseconds timeout) override { return wheels_->connected(timeout); }
  std::optional<WheelSample> read(std::chrono::nanoseconds timeout) override;
  void drive(const kicking::Twist& set_point, std::int64_t t_ns) override { wheels_->drive(set_point, t_ns); }
  bool drive_wheel(int wheel, double radps, std::int64_t t_ns) override {
    return wheels_->drive_wheel(wheel, radps, t_ns);
  }
  std::string status() const override;

 private:
  std::unique_ptr<Wheels> wheels_;
  std::unique_ptr<Gyro> gyro_;
  bool emulated_;
};

}  // namespace trivela::hal
