#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "kicking/geometry/time.hpp"
#include "sim/shot.hpp"

namespace trivela::robot {

inline constexpr std::int64_t kFrame_ns = 20'000'000;

/// A kick of the simulated world, as it leaves the robot.
struct Kick {
  Eigen::Vector3d from_m{0.0, 4.0, 0.11};
  Eigen::Vector3d velocity_mps{0.0, 0.0, 0.0};
  bool rolling = false;
  sim::PlanPoint opponent{50.0, 50.0};
};

/// A kick without drag that comes to `x_cross_m`, `z_cross_m` at the goal line after `flight_s`.
inline Kick aimed(double x_cross_m, double z_cross_m, double flight_s = 0.8) {
  Kick kick;
  kick.velocity_mps = {(x_cross_m - kick.from_m.x()) / flight_s, (9.0 - kick.from_m.y()) / flight_s,
                       (z_cross_m - kick.from_m.z()) / flight_s + 9.81 * flight_s / 2.0};
  return kick;
}

/// What the flight camera saw of it, and what really happened.
struct FlownShot {
  struct Frame {
    std::int64_t t_ns;
    std::optional<Eigen::Vector3d> ball_m;
  };
  std::vector<Frame> frames;
  std::int64_t release_t_ns = 0;
  double expected_speed_mps = 0.0;
  sim::ShotResult truth;
  std::int64_t play_ends_t_ns = 0;  // the referee stops the game
};

/// Flies the kick. The ball rests before the robot for 0.2 s, is released between two frames, and is watched until
/// 0.2 s after its fate is settled and then `watch_on_s` longer. Noise and dropouts as the default flight camera has
/// them, unless sd_m is 0.
inline FlownShot fly(const Kick& kick, const sim::Scenario& scenario, unsigned seed = 1, double watch_on_s = 0.0) {
  constexpr std::int64_t kSubstep_ns = 4'000'000;
  const sim::FlightCamera& camera = scenario.flight_camera;
  std::mt19937_64 random{seed};
  std::normal_distribution<double> noise{0.0, 1.0};
  std::uniform_real_distribution<double> share{0.0, 1.0};
  FlownShot flown;
  flown.release_t_ns = 10 * kFrame_ns + 2 * kSubstep_ns;
  flown.expected_speed_mps = std::hypot(kick.velocity_mps.x(), kick.velocity_mps.y());
  std::optional<sim::Shot> shot;
  const double opponent_x = kick.opponent.x_m - kick.from_m.x(), opponent_y = kick.opponent.y_m - kick.from_m.y();
  std::array<sim::OpponentBody, 1> opponents;
  opponents[0].place(kick.from_m, {std::hypot(opponent_x, opponent_y), std::atan2(-opponent_x, opponent_y), 0.0});
  std::int64_t end_ns = 4'000'000'000;
  const auto tail_ns = kicking::nanoseconds(scenario.possession.after_crossing_s + watch_on_s);
  for (std::int64_t t_ns = 0; t_ns <= end_ns; t_ns += kSubstep_ns) {
    if (t_ns == flown.release_t_ns)
      shot.emplace(scenario, sim::BallMotion{{kick.from_m, kick.velocity_mps}, kick.rolling}, t_ns);
    if (shot && t_ns > flown.release_t_ns) shot->advance_to(t_ns, opponents);
    if (shot && shot->result() && flown.truth.t_ns == 0) {
      flown.truth = *shot->result();
      end_ns = flown.truth.t_ns + tail_ns;
      flown.play_ends_t_ns = flown.truth.t_ns + tail_ns;
    }
    if (t_ns % kFrame_ns != 0) continue;
    const Eigen::Vector3d& ball = shot ? shot->ball().position_m : kick.from_m;
    const Eigen::Vector3d seen =
        ball + camera.position_sd_m * Eigen::Vector3d{noise(random), noise(random), noise(random)};
    flown.frames.push_back({t_ns, share(random) < camera.dropout_ratio ? std::nullopt : std::optional{seen}});
  }
  return flown;
}

/// The default world without air, and one whose camera is perfect.
inline sim::Scenario airless() {
  sim::Scenario scenario;
  scenario.ball.drag_coefficient = 0.0;
  return scenario;
}

}  // namespace trivela::robot
