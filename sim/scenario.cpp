#include <fmt/core.h>

#include <cmath>
#include <string_view>

#include "kicking/geometry/angle.hpp"
#include "sim/scenario_fields.hpp"

namespace trivela::sim {
namespace {

/// Visits the fields and keeps the first value outside its range.
struct RangeCheck {
  std::string section;
  std::optional<Problem> problem;

  void operator()(std::string_view key, double& value, Range range) {
    if (problem || range.contains(value)) return;
    problem = Problem{section + std::string{key}, fmt::format("{} is outside {}..{}", value, range.min, range.max)};
  }
  void operator()(std::string_view key, Degrees angle, Range range) {
    double angle_deg = kicking::degrees(angle.rad);
    (*this)(key, angle_deg, range);
  }
  void operator()(std::string_view key, std::vector<double>& values, Range range) {
    for (double& value : values) (*this)(key, value, range);
  }
  void operator()(std::string_view, bool&) {}
  template <class T>
  void operator()(std::string_view key, T& nested) {
    const std::string outer = section;
    section += std::string{key} + '.';
    fields(*this, nested);
    section = outer;
  }
};

std::optional<Problem> ordered(const char* key, double low, double high) {
  if (low <= high) return std::nullopt;
  return Problem{key, fmt::format("the minimum {} is above the maximum {}", low, high)};
}

std::optional<Problem> whole(const char* key, double count) {
  if (count == std::floor(count)) return std::nullopt;
  return Problem{key, fmt::format("{} is no whole number", count)};
}

std::optional<Problem> team_problem(const Team& team) {
  if (auto problem = whole("team.robots", team.robots)) return problem;
  const auto& ratios = team.speed_scale_ratios;
  if (ratios.empty() || ratios.size() == static_cast<std::size_t>(team.robots)) return std::nullopt;
  return Problem{"team.speed_scale_ratios", fmt::format("{} values for {} robots", ratios.size(), team.robots)};
}

/// Of Kicker or FlatKick, whose keys begin with `section`.
template <class Table>
std::optional<Problem> table_problem(const Table& k, const std::string& section) {
  if (k.powers.size() < 2) return Problem{section + "powers", "fewer than two set-points"};
  for (std::size_t i = 1; i < k.powers.size(); ++i) {
    if (!(k.powers[i] > k.powers[i - 1])) {
      return Problem{section + "powers", fmt::format("{} does not rise above {}", k.powers[i], k.powers[i - 1])};
    }
  }
  const auto of_length = [&](const char* key, std::size_t size) -> std::optional<Problem> {
    if (size == k.powers.size()) return std::nullopt;
    return Problem{section + key, fmt::format("{} values for {} powers", size, k.powers.size())};
  };
  if (auto problem = of_length("exit_speeds_mps", k.exit_speeds_mps.size())) return problem;
  return of_length("exit_elevations_rad", k.exit_elevations_rad.size());
}

}  // namespace

std::optional<Problem> first_problem(const Scenario& scenario) {
  Scenario copy = scenario;
  RangeCheck check;
  fields(check, copy);
  if (check.problem) return check.problem;
  if (auto problem = table_problem(scenario.kicker, "kicker.")) return problem;
  if (auto problem = table_problem(scenario.kicker.flat, "kicker.flat.")) return problem;
  const Possession& p = scenario.possession;
  const Opponent& o = scenario.opponent;
  if (auto problem = ordered("possession.goal_distance_min_m", p.goal_distance_min_m, p.goal_distance_max_m))
    return problem;
  if (auto problem = ordered("possession.speed_min_mps", p.speed_min_mps, p.speed_max_mps)) return problem;
  if (auto problem = ordered("opponent.closing_min_mps", o.closing_min_mps, o.closing_max_mps)) return problem;
  if (auto problem = whole("opponent.count", o.count)) return problem;
  if (auto problem = whole("kicker.drop_after_kicks", scenario.kicker.drop_after_kicks)) return problem;
  if (auto problem = whole("defenders.count", scenario.defenders.count)) return problem;
  if (auto problem = team_problem(scenario.team)) return problem;
  if (scenario.referee.set_pieces && p.stop_s <= 0.0)
    return Problem{"referee.set_pieces", "a set piece is announced while play is stopped, and possession.stop_s is 0"};
  const std::size_t wheels = scenario.robot.wheel_angles_rad.size();
  if (wheels != 3 && wheels != 4) {
    return Problem{"robot.wheel_angles_rad", fmt::format("{} wheels where 3 or 4 are known", wheels)};
  }
  return std::nullopt;
}

}  // namespace trivela::sim
