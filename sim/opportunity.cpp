#include "sim/opportunity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trivela::sim {
namespace {

OpponentStart draw_opponent(const Opponent& o, const kicking::Draws& draws, std::uint32_t i) {
  const double median_m = i == 0 ? o.distance_median_m : o.further_median_m;
  return {.distance_m = median_m * std::exp(o.distance_sigma_ln * draws.normal(kicking::Role::kOpponent, 0, i)),
          .bearing_rad = draws.uniform_in(-std::numbers::pi, std::numbers::pi, kicking::Role::kOpponent, 1, i),
          .closing_mps = draws.uniform_in(o.closing_min_mps, o.closing_max_mps, kicking::Role::kOpponent, 2, i)};
}

}  // namespace

Opportunity draw_opportunity(const Scenario& scenario, const kicking::Draws& draws) {
  const Possession& p = scenario.possession;
  const double goal_distance = draws.uniform_in(p.goal_distance_min_m, p.goal_distance_max_m, kicking::Role::kStart, 0);
  const double ball_x = draws.uniform_in(-p.lateral_max_m, p.lateral_max_m, kicking::Role::kStart, 1);
  const auto [aim, travel, spare, unused] = draws.normals(kicking::Role::kStart, 2);
  const double speed = draws.uniform_in(p.speed_min_mps, p.speed_max_mps, kicking::Role::kStart, 3);

  const double bearing = std::atan2(ball_x, goal_distance);  // of the goal centre from the ball
  const double heading = kicking::wrap_angle(bearing + p.aim_error_sd_rad * aim);
  const double direction = p.travel_direction_sd_rad * travel;
  Opportunity drawn;
  drawn.start = {ball_x + scenario.robot.ball_offset_m * std::sin(heading),
                 scenario.field.goal_line_y_m - goal_distance - scenario.robot.ball_offset_m * std::cos(heading),
                 heading};
  drawn.velocity = {-speed * std::sin(direction), speed * std::cos(direction), 0.0};
  drawn.robot =
      static_cast<std::uint8_t>(1.0 + std::floor(scenario.team.robots * draws.uniform(kicking::Role::kTeam, 0)));
  drawn.opponent_count = static_cast<std::size_t>(scenario.opponent.count);
  for (std::uint32_t i = 0; i < drawn.opponent_count; ++i)
    drawn.opponents[i] = draw_opponent(scenario.opponent, draws, i);
  for (std::size_t i = 1; i < drawn.opponent_count; ++i) {
    drawn.opponents[i].distance_m = std::max(drawn.opponents[i].distance_m, drawn.opponents[0].distance_m);
  }
  const double stops_per_s = scenario.referee.stops_per_min / 60.0;
  if (stops_per_s > 0.0) drawn.whistle_s = -std::log(1.0 - draws.uniform(kicking::Role::kReferee, 0)) / stops_per_s;
  return drawn;
}

}  // namespace trivela::sim
