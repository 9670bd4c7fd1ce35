#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "kicking/geometry/time.hpp"

namespace trivela::hal::cia402 {

/// The shaft of an emulated drive: from one speed to another along a ramp.
class Motor {
 public:
  /// From now_ns on towards target_rpm, by at most ramp_rpmps [rpm/s].
  void turn(double target_rpm, double ramp_rpmps, std::int64_t now_ns) {
    if (target_rpm == target_rpm_ && ramp_rpmps == ramp_rpmps_) return;
    start_rpm_ = rpm(now_ns);
    start_ns_ = now_ns;
    target_rpm_ = target_rpm;
    ramp_rpmps_ = ramp_rpmps;
  }
  double rpm(std::int64_t now_ns) const {
    const double change_rpm = ramp_rpmps_ * std::max(0.0, kicking::seconds(start_ns_, now_ns));
    return start_rpm_ + std::clamp(target_rpm_ - start_rpm_, -change_rpm, change_rpm);
  }
  /// When it has come, or will come to rest; none: it is to turn.
  std::optional<std::int64_t> rest_ns() const {
    if (target_rpm_ != 0.0) return std::nullopt;
    return start_ns_ + kicking::nanoseconds(start_rpm_ == 0.0 ? 0.0 : std::abs(start_rpm_) / ramp_rpmps_);
  }

 private:
  double start_rpm_ = 0.0;
  std::int64_t start_ns_ = 0;
  double target_rpm_ = 0.0;
  double ramp_rpmps_ = 1.0;
};

}  // namespace trivela::hal::cia402
