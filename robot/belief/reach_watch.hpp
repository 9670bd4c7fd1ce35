#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "idl/messages.hpp"

namespace trivela::robot {

/// Looks whether play ever comes near the lines of the settings' field. Where neither robot nor ball does in ten
/// minutes of play, the field may be smaller than the settings say: nobody sees the lines themselves. In a simulated
/// world, whose possessions keep off the lines, it says nothing of the field.
class ReachWatch {
 public:
  /// Half the field's length and width.
  ReachWatch(double goal_line_y_m, double side_line_x_m)
      : goal_line_y_m_(goal_line_y_m), side_line_x_m_(side_line_x_m) {}

  /// After so long of play in a half a line is to have been as near as that (both assumed).
  static constexpr double kPlay_s = 600.0;
  static constexpr double kShort_m = 1.5;

  /// Of the robot's next belief: a sentence, once a half.
  std::optional<std::string> see(const msg::WorldState& world);

 private:
  void take(double x_m, double y_m);

  double goal_line_y_m_;
  double side_line_x_m_;
  int half_ = 0;
  std::optional<std::int64_t> played_until_t_ns_;  // none: the game stands
  double played_s_ = 0.0;
  double far_x_m_ = 0.0, far_y_m_ = 0.0;
  bool said_ = false;
};

}  // namespace trivela::robot
