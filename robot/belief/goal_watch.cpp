#include "robot/belief/goal_watch.hpp"

#include <fmt/core.h>

#include <cmath>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {

/// The crossing lies on the line between the last sight before the goal line and the first behind it.
void GoalWatch::follow(const msg::WorldState& world) {
  const Sight now{world.t_ns, world.ball_x_m, world.ball_y_m};
  if (!world.ball_known || !(world.ball_age_s <= kUnseen_s) || !std::isfinite(now.x_m + now.y_m)) return;
  if (std::abs(now.y_m) <= goal_.y_m) {
    inside_ = now;
    if (world.playing) crossing_.reset();  // it came back
    return;
  }
  if (inside_ && world.playing && kicking::seconds(inside_->t_ns, now.t_ns) <= kUnseen_s) {
    const double line_m = std::copysign(goal_.y_m, now.y_m);
    const double part = (line_m - inside_->y_m) / (now.y_m - inside_->y_m);
    crossing_ = Sight{now.t_ns, inside_->x_m + part * (now.x_m - inside_->x_m), line_m};
  }
  inside_.reset();
}

std::optional<std::string> GoalWatch::doubt(double side, std::int64_t t_ns) const {
  if (!crossing_ || crossing_->y_m * side < 0.0 || kicking::seconds(crossing_->t_ns, t_ns) > kGiven_s)
    return std::nullopt;
  if (std::abs(crossing_->x_m) <= goal_.half_width_m + kBeside_m) return std::nullopt;
  return fmt::format(
      "the referee gave a goal, and the ball crossed the goal line at x = {:.1f} m, outside the goal of {:.1f} m: "
      "goal.half_width_m is not of this field, or the localisation is wrong",
      crossing_->x_m, 2.0 * goal_.half_width_m);
}

std::optional<std::string> GoalWatch::see(const msg::WorldState& world, const msg::Referee* referee) {
  follow(world);
  if (referee == nullptr) return std::nullopt;
  std::optional<std::string> sentence;
  if (received_ && referee->goals_own > received_->goals_own) sentence = doubt(1.0, world.t_ns);
  if (received_ && referee->goals_other > received_->goals_other) sentence = doubt(-1.0, world.t_ns);
  if (received_ && referee->playing && !received_->playing) crossing_.reset();
  received_ = *referee;
  return sentence;
}

}  // namespace trivela::robot
