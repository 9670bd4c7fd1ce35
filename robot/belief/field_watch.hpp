#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "idl/messages.hpp"

namespace trivela::robot {

/// Looks whether the belief contradicts the field of the settings: robot or ball well outside it while the game is on,
/// where the referee would long have stopped it. Then field or localisation is another one than the settings say.
class FieldWatch {
 public:
  /// Half the field's length and width.
  FieldWatch(double goal_line_y_m, double side_line_x_m)
      : goal_line_y_m_(goal_line_y_m), side_line_x_m_(side_line_x_m) {}

  /// So far beyond a line is well outside, and so long is no ball that flies or rolls out (both assumed).
  static constexpr double kWellOutside_m = 1.0;
  static constexpr double kFor_s = 2.0;

  /// Of the robot's next belief: sentences, each once from when it left to when it is back or the game is stopped.
  std::vector<std::string> see(const msg::WorldState& world);

 private:
  struct Episode {
    std::optional<std::int64_t> since_t_ns;
    bool said = false;
  };

  double outside_m(double x_m, double y_m) const;
  bool due(Episode& episode, bool outside, std::int64_t t_ns) const;

  double goal_line_y_m_;
  double side_line_x_m_;
  Episode robot_, ball_;
};

}  // namespace trivela::robot
