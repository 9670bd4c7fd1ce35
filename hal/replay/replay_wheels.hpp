#pragma once

#include <vector>

#include "hal/replay/row_pages.hpp"
#include "hal/wheels.hpp"
#include "idl/robot.hpp"

namespace trivela::hal {

/// The wheel samples of a match log (table odometry), as fast as they are read. Nothing moves.
class ReplayWheels final : public Wheels {
 public:
  explicit ReplayWheels(const ReplayLog& log) : samples_(log) {}

  bool connected(std::chrono::nanoseconds) override { return true; }

  /// Never waits. A row without any wheel, which no base sends, ends the replay as a std::runtime_error.
  std::optional<WheelSample> read(std::chrono::nanoseconds timeout) override;
  void drive(const kicking::Twist& set_point, std::int64_t t_ns) override;
  bool ended() const override { return samples_.peek() == nullptr; }

  struct Drive {
    std::int64_t t_ns;
    kicking::Twist set_point;
  };
  /// What was asked of the base so far. For the thread that calls drive().
  const std::vector<Drive>& drives() const { return drives_; }

 private:
  RowPages<msg::Odometry> samples_;
  std::vector<Drive> drives_;
};

}  // namespace trivela::hal
