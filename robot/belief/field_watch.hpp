#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "idl/messages.hpp"
#include "kicking/geometry/goal.hpp"

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

/// Looks whether goals that the referee gives contradict the goal of the settings: the ball crossed the goal line well
/// beside it. Then goal or field is another one, or the localisation is wrong. That a ball crossed inside and no goal
/// was given says nothing: it may have been too high, or not have counted.
class GoalWatch {
 public:
  explicit GoalWatch(const kicking::Goal& goal) : goal_(goal) {}

  /// So far beside a post no noise of pose and ball reaches, and so long after the crossing a referee gives the goal
  /// (both assumed).
  static constexpr double kBeside_m = 0.5;
  static constexpr double kGiven_s = 10.0;
  /// A ball that was not seen for longer may have crossed anywhere.
  static constexpr double kUnseen_s = 0.2;

  /// Of the robot's next belief and the referee's word that it was made with, nullptr where there is none: a sentence,
  /// once a goal.
  std::optional<std::string> see(const msg::WorldState& world, const msg::Referee* referee);

 private:
  struct Sight {
    std::int64_t t_ns = 0;
    double x_m = 0.0, y_m = 0.0;
  };
  void follow(const msg::WorldState& world);
  std::optional<std::string> doubt(double side, std::int64_t t_ns) const;

  kicking::Goal goal_;
  std::optional<Sight> inside_;    // the last sight of the ball between the goal lines
  std::optional<Sight> crossing_;  // where it crossed one of them since the start of play
  std::optional<msg::Referee> received_;
};

}  // namespace trivela::robot
