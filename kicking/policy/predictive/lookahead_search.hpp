#pragma once

#include <array>
#include <optional>

#include "kicking/policy/match_rules.hpp"
#include "kicking/policy/predictive/drive_plan.hpp"
#include "kicking/policy/predictive/predictive.hpp"
#include "kicking/policy/predictive/shot_chance.hpp"

namespace trivela::kicking {

/// A shot at one instant of a plan.
struct PlannedShot {
  double fire_after_s = 0.0;
  ShotChance shot{};
  ReleaseState release{};
  double p_on_target = 0.0;  ///< nobody in the way either; corrected by the learned model where there is one
};

/// What a plan promises: the best shot of this cycle and the best later one.
struct CandidatePlan {
  DrivePlan plan = DrivePlan::kOnto;
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

  /// The plan that promises most, with its shot of this cycle at its best instant, where it is to be fired now.
  CandidatePlan best();

  /// The plan's drive command now.
  Twist command(DrivePlan plan) const { return command_at(plan, start_); }

 private:
  /// The ways of both plans, one as long as they do not part.
  struct Ways {
    std::array<DriveMotion, kDrivePlans.size()> bases;
    std::array<CandidatePlan, kDrivePlans.size()> candidates{};
    std::size_t count = 1;
  };

  Twist command_at(DrivePlan plan, const DriveMotion& base) const;
  void drive_for(DrivePlan plan, DriveMotion& base, double time_s) const;
  void go_on(Ways& ways, double time_s) const;
  ShotFeatures features(const DriveMotion& base, const PlannedShot& planned) const;
  PlannedShot planned_shot(const DriveMotion& base, double fire_after_s);
  double value(const PlannedShot& planned, double survival) const;
  void look_at_this_cycle(Ways& ways);
  void look_ahead(Ways& ways);
  void schedule(CandidatePlan& candidate);

  const PolicyConfig& config_;
  const RobotModel& robot_;
  const Goal& goal_;
  const PolicyInput& input_;
  const LearnedModel* learned_;
  DribbleLimit reach_;
  DriveMotion start_;
  ShotModel model_;
  Survival survival_;
  const OpponentWatch& opponent_;
  double last_fire_after_s_;  // no plan waits longer
  ShotGuess guess_{};
  double ball_speed_mps_;
};

}  // namespace trivela::kicking
