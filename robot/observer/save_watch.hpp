#pragma once

#include "robot/observer/shot_judge.hpp"

namespace trivela::robot {

/// How often a ball between posts and bar is saved, learned from the shots seen so far. With S the sum of p_saved and N
/// that of p_on_target, and a mean of 0.005 before anything is seen, worth two shots:
///
///     ratio = (0.01 + S) / (2 + N)
class SaveWatch {
 public:
  void learn(const ShotVerdict& verdict) {
    if (!verdict.p_saved || !verdict.probabilities) return;
    saved_ += *verdict.p_saved;
    on_target_ += (*verdict.probabilities)[static_cast<std::size_t>(kicking::Outcome::kOnTarget)];
  }
  double ratio() const { return (kShots * ShotTrack{}.save_ratio + saved_) / (kShots + on_target_); }

 private:
  static constexpr double kShots = 2.0;
  double saved_ = 0.0;
  double on_target_ = 0.0;
};

}  // namespace trivela::robot
