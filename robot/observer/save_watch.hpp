#pragma once

#include "robot/observer/shot_judge.hpp"

namespace trivela::robot {

/// How often a ball between posts and bar comes back, since somebody keeps the goal: learned from the shots that are
/// surely on target. 0.005 until two of them came back, then the share of them that did. A ball that comes back from
/// near a post may then be a save as well as the post.
class SaveWatch {
 public:
  void learn(const ShotVerdict& verdict) {
    if (verdict.outcome != kicking::Outcome::kOnTarget) return;
    ++(verdict.came_back ? saved_ : passed_);
  }
  double ratio() const { return saved_ < 2 ? ShotTrack{}.save_ratio : saved_ / static_cast<double>(saved_ + passed_); }

 private:
  int saved_ = 0, passed_ = 0;
};

}  // namespace trivela::robot
