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

}  // namespace trivela::robot
