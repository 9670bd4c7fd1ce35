#include "kicking/policy/predictive/shot_chance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kicking/ballistics/floor_way.hpp"
#include "kicking/ballistics/moving_kick.hpp"

namespace trivela::kicking {
namespace {

constexpr double kHopeless_m = 2.5;  // a mean crossing so far beyond a post is not computed further

}  // namespace

bool low_kick(const RobotModel& robot, const Goal& goal) {
  const SetPoint& full = robot.table.back();
  const double rising_mps = full.speed_mps * std::sin(robot.exit_angle_at(full.power));
  return robot.ball.radius_m + rising_mps * rising_mps / (2.0 * kGravity_mps2) < goal.clean_height_m(robot.ball);
}

/// The power of a kick to the best height. False: it passes far beside the goal.
bool ShotModel::aim(const ReleaseState& release, const Eigen::Vector2d& carried_mps, ShotGuess& guess,
                    ShotChance& out) const {
  const LineAhead line{goal_.y_m - release.ball_m.y(), release.forward.y(), carried_mps.y()};
  if (!(line.distance_m > 0.0 && line.toward_ratio > 0.0)) return false;
  out.aim_height_m = best_height_(guess.sd_z_m);
  const auto kick = directed_kick(line, out.aim_height_m - robot_.ball.radius_m, guess.exit_angle);
  PowerReading reading{robot_.table.front().power, PowerRange::kBelow};  // too near for the height
  if (kick) {
    const double x_m = release.ball_m.x() + kick->t_flight_s * carried_mps.x() +
                       (line.distance_m - kick->t_flight_s * carried_mps.y()) / line.toward_ratio * release.forward.x();
    if (std::abs(x_m) > goal_.half_width_m + kHopeless_m) return false;
    reading = robot_.table.power_for(kick->v_kick_mps);
  }
  out.power = reading.power;
  out.out_of_range = reading.range == PowerRange::kAbove;
  return true;
}

/// The time of a low kick that comes to the floor before the line.
void ShotModel::go_over_floor(const ReleaseState& release, const Eigen::Vector2d& carried_mps, ShotChance& out) const {
  CrossingSpread& crossing = out.crossing;
  out.aim_height_m = std::max(crossing.z_m, robot_.ball.radius_m);
  if (crossing.z_m >= robot_.ball.radius_m) return;
  const double v = out.exit.v_kick_mps;
  const Eigen::Vector2d w = v * out.exit.exit_angle.cosine * release.forward + carried_mps;
  crossing.t_flight_s = floor_time_s(w.norm(), v * out.exit.exit_angle.sine, crossing.t_flight_s * w.norm(),
                                     {.friction_ratio = config_.predictive.floor_friction_ratio});
  out.out_of_range = !std::isfinite(crossing.t_flight_s);
}

ShotChance ShotModel::chance(const ReleaseState& release, ShotGuess& guess, double least) const {
  ShotChance out;
  const Eigen::Vector2d carried = release.carried_mps(robot_.transfer_exact, robot_.ball_offset_m);
  if (low_) {
    if (!(release.forward.y() > 0.0)) return out;
    out.power = robot_.table.back().power;
  } else if (!aim(release, carried, guess, out)) {
    return out;
  }
  // Angles of one table differ by a degree: that of this power serves the next instant's aim.
  if (robot_.exit_angles) guess.exit_angle = Elevation(robot_.exit_angle_at(out.power));
  out.exit = {robot_.table.speed_for(out.power), guess.exit_angle};
  out.crossing = crossing_spread(release, out.exit, robot_, state_, goal_.y_m);
  if (!std::isfinite(out.crossing.x_m)) {
    out.out_of_range = false;
    return out;
  }
  if (low_) {
    go_over_floor(release, carried, out);
  } else {
    guess.sd_z_m = out.crossing.sd_z_m;
    out.out_of_range = out.out_of_range && out.crossing.z_m < robot_.ball.radius_m;
  }
  if (out.out_of_range) return out;
  const double bounce_ratio = low_ ? config_.predictive.low_bounce_ratio : config_.predictive.bounce_ratio;
  if (keeper_) {
    const GoalChance chance =
        goal_chance(out.crossing, bounce_ratio, config_.keeper, *keeper_, goal_, robot_.ball, least);
    out.p = chance.p_on_target;
    out.p_goal = chance.p_goal;
  } else {
    out.p = p_on_target(out.crossing, bounce_ratio, goal_, robot_.ball, least);
  }
  return out;
}

double p_blocked(const PredictiveConfig& config, double distance_m, const ShotChance& shot, const Ball& ball,
                 double gravity_mps2) {
  const double reach_m = config.opponent_radius_m + ball.radius_m;
  if (!(distance_m > 0.0 && shot.exit.v_kick_mps > 0.0)) return 0.0;
  const double v_h = shot.exit.v_kick_mps * shot.exit.exit_angle.cosine;
  const double v_z = shot.exit.v_kick_mps * shot.exit.exit_angle.sine;
  const auto clears = [&](double way_m) {
    const double t = std::max(0.0, way_m) / v_h;
    return v_z * t - 0.5 * gravity_mps2 * t * t >= config.opponent_height_m;
  };
  if (clears(distance_m - reach_m) && clears(distance_m + reach_m)) return 0.0;
  return std::asin(std::min(1.0, reach_m / distance_m)) / std::numbers::pi;
}

}  // namespace trivela::kicking
