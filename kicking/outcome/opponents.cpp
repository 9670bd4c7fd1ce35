#include "kicking/outcome/opponents.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "kicking/outcome/outcome.hpp"

namespace trivela::kicking {

double p_in_the_way(const Eigen::Vector2d& relative_m, double sd_m, const KickPath& path, const Body& body,
                    const Ball& ball, double gravity_mps2) {
  const double speed_mps = path.velocity_mps.norm(), reach_m = body.radius_m + ball.radius_m;
  if (!(speed_mps > 0.0)) return 0.0;
  const Eigen::Vector2d along = path.velocity_mps / speed_mps;
  const double s_m = relative_m.dot(along), u_m = relative_m.x() * along.y() - relative_m.y() * along.x();
  if (s_m <= 0.0) return 0.0;
  const auto clears = [&](double way_m) {
    const double t = std::max(0.0, way_m) / speed_mps;
    return path.v_z_mps * t - 0.5 * gravity_mps2 * t * t >= body.height_m;
  };
  if (clears(s_m - reach_m) && clears(s_m + reach_m)) return 0.0;
  const double sd_u_m = std::hypot(sd_m, s_m * path.sd_rad);
  return normal_below(reach_m - u_m, sd_u_m) - normal_below(-reach_m - u_m, sd_u_m);
}

namespace {

struct Node {
  double sds, weight;
};
const std::array<Node, 3> kNodes{{{-std::sqrt(3.0), 1.0 / 6.0}, {0.0, 2.0 / 3.0}, {std::sqrt(3.0), 1.0 / 6.0}}};

/// Probability that a ball which crosses at N(mean, sd^2) lies to the right of an edge at N(edge, edge_sd^2), but not
/// of the right post, of which `inside` is the probability; `inside_left` that of the left one.
double p_beside(double mean_m, double sd_m, double edge_m, double edge_sd_m, double post_m, double inside,
                double inside_left) {
  double p = 0.0;
  for (const Node& node : kNodes) {
    const double from_m = edge_m + node.sds * edge_sd_m;
    if (from_m >= post_m) continue;
    p += node.weight * (inside - (from_m <= -post_m ? inside_left : normal_below(from_m - mean_m, sd_m)));
  }
  return p;
}

/// How far a keeper that guesses has gone after t_s.
double guessed_m(const KeeperConfig& keeper, double t_s) {
  const double a = keeper.acceleration_mps2, half_s = std::sqrt(keeper.guess_m / a);
  if (!(a > 0.0) || t_s >= 2.0 * half_s) return keeper.guess_m;
  return t_s < half_s ? 0.5 * a * t_s * t_s : keeper.guess_m - 0.5 * a * std::pow(2.0 * half_s - t_s, 2);
}

/// Probability that a ball crosses at N(mean, sd^2) between the posts and at the body of a keeper that guesses.
double p_at_guess(const CrossingSpread& crossing, const KeeperConfig& keeper, const KeeperPlace& place, double post_m,
                  double radius_m) {
  const double reach_m = keeper.half_width_m + radius_m, gone_m = guessed_m(keeper, crossing.t_flight_s);
  const double sd_m =
      std::sqrt(crossing.sd_x_m * crossing.sd_x_m + keeper.sd_m * keeper.sd_m + place.sd_m * place.sd_m);
  double p = 0.0;
  for (const double side : {-1.0, 1.0}) {
    const double middle_m = place.x_m + side * gone_m;
    const double from_m = std::max(middle_m - reach_m, -post_m), to_m = std::min(middle_m + reach_m, post_m);
    if (to_m > from_m) p += 0.5 * (normal_below(to_m - crossing.x_m, sd_m) - normal_below(from_m - crossing.x_m, sd_m));
  }
  return p;
}

}  // namespace

double keeper_reach_m(const KeeperConfig& keeper, double flight_s, const Ball& ball) {
  const double h = keeper.half_width_m + ball.radius_m;
  const double a = keeper.acceleration_mps2, v = keeper.speed_mps, tau = flight_s - keeper.reaction_s;
  if (!(tau > 0.0 && a > 0.0 && v > 0.0)) return h;
  const double now_mps = std::min(v, a * tau);
  if (h >= now_mps * now_mps / (2.0 * a)) return h + (a * tau <= v ? 0.5 * a * tau * tau : v * (tau - 0.5 * v / a));
  const double stops_s = tau + std::sqrt(2.0 * h / a);
  return stops_s <= 2.0 * v / a ? 0.25 * a * stops_s * stops_s : v * (stops_s - v / a);
}

GoalChance goal_chance(const CrossingSpread& crossing, double bounce_ratio, const KeeperConfig& keeper,
                       const KeeperPlace& place, const Goal& goal, const Ball& ball, double least) {
  const double post_m = goal.clean_half_width_m(ball), x = crossing.x_m, sd_x = crossing.sd_x_m;
  const double inside_right = normal_below(post_m - x, sd_x), outside_left = normal_below(-post_m - x, sd_x);
  const double between = inside_right - outside_left;
  if (between <= least) return {};
  const double below = normal_below(goal.clean_height_m(ball) - crossing.z_m, crossing.sd_z_m);
  const double in_height = below - (1.0 - bounce_ratio) * normal_below(ball.radius_m - crossing.z_m, crossing.sd_z_m);
  GoalChance chance{.p_on_target = std::max(0.0, between * in_height)};
  if (chance.p_on_target <= least) return {};
  double beside = 0.0;
  if (place.guesses) {
    beside = std::max(0.0, between - p_at_guess(crossing, keeper, place, post_m, ball.radius_m));
  } else {
    const double reach_m = keeper_reach_m(keeper, crossing.t_flight_s, ball);
    const double sd_m = std::hypot(keeper.sd_m, place.sd_m);
    beside = p_beside(x, sd_x, place.x_m + reach_m, sd_m, post_m, inside_right, outside_left) +
             p_beside(-x, sd_x, reach_m - place.x_m, sd_m, post_m, 1.0 - outside_left, 1.0 - inside_right);
  }
  const double covered = std::max(0.0, between - beside);
  const double over =
      std::max(0.0, below - normal_below(keeper.height_m + ball.radius_m - crossing.z_m, crossing.sd_z_m));
  const double past = over + keeper.miss_ratio * std::max(0.0, in_height - over);
  chance.p_goal = std::max(0.0, std::min(beside, between) * in_height + covered * past);
  return chance;
}

}  // namespace trivela::kicking
