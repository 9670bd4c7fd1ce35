#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "config/robot.hpp"
#include "experiment/calibration/simulated_calibration.hpp"
#include "experiment/play/play_match.hpp"
#include "experiment/run/in_threads.hpp"
#include "sim/scenario.hpp"

namespace trivela::bench {

/// A world that differs from default.toml in what nobody knows of the next one, and a robot that was calibrated in it.
struct DrawnWorld {
  sim::Scenario scenario;
  std::vector<config::Robot> robots;
};

inline sim::Scenario draw_scenario(std::uint64_t seed, std::size_t number) {
  std::mt19937_64 random{seed * 1'000'003 + number};
  const auto between = [&](double least, double most) {
    return least + (most - least) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  const auto one_in = [&](double share) { return between(0.0, 1.0) < share; };
  sim::Scenario s;
  s.robot.max_speed_mps = between(1.5, 2.5);
  s.robot.max_acceleration_mps2 = between(1.2, 3.5);
  s.robot.max_turn_rate_radps = between(2.2, 3.0);
  s.robot.max_turn_acceleration_radps2 = between(3.2, 5.0);
  s.possession.speed_max_mps = between(0.8, std::min(2.0, s.robot.max_speed_mps));
  s.possession.aim_error_sd_rad = between(0.9, 1.7);
  s.possession.lateral_max_m = between(2.0, 4.0);
  s.opponent.count = std::floor(between(1.0, 4.0));
  s.opponent.distance_median_m = between(1.1, 2.5);
  s.opponent.distance_sigma_ln = between(0.35, 0.7);
  s.opponent.closing_min_mps = between(0.2, 1.0);
  s.opponent.closing_max_mps = between(1.2, 2.4);
  s.kicker.delay_s = between(0.04, 0.09);
  s.kicker.delay_sd_s = between(0.005, 0.02);
  s.kicker.speed_sd_ratio = between(0.01, 0.035);
  s.kicker.direction_sd_rad = between(0.015, 0.04);
  s.kicker.drift_sd_ratio = between(0.005, 0.03);
  s.vision.latency_s = between(0.03, 0.09);
  s.vision.position_slow_sd_m = between(0.05, 0.16);
  s.vision.heading_slow_sd_rad = between(0.004, 0.016);
  s.vision.opponent_sd_m = between(0.08, 0.2);
  s.referee.stops_per_min = between(0.2, 2.0);
  if (one_in(0.5)) {
    s.keeper.enabled = true;
    s.keeper.guard.reaction_s = between(0.15, 0.4);
    s.keeper.guard.speed_mps = between(1.5, 2.5);
    s.keeper.guard.acceleration_mps2 = between(3.0, 6.0);
    if (one_in(0.5)) {
      s.kicker.flat.enabled = true;
      s.ball.sliding_friction_ratio = between(0.2, 0.4);
      for (double& speed_mps : s.kicker.flat.exit_speeds_mps) speed_mps *= s.keeper.guard.speed_mps / 2.0;
    }
  }
  return s;
}

/// A world whose calibration fails is left out.
inline std::vector<DrawnWorld> draw_worlds(std::uint64_t seed, std::uint32_t count, unsigned jobs) {
  std::vector<std::optional<DrawnWorld>> drawn(count);
  experiment::in_threads(count, jobs, [&](std::size_t i) {
    DrawnWorld world{draw_scenario(seed, i), {}};
    try {
      world.robots = {
          experiment::calibrated_robot(world.scenario, static_cast<std::int64_t>((seed * 977 + i) % 1'000'000))};
      drawn[i] = std::move(world);
    } catch (const std::exception&) {
    }
  });
  std::vector<DrawnWorld> worlds;
  for (auto& world : drawn)
    if (world) worlds.push_back(std::move(*world));
  return worlds;
}

/// Rewards a match, by decision: shares of the opportunities that the observer calls on target, true goals where there
/// is a keeper. None: `predictive`. All decisions meet the same opportunities.
inline std::vector<std::vector<double>> play_worlds(
    const std::vector<DrawnWorld>& worlds, const std::vector<std::optional<kicking::LearnedDecision>>& decisions,
    std::uint64_t seed, std::uint32_t first, std::uint32_t matches, std::uint32_t possessions, unsigned jobs) {
  std::vector<std::vector<double>> rewards(decisions.size(), std::vector<double>(worlds.size() * matches));
  experiment::in_threads(decisions.size() * worlds.size(), jobs, [&](std::size_t i) {
    const std::size_t d = i % decisions.size(), w = i / decisions.size();
    const DrawnWorld& world = worlds[w];
    experiment::Arm arm;
    arm.policy = kicking::PolicyName::kPredictive;
    if (decisions[d]) {
      arm.policy = kicking::PolicyName::kLearned;
      arm.settings.policy.learned.emplace().decision = *decisions[d];
    }
    arm.robots = world.robots;
    for (std::uint32_t m = 0; m < matches; ++m) {
      const auto match_id = static_cast<std::uint32_t>((first + m) * worlds.size() + w);
      double won = 0.0;
      for (const auto& possession :
           experiment::play_match(world.scenario, arm, seed, match_id, possessions).possessions) {
        if (!possession.kick) continue;
        const auto& kick = *possession.kick;
        won += world.scenario.keeper.enabled ? kick.truth == kicking::Outcome::kOnTarget && !kick.truth_saved
                                             : kick.observed == kicking::Outcome::kOnTarget;
      }
      rewards[d][w * matches + m] = won / possessions;
    }
  });
  return rewards;
}

inline double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Mean of a - b, and half the width of its 95 % interval, by match.
struct Difference {
  double mean = 0.0, reach = 0.0;
};

inline Difference difference_of(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) d[i] = a[i] - b[i];
  Difference out{mean_of(d), 0.0};
  double squares = 0.0;
  for (const double one : d) squares += (one - out.mean) * (one - out.mean);
  out.reach = 1.96 * std::sqrt(squares / static_cast<double>(d.size() * (d.size() - 1)));
  return out;
}

}  // namespace trivela::bench
