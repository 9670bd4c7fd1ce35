#pragma once

#include <array>
#include <optional>

#include "kicking/policy/match_rules.hpp"
#include "kicking/policy/predictive/drive_plan.hpp"
#include "kicking/policy/predictive/predictive.hpp"
#include "kicking/policy/predictive/shot_chance.hpp"

namespace trivela::kicking {

/// A shot at one instant of a way.
struct PlannedShot {
  double fire_after_s = 0.0;
  ShotChance shot{};
  ReleaseState release{};
  double p_on_target = 0.0;  ///< nobody in the way either; corrected by the learned model where there is one
  double p_goal = 0.0;       ///< the same, and past the keeper; 0 where none is tracked
};

/// What a way promises: the best shot of this cycle and the best later one.
struct CandidateWay {
  Way way{};
  PlannedShot now{};               ///< at the beginning of the cycle, or where schedule() put it
  std::array<double, 3> values{};  ///< S P of a shot at the beginning, middle and end of the cycle
  double value_now = 0.0;          ///< of firing within this cycle: S P, nothing below the threshold
  double value_later = 0.0;        ///< of the best later instant, weighed with keeping the ball until then
  double value() const { return value_now > value_later ? value_now : value_later; }
};

/// Looks ahead from one cycle.
class LookaheadSearch {
 public:
  /// `learned`: corrects the probability; nullptr: the physical one stands.
  LookaheadSearch(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input,
                  const PredictiveMemory& memory, const LearnedModel* learned);

  /// The way that promises most, with its shot of this cycle at its best instant, where it is to be fired now.
  CandidateWay best();

  /// The way's drive command now.
  Twist command(const Way& way) const { return command_at(way, start_); }

 private:
  /// The plans of one aim: one way as long as they do not part.
  struct Ways {
    std::array<DriveMotion, kDrivePlans.size()> bases;
    std::array<CandidateWay, kDrivePlans.size()> candidates{};
    std::size_t count = 1;
  };

  Twist command_at(const Way& way, const DriveMotion& base) const;
  void drive_for(const Way& way, DriveMotion& base, double time_s) const;
  CandidateWay best_to(double aim_x_m);
  void go_on(Ways& ways, double time_s) const;
  ShotFeatures features(const DriveMotion& base, const PlannedShot& planned) const;
  PlannedShot planned_shot(const DriveMotion& base, double fire_after_s);
  double value(const PlannedShot& planned, double survival) const;
  void look_at_this_cycle(Ways& ways);
  void look_ahead(Ways& ways);
  void schedule(CandidateWay& candidate);

  const PolicyConfig& config_;
  const RobotModel& robot_;
  const Goal& goal_;
  const PolicyInput& input_;
  const LearnedModel* learned_;
  bool past_keeper_;
  DribbleLimit reach_;
  DriveMotion start_;
  ShotModel model_;
  Survival survival_;
  const OpponentWatch& opponent_;
  Way way_;                   // of the last cycle
  bool looks_at_both_;        // corners
  double last_fire_after_s_;  // no plan waits longer
  ShotGuess guess_{};
  double ball_speed_mps_;
};

}  // namespace trivela::kicking
