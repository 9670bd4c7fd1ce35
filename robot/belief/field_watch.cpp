#include "robot/belief/field_watch.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {

/// Beyond the nearest line; negative inside.
double FieldWatch::outside_m(double x_m, double y_m) const {
  return std::max(std::abs(x_m) - side_line_x_m_, std::abs(y_m) - goal_line_y_m_);
}

bool FieldWatch::due(Episode& episode, bool outside, std::int64_t t_ns) const {
  if (!outside) {
    episode = {};
    return false;
  }
  if (!episode.since_t_ns) episode.since_t_ns = t_ns;
  if (episode.said || kicking::seconds(*episode.since_t_ns, t_ns) < kFor_s) return false;
  return episode.said = true;
}

std::vector<std::string> FieldWatch::see(const msg::WorldState& world) {
  std::vector<std::string> sentences;
  const auto look = [&](Episode& episode, const char* who, bool known, double x_m, double y_m) {
    const double beyond_m = outside_m(x_m, y_m);
    if (!due(episode, world.playing && known && beyond_m > kWellOutside_m, world.t_ns)) return;
    sentences.push_back(
        fmt::format("the {} has been outside the field of {:.1f} x {:.1f} m for {:.0f} s while the game is on, now at "
                    "({:.1f}, {:.1f}) "
                    "m, {:.1f} m beyond a line: goal.y_m and field.side_line_x_m are not of this field, or the "
                    "localisation is wrong",
                    who, 2.0 * goal_line_y_m_, 2.0 * side_line_x_m_, kFor_s, x_m, y_m, beyond_m));
  };
  look(robot_, "robot", true, world.x_m, world.y_m);
  look(ball_, "ball", world.ball_known, world.ball_x_m, world.ball_y_m);
  return sentences;
}

/// NaN reaches nowhere.
void ReachWatch::take(double x_m, double y_m) {
  far_x_m_ = std::fmax(far_x_m_, std::abs(x_m));
  far_y_m_ = std::fmax(far_y_m_, std::abs(y_m));
}

std::optional<std::string> ReachWatch::see(const msg::WorldState& world) {
  if (world.half != half_) {
    *this = ReachWatch{goal_line_y_m_, side_line_x_m_};
    half_ = world.half;
  }
  if (!world.playing) {
    played_until_t_ns_.reset();
    return std::nullopt;
  }
  if (played_until_t_ns_) played_s_ += std::max(0.0, kicking::seconds(*played_until_t_ns_, world.t_ns));
  played_until_t_ns_ = world.t_ns;
  take(world.x_m, world.y_m);
  if (world.ball_known) take(world.ball_x_m, world.ball_y_m);
  const bool near_both = far_y_m_ >= goal_line_y_m_ - kShort_m && far_x_m_ >= side_line_x_m_ - kShort_m;
  if (said_ || near_both || played_s_ < kPlay_s) return std::nullopt;
  said_ = true;
  return fmt::format(
      "in {:.0f} min of play neither robot nor ball came farther than {:.1f} m across and {:.1f} m along from the "
      "middle "
      "of the field of {:.1f} x {:.1f} m: goal.y_m and field.side_line_x_m may be of a larger field than this one",
      played_s_ / 60.0, far_x_m_, far_y_m_, 2.0 * goal_line_y_m_, 2.0 * side_line_x_m_);
}

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
