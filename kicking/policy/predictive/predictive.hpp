#pragma once

#include "kicking/policy/predictive/drive_plan.hpp"
#include "kicking/policy/predictive/opponent_watch.hpp"
#include "kicking/policy/rule.hpp"

namespace trivela::kicking {

struct PredictiveMemory : PossessionMemory {
  OpponentWatch opponent{};
  Way way{};                          ///< that it drives by
  std::uint32_t cycles_searched = 0;  ///< in which it looked for a way
  std::uint8_t lever_kind = 0;        ///< for which it wants the lever to stand ...
  std::int64_t lever_since_t_ns = 0;  ///< ... since then
  std::uint8_t stuck_kinds = 0;       ///< bit i: the lever did not come to kind i when it was told
  std::uint32_t cycles_past = 0;      ///< in a row in which it looked past a keeper
  std::optional<Twist> command;       ///< of the last cycle
  std::optional<Twist> twist;         ///< of the robot in the last cycle
  double speed_jump_mps = 0.0;        ///< by which the twist changed more than the base can

  /// The style that is looked at beside that of its way: another one in each cycle; its own where there is no other.
  std::size_t other_style(std::size_t styles) const {
    return styles > 1 ? (way.style + 1 + cycles_searched % (styles - 1)) % styles : way.style;
  }
  /// It wants the lever to stand for that kind of kick.
  void want_lever(std::uint8_t kind, std::int64_t t_ns);
  /// A lever that has not come to its kind within 2 lever_s + 0.2 s does not come in this possession.
  void watch_lever(const RobotModel& robot, const PolicyInput& input);

  /// The opponent, and the robot's own twist.
  void watch(const PolicyConfig& config, const PolicyInput& input) override;
};

/// Fires where the probability of a ball on target, past a tracked keeper of a goal, now is worth more than any later
/// moment's, weighed with keeping the ball until then (docs/policies.md).
PolicyOutput evaluate_predictive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                                 const PolicyInput& input, PredictiveMemory& memory);

/// The same with the probability corrected by config.learned, where there is one.
PolicyOutput evaluate_learned(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                              const PolicyInput& input, PredictiveMemory& memory);

}  // namespace trivela::kicking
