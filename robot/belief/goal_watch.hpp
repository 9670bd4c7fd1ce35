#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "idl/messages.hpp"
#include "kicking/geometry/goal.hpp"

namespace trivela::robot {

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
