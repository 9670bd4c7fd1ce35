#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "config/settings.hpp"
#include "idl/messages.hpp"
#include "kicking/kick_id.hpp"
#include "kicking/policy/policy.hpp"
#include "robot/decision/assignment.hpp"
#include "robot/decision/keeper_habit.hpp"
#include "robot/referee/set_piece_clock.hpp"

namespace trivela::robot {

/// What the oracle decides by in place of the robot's settings and model.
struct GroundTruthPolicy {
  kicking::PolicyConfig policy;
  kicking::RobotModel model;
};

/// What a robot decides by.
struct DeciderSettings {
  const config::KickDecision& assignment;
  const kicking::PolicyConfig& policy;
  const kicking::Goal& goal;
};

/// What a policy that rides along says of a cycle.
struct Shadow {
  kicking::PolicyName policy{};
  kicking::PolicyOutput output;
};

/// What was decided in a cycle.
struct CycleDecision {
  PolicyChance in_charge;           ///< of the possession
  kicking::PolicyOutput output;     ///< of the policy in charge
  std::array<Shadow, 4> shadows{};  ///< as many as the wire carries
  std::size_t shadow_count = 0;
  std::optional<msg::KickOrder> order;
};

/// One robot's decisions, without a bus: who is in charge, the memories of all policies, the shadows, and the order
/// that a fire becomes. Nothing allocates after the constructor but learn() of a robot with several kinds of kick.
class Decider {
 public:
  /// `session`: upper 15 bits of every kick_id. `model` must outlive the decider. Throws config::Error where the
  /// policies in charge make no sense together. `oracle`: only where that policy may be in charge.
  Decider(const DeciderSettings& settings, const kicking::RobotModel& model, std::uint8_t robot_id,
          std::uint32_t session, std::optional<GroundTruthPolicy> oracle = std::nullopt);

  /// What the referee says, before the cycle that hears it: when a set piece of ours is to be taken.
  void receive(const msg::Referee& word) { set_piece_.receive(word); }

  /// Goes by what was learned of the kicker from the next cycle on, where it is sound().
  /// Test drives, which measure the kicker, do not.
  void learn(const msg::KickerEstimate& estimate);
  /// Whether it is another one than it goes by, and of a cycle before t_ns.
  bool is_news(const msg::KickerEstimate& estimate, std::int64_t t_ns) const {
    return estimate.seq != estimate_ && estimate.t_ns < t_ns;
  }
  /// KickerEstimate.seq that it goes by; 0: the robot's file.
  std::uint32_t estimate() const { return estimate_; }

  /// Judges the cycle of `world`. `kicker`: status of the cycle, nullptr where none came. `outcome`: the latest that
  /// was seen, if any. `truth`: what the oracle is told where it may be in charge. `world_age_s`: how long ago `world`
  /// held, in real time. The reference holds until the next call.
  const CycleDecision& decide(const msg::WorldState& world, const msg::KickerStatus* kicker,
                              const std::optional<msg::KickOutcome>& outcome,
                              const kicking::PolicyInput* truth = nullptr, double world_age_s = 0.0);

  /// Remembers the last decide(): its order has its number and is pending for the policies. Without it nobody hears of
  /// the decision, and the next order takes the number. Again it changes nothing.
  void commit();

  /// The record of the last decide(), which was given these, after commit(). Its seq counts the cycles with the ball.
  msg::KickDecision record(const msg::WorldState& world, const msg::KickerStatus* kicker) const;

  /// Whether the turn drive, before it goes on, has to hear what became of the kick ordered at last_order_t_ns().
  bool awaits_outcome(const msg::WorldState& world, const msg::KickerStatus* kicker) const;
  std::int64_t last_order_t_ns() const { return last_order_.t_ns; }

  /// Whether a policy that may be asked reads where the opponents are.
  bool reads_opponents() const;

  std::uint32_t orders() const { return orders_; }
  const PolicyAssignment& assignment() const { return assignment_; }

 private:
  void begin_possession(std::uint8_t half, std::uint32_t possession_id);
  bool kicked_by_another(std::int64_t t_ns, const msg::KickerStatus& kicker);
  void see_last_kick(const std::optional<msg::KickOutcome>& outcome, kicking::PolicyInput& input) const;
  void see_keeper(const msg::KickerStatus* kicker, kicking::PolicyInput& input);
  void judge_shadows(const kicking::PolicyInput& input);
  kicking::PolicyMemory& memory(kicking::PolicyName policy) { return memory_[static_cast<std::size_t>(policy)]; }
  std::optional<std::int64_t>& last_fire(kicking::PolicyName policy);

  const kicking::RobotModel& model_of(kicking::PolicyName policy) const {
    return facts(policy).plays() && corrected_ ? *corrected_ : model_;
  }

  const kicking::RobotModel& model_;
  std::optional<kicking::RobotModel> corrected_;
  std::uint32_t estimate_ = 0;  // by which
  kicking::PolicyConfig policy_;
  kicking::Goal goal_;
  std::optional<GroundTruthPolicy> oracle_;
  PolicyAssignment assignment_;
  SetPieceClock set_piece_;
  KeeperHabit keeper_habit_;
  std::vector<kicking::PolicyName> shadows_;
  std::int64_t validity_ns_;
  std::uint8_t robot_id_;
  std::uint32_t session_;  // of each kick_id
  CycleDecision decision_;
  std::vector<kicking::PolicyMemory> memory_;  // of each policy
  std::optional<std::uint8_t> half_;
  std::uint32_t possession_id_ = 0;  // of half_
  msg::KickOrder last_order_{};
  std::uint32_t last_order_possession_id_ = 0;
  std::int64_t accepted_kick_id_ = 0;          // the last one that the driver said
  std::optional<std::int64_t> anothers_t_ns_;  // when it was one of the robot's other decision node
  std::uint32_t orders_ = 0;
  std::uint64_t decisions_ = 0;
  bool counts_ = false;                     // the last cycle, among them, once it is committed
  std::optional<std::int64_t> fired_t_ns_;  // of the last order, until it is committed
};

}  // namespace trivela::robot
