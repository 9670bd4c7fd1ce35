#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "kicking/geometry/frames.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::hal {

/// One reading of wheels and gyro.
struct WheelSample {
  std::int64_t t_ns = 0;                ///< of the sample on the steady clock, as in hal/kicker.hpp
  int wheel_count = 0;                  ///< entries of wheel_radps that count, 3 or 4
  std::array<double, 4> wheel_radps{};  ///< counter-clockwise about the robot's centre is positive
  kicking::OptionalDouble gyro_radps;   ///< counter-clockwise
  bool emulated = false;                ///< the base is a program
  bool gyro_emulated = false;           ///< gyro_radps is a program's
};

/// What a base is opened for.
enum class WheelsUse {
  kDrive,
  kListen  ///< samples and status alone: motors stay without power, faults as they are, and commands do nothing
};

/// The base: wheel speeds in, set-points out. read() is for one thread at a time, the commands for another.
class Wheels {
 public:
  /// Leaves the base at a set-point of zero.
  virtual ~Wheels() = default;

  /// The device is there: samples can come and commands leave. Waits for it up to `timeout`.
  [[nodiscard]] virtual bool connected(std::chrono::nanoseconds timeout) = 0;

  /// The next sample, in time order; waits for it up to `timeout`. None: no sample yet.
  virtual std::optional<WheelSample> read(std::chrono::nanoseconds timeout) = 0;

  /// Asks for a velocity in R; a backend without motors records it. `t_ns` is the instant it answers. A set-point that
  /// is not finite is one of zero.
  virtual void drive(const kicking::Twist& set_point, std::int64_t t_ns) = 0;

  /// Asks one wheel, counted from 0, for a speed and the others for rest, as drive() does for the base. False: this
  /// device takes velocities of the base alone, and was told nothing.
  virtual bool drive_wheel(int /*wheel*/, double /*radps*/, std::int64_t /*t_ns*/) { return false; }

  /// One line on the state of the link and of the motors, for a human; empty: nothing to say.
  virtual std::string status() const { return {}; }
};

}  // namespace trivela::hal
