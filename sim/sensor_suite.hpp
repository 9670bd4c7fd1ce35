#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kicking/random/draws.hpp"
#include "sim/scenario.hpp"
#include "sim/sensors.hpp"
#include "sim/world.hpp"

namespace trivela::sim {

/// What wheels, gyro and cameras make of the world: noise, scale errors, latency and dropouts.
class SensorSuite {
 public:
  /// `scenario` must outlive the suite.
  explicit SensorSuite(const Scenario& scenario);

  /// A new opportunity: new scale errors and slow errors; what the cameras saw before is gone, because the robot was
  /// carried elsewhere.
  void begin(const kicking::Draws& draws);

  /// Remembers the world for exposures of the past; call after every sub-step.
  void remember(const World& world);

  /// One cycle has passed.
  void next_cycle();

  WheelSample wheels(const World& world) const;

  /// Exposed `latency_s` ago; of the flight camera the last exposure until then, none where the cycle before has shown
  /// it. Before begin() nothing was seen. What is not asked for costs nothing and changes nothing.
  VisionFrame vision(const World& world) const;
  FlightFrame flight(const World& world) const;

 private:
  struct Snapshot {
    std::int64_t t_ns = 0;
    kicking::Pose pose;
    PlanVector axis;
    Eigen::Vector3d ball{0.0, 0.0, 0.0};
    PlanPoint opponent;
    std::array<PlanPoint, kMostFurther> further{};  // of as many as the world has
    std::optional<PlanPoint> jumping_keeper{};
  };

  /// One wheel of the base: what it turns at a unit of each velocity [1/m, 1/m, 1].
  struct WheelRow {
    double vx, vy, omega;
  };

  /// The world at an instant, between the two snapshots around it; nullptr: not within them. Until the next call.
  const Snapshot* at(std::int64_t t_ns) const;
  static Snapshot between(const Snapshot& a, const Snapshot& b, std::int64_t t_ns);

  void see_further(const Snapshot& seen, VisionFrame& frame) const;
  std::optional<PlanPoint> keeper(const Snapshot& seen, double luck) const;

  /// The camera's slow error of this cycle.
  const kicking::Pose& slow_error() const;

  const Scenario& scenario_;
  const std::int64_t vision_latency_ns_;
  const std::int64_t flight_latency_ns_;
  const std::int64_t flight_period_ns_;
  const std::int64_t cycle_ns_;
  const double slow_keep_, slow_fresh_;  // what of the slow error stays from cycle to cycle, and what comes again
  std::vector<WheelRow> wheels_;

  kicking::Draws draws_{0, 0};
  std::uint32_t cycle_ = 0;
  std::array<double, 4> wheel_scale_{};  // of this opportunity
  double gyro_bias_radps_ = 0.0;

  std::vector<Snapshot> past_;  // a ring
  std::size_t newest_ = 0;
  std::size_t kept_ = 0;
  std::size_t further_count_ = 0;  // opponents beside the nearest, and defenders

  mutable Snapshot between_;          // of the last at()
  mutable kicking::Pose slow_error_;  // a function of draws_ and slow_cycle_, carried on when a frame is asked for
  mutable std::uint32_t slow_cycle_ = 0;
};

}  // namespace trivela::sim
