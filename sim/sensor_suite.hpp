#pragma once

#include <cstdint>
#include <deque>

#include "sim/random.hpp"
#include "sim/scenario.hpp"
#include "sim/sensors.hpp"
#include "sim/world.hpp"

namespace trivela::sim {

/// What wheels, gyro and cameras make of the world: noise, scale errors, latency and dropouts.
class SensorSuite {
 public:
  /// `scenario` must outlive the suite.
  explicit SensorSuite(const Scenario& scenario) : scenario_(scenario) {}

  /// A new opportunity: new scale errors and slow errors; what the cameras saw before is gone, because the robot was
  /// carried elsewhere.
  void begin(const Draws& draws);

  /// Remembers the world for exposures of the past; call after every sub-step.
  void remember(const World& world);

  /// One cycle has passed.
  void next_cycle();

  WheelSample wheels(const World& world) const;

  /// Exposed `latency_s` ago. Before begin() nothing was seen.
  VisionFrame vision(const World& world) const;
  FlightFrame flight(const World& world) const;

 private:
  struct Snapshot {
    std::int64_t t_ns;
    kicking::Pose pose;
    Vec3 ball;
    PlanPoint opponent;
  };

  /// The world at an instant, between the two snapshots around it.
  std::optional<Snapshot> at(std::int64_t t_ns) const;

  const Scenario& scenario_;
  Draws draws_{0, 0};
  std::uint32_t cycle_ = 0;
  std::deque<Snapshot> past_;
  kicking::Pose slow_error_;
};

}  // namespace trivela::sim
