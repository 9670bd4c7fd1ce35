#include "robot/belief/reach_watch.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {

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

}  // namespace trivela::robot
