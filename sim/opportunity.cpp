#include "sim/opportunity.hpp"

#include <cmath>
#include <numbers>

namespace trivela::sim {

Opportunity draw_opportunity(const Scenario& scenario, const Draws& draws) {
  const Possession& p = scenario.possession;
  const Opponent& o = scenario.opponent;
  const double goal_distance = draws.uniform_in(p.goal_distance_min_m, p.goal_distance_max_m, Role::kStart, 0);
  const double ball_x = draws.uniform_in(-p.lateral_max_m, p.lateral_max_m, Role::kStart, 1);
  const auto [aim, travel, spare, unused] = draws.normals(Role::kStart, 2);
  const double speed = draws.uniform_in(p.speed_min_mps, p.speed_max_mps, Role::kStart, 3);

  const double bearing = std::atan2(ball_x, goal_distance);  // of the goal centre from the ball
  const double heading = kicking::wrap_angle(bearing + p.aim_error_sd_rad * aim);
  const double direction = p.travel_direction_sd_rad * travel;
  Opportunity drawn;
  drawn.start = {ball_x + scenario.robot.ball_offset_m * std::sin(heading),
                 scenario.field.goal_line_y_m - goal_distance - scenario.robot.ball_offset_m * std::cos(heading),
                 heading};
  drawn.velocity = {-speed * std::sin(direction), speed * std::cos(direction), 0.0};
  drawn.opponent_distance_m = o.distance_median_m * std::exp(o.distance_sigma_ln * draws.normal(Role::kOpponent, 0));
  drawn.opponent_bearing_rad = draws.uniform_in(-std::numbers::pi, std::numbers::pi, Role::kOpponent, 1);
  drawn.opponent_closing_mps = draws.uniform_in(o.closing_min_mps, o.closing_max_mps, Role::kOpponent, 2);
  return drawn;
}

}  // namespace trivela::sim
