#include "sim/kicker/hand_table.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "kicking/ballistics/flight.hpp"
#include "kicking/random/draws.hpp"
#include "sim/kicker/flight.hpp"
#include "sim/kicker/kicker.hpp"

namespace trivela::sim {
namespace {

constexpr int kDegree = 2;
constexpr std::uint32_t kMostTries = 100;
constexpr double kLeastRise = 0.1;  // of the power from one distance to the next; less is not rising

/// Power at which the ball passes `height_m` over the launch at `distance_m`, fractional; none: out of reach.
/// The exit elevation hardly depends on the power: a few rounds are enough.
std::optional<double> power_through(const Kicker& kicker, const BallPhysics& ball, double distance_m, double height_m,
                                    double speed_ratio) {
  double power = 0.5 * (kicker.powers.front() + kicker.powers.back());
  for (int i = 0; i < 3; ++i) {
    const auto speed_mps = kicking::crossing_speed_with_drag(
        {distance_m, height_m}, exit_at(kicker, power).elevation_rad, drag_per_m(ball), ball.gravity_mps2);
    if (!speed_mps) return std::nullopt;
    const double at_table_mps = *speed_mps / (kicker.speed_scale_ratio * speed_ratio);
    const auto& speeds = kicker.exit_speeds_mps;
    if (at_table_mps > speeds.back()) return std::nullopt;
    const auto above = std::ranges::upper_bound(speeds, std::max(at_table_mps, speeds.front()));
    const auto high = std::clamp<std::size_t>(static_cast<std::size_t>(above - speeds.begin()), 1, speeds.size() - 1);
    const double part = std::max(0.0, at_table_mps - speeds[high - 1]) / (speeds[high] - speeds[high - 1]);
    power = std::lerp(kicker.powers[high - 1], kicker.powers[high], part);
  }
  return power;
}

/// The polynomial of least squares through the points, at their distances.
std::vector<double> smoothed(const std::vector<kicking::DistancePoint>& points) {
  const auto rows = static_cast<Eigen::Index>(points.size());
  const Eigen::Index columns = std::min<Eigen::Index>(kDegree + 1, rows);
  Eigen::MatrixXd design(rows, columns);
  Eigen::VectorXd powers(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto& point = points[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < columns; ++j) design(i, j) = std::pow(point.distance_m, static_cast<double>(j));
    powers(i) = point.power;
  }
  const Eigen::VectorXd fitted = design * design.colPivHouseholderQr().solve(powers);
  return {fitted.begin(), fitted.end()};
}

/// A table, or why nobody could play by it.
using Made = std::variant<kicking::DistanceTable, std::string>;

/// The table of one try; every try has numbers of its own.
Made make_table(const Scenario& scenario, const Kicker& kicker, const kicking::Draws& draws, std::uint32_t robot,
                std::uint32_t tried) {
  const HandTable& hand = scenario.hand_table;
  const auto first = tried * (1 + static_cast<std::uint32_t>(hand.distances_m.size()));
  const auto common = draws.normals(kicking::Role::kHandTable, robot, first);
  const double day_ratio = 1.0 + hand.day_sd_ratio * common[0];
  // A ball taken for higher than it flies is sent lower.
  const double launch_to_target_m = hand.target_height_m - scenario.ball.radius_m - hand.eye_bias_sd_m * common[1];
  std::vector<kicking::DistancePoint> noted;
  for (std::size_t i = 0; i < hand.distances_m.size(); ++i) {
    const auto noise = draws.normals(kicking::Role::kHandTable, robot, first + 1 + static_cast<std::uint32_t>(i));
    const double mean_ratio = 1.0 + kicker.speed_sd_ratio * noise[1] / std::sqrt(hand.kicks_per_distance);
    const double height_m = launch_to_target_m - hand.eye_height_sd_m * noise[0];
    const auto power =
        power_through(kicker, scenario.ball, hand.distances_m[i], height_m, day_ratio * std::max(0.5, mean_ratio));
    if (power) noted.push_back({hand.distances_m[i], std::round(*power)});
  }
  if (noted.size() < 2) {
    return fmt::format("{} of {} distances are within the kicker's reach, need 2", noted.size(),
                       hand.distances_m.size());
  }
  const std::vector<double> powers = smoothed(noted);
  kicking::DistanceTable table;
  for (std::size_t i = 0; i < noted.size(); ++i) {
    const double power = std::clamp(powers[i], kicker.powers.front(), kicker.powers.back());
    if (!table.points.empty() && power < table.points.back().power + kLeastRise) continue;
    table.points.push_back({noted[i].distance_m, power});
  }
  if (table.points.size() < 2) return "the powers found do not rise with the distance";
  return table;
}

}  // namespace

kicking::DistanceTable draw_hand_table(const Scenario& scenario, const Kicker& kicker, std::uint64_t seed,
                                       std::uint32_t match, std::uint32_t robot) {
  std::string why;
  for (std::uint32_t tried = 0; tried < kMostTries; ++tried) {
    Made made = make_table(scenario, kicker, kicking::Draws{seed, match}, robot, tried);
    if (auto* const table = std::get_if<kicking::DistanceTable>(&made)) return std::move(*table);
    why = std::get<std::string>(made);
  }
  throw std::runtime_error{fmt::format("hand_table: none of {} tables of match {} can be played by; the last one: {}",
                                       kMostTries, match, why)};
}

}  // namespace trivela::sim
