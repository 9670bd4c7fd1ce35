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
  std::uint8_t kind = 0;  ///< of the kick
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
  double later_s = 0.0;            ///< until that instant
  std::uint8_t kind_later = 0;     ///< of the kick of that instant
  bool fires = false;              ///< the kick of this cycle is worth more than waiting
  double value() const { return value_now > value_later ? value_now : value_later; }
  std::uint8_t kind() const { return value_now >= value_later ? now.kind : kind_later; }
  /// A later instant of that value.
  void see_later(double value, double after_s, std::uint8_t kind) {
    if (value <= value_later) return;
    value_later = value;
    later_s = after_s;
    kind_later = kind;
  }
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

  double aim_x_m(const Way& way, const DriveMotion& base) const;
  Twist command_at(const Way& way, const DriveMotion& base) const;
  void drive_for(const Way& way, DriveMotion& base, double time_s) const;
  CandidateWay best_to(double aim_x_m, std::size_t style);
  bool fires(const CandidateWay& candidate) const;
  void go_on(Ways& ways, double time_s) const;
  ShotFeatures features(const DriveMotion& base, const PlannedShot& planned) const;
  /// The best of the kinds for which the lever stands by then. Of chances of `least` or below it may say 0.
  PlannedShot planned_shot(const DriveMotion& base, double fire_after_s, bool now, double least = 0.0);
  PlannedShot shot_of(std::uint8_t kind, const DriveMotion& base, double fire_after_s, double least);
  double chance(const PlannedShot& planned) const { return past_keeper_ ? planned.p_goal : planned.p_on_target; }
  double passes(const PlannedShot& planned, double release_after_s) const;
  double worth(const PlannedShot& planned) const;
  double value(const PlannedShot& planned, double survival) const;
  void look_at_this_cycle(Ways& ways);
  void look_ahead(Ways& ways);
  void schedule(CandidateWay& candidate);

  const PolicyConfig& config_;
  const RobotModel& robot_;
  const Goal& goal_;
  const PolicyInput& input_;
  const LearnedModel* learned_;  // nullptr: P is the physical one
  const LearnedDecision& decision_;
  PredictiveConfig settings_;
  bool past_keeper_;
  DribbleLimit reach_;
  DriveMotion start_;
  /// One kind of kick.
  struct Kind {
    ShotModel model;
    ShotGuess guess{};
    double lever_s = 0.0;  ///< until the lever stands for it
    double later_s = 0.0;  ///< by which its ball leaves later than the first kind's
  };
  Kind kind_of(std::size_t i, const PredictiveMemory& memory) const;

  /// An opponent as seen from the ball now. It keeps its bearing and comes nearer until the ball leaves.
  struct Opponent {
    Eigen::Vector2d bearing{0.0, 1.0};
    double distance_m = 0.0;
    double closing_mps = 0.0;
    double sd_m = 0.0;
  };
  void look_at_opponents();

  StateSpread spread_;
  std::array<std::optional<Kind>, kMostKickKinds> kinds_;
  std::size_t kind_count_;
  Survival survival_;
  const OpponentWatch& opponent_;  // the nearest
  std::array<Opponent, kMostBodies> bodies_{};
  std::size_t body_count_ = 0;
  std::uint8_t wanted_kind_;  // for which the lever was told to stand
  Way way_;                   // of the last cycle
  std::size_t other_style_;   // that is looked at beside it
  double dribble_mps_;
  double half_width_m_;       // of the goal, where a ball passes clean
  bool looks_at_both_;        // corners
  double last_fire_after_s_;  // no plan waits longer
  double ball_speed_mps_;
};

}  // namespace trivela::kicking
