#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "kicking/policy/drives/test_drive.hpp"
#include "kicking/policy/moving.hpp"
#include "kicking/policy/policy_interface.hpp"
#include "kicking/policy/predictive/predictive.hpp"
#include "kicking/policy/rule.hpp"
#include "kicking/policy/stopped.hpp"

namespace trivela::kicking {

template <class Memory>
struct PolicyRow {
  using Remembered = Memory;
  PolicyFacts facts;
  Rule<Memory>* evaluate;
};
template <class Memory>
PolicyRow(PolicyFacts, Rule<Memory>*) -> PolicyRow<Memory>;

/// The policies, in the order of the wire's Policy; each rule's own file says what it does. The oracle is predictive on
/// the simulator's true state.
inline constexpr std::tuple kPolicyRows{
    PolicyRow{{.name = "stopped", .kind = PolicyKind::kPlay, .rides_along = true, .reads_opponents = false},
              evaluate_stopped},
    PolicyRow{{.name = "moving", .kind = PolicyKind::kPlay, .rides_along = true, .reads_opponents = false},
              evaluate_moving},
    PolicyRow{{.name = "standing_drive", .kind = PolicyKind::kDrive}, evaluate_standing_drive},
    PolicyRow{{.name = "lateral_drive", .kind = PolicyKind::kDrive}, evaluate_lateral_drive},
    PolicyRow{{.name = "turn_drive", .kind = PolicyKind::kDrive}, evaluate_turn_drive},
    PolicyRow{{.name = "straight_drive", .kind = PolicyKind::kDrive}, evaluate_straight_drive},
    PolicyRow{{.name = "predictive", .kind = PolicyKind::kPredictive, .rides_along = true}, evaluate_predictive},
    PolicyRow{{.name = "learned", .kind = PolicyKind::kPredictive, .needs = PolicyNeeds::kModel, .rides_along = true},
              evaluate_learned},
    PolicyRow{{.name = "oracle", .kind = PolicyKind::kPredictive, .needs = PolicyNeeds::kTruth}, evaluate_predictive},
};

inline constexpr std::array kPolicyFacts =
    std::apply([](const auto&... row) { return std::array{row.facts...}; }, kPolicyRows);
inline constexpr std::size_t kPolicyCount = kPolicyFacts.size();

constexpr std::optional<int> row_of(std::string_view name) {
  for (std::size_t i = 0; i < kPolicyCount; ++i)
    if (name == kPolicyFacts[i].name) return static_cast<int>(i);
  return std::nullopt;
}

/// A policy: its place in policies(). Those that something singles out have an enumerator; the others need none.
enum class PolicyName {
  kStopped = row_of("stopped").value(),
  kMoving = row_of("moving").value(),
  kStandingDrive = row_of("standing_drive").value(),
  kLateralDrive = row_of("lateral_drive").value(),
  kTurnDrive = row_of("turn_drive").value(),
  kStraightDrive = row_of("straight_drive").value(),
  kPredictive = row_of("predictive").value(),
  kLearned = row_of("learned").value(),
  kOracle = row_of("oracle").value()
};

inline constexpr std::array kPolicyNames = [] {
  std::array<const char*, kPolicyCount> names{};
  for (std::size_t i = 0; i < kPolicyCount; ++i) names[i] = kPolicyFacts[i].name;
  return names;
}();

/// Every policy that this program knows: the rows, then those from outside in the order in which they came.
std::span<const Policy* const> policies();

/// Adds a policy from outside, before anything else is read or played. Its place is its PolicyName, behind
/// kPolicyCount. Throws std::invalid_argument where
/// - its name is not 1 to 31 of a-z, 0-9 and _ with a letter first, or is taken,
/// - the keys of its settings are not like that, or stand twice,
/// - a usual value is not in its range.
PolicyName register_policy(std::unique_ptr<Policy> policy);

/// Makes known that another program has a policy of this name, with these keys in [policy.own.NAME]. It is in charge
/// nowhere in this program. Later keys add to those of before. Throws as register_policy() does.
void declare_policy(const std::string& name, const std::vector<std::string>& keys);

/// The settings of the policies from outside as PolicyConfig::own has them, usual values where `own` has none.
void complete_own_settings(std::vector<std::vector<double>>& own);

const PolicyFacts& facts(PolicyName policy);
inline const char* name(PolicyName policy) { return facts(policy).name; }
inline bool from_outside(PolicyName policy) { return static_cast<std::size_t>(policy) >= kPolicyCount; }
std::optional<PolicyName> policy_named(std::string_view name);

/// Names of the policies with such facts, in the order of policies().
std::vector<std::string> policies_where(auto&& fits) {
  std::vector<std::string> names;
  for (const Policy* policy : policies())
    if (fits(policy->facts())) names.emplace_back(policy->facts().name);
  return names;
}

/// What a policy remembers from cycle to cycle. A new possession starts it afresh, but for a drive's progress; so does
/// a policy that remembers something else.
class PolicyMemory {
 public:
  PolicyMemory() = default;
  /// Made now, so that evaluate() allocates nothing in the first cycle either.
  explicit PolicyMemory(PolicyName policy);
  PolicyMemory(const PolicyMemory& other);
  PolicyMemory& operator=(const PolicyMemory& other);
  PolicyMemory(PolicyMemory&&) = default;
  PolicyMemory& operator=(PolicyMemory&&) = default;
  ~PolicyMemory() = default;

  /// That of the policy, a fresh one where the policy before remembered something else.
  PossessionMemory& of(const Policy& policy);

  /// nullptr: nothing is remembered yet.
  PossessionMemory* get() { return memory_.get(); }

  /// Throws std::bad_cast where it is another one.
  template <class Memory>
  const Memory& as() const {
    return dynamic_cast<const Memory&>(*memory_);
  }

 private:
  const Policy* policy_ = nullptr;
  std::unique_ptr<PossessionMemory> memory_;
};

/// Fire or hold? A pure function of its arguments but for the policy's own memory, which it brings up to date; nothing
/// allocates but a memory that is made. A policy that is not in charge is judged by the same function with a memory of
/// its own. It never fires when the game stands, the ball is not held, the kicker is not ready, the state is older than
/// max_state_age_s or not finite, no set-point reaches the target height (but for kStandingDrive, which kicks for the
/// laser, and the predictive ones, which choose their height: where full power falls short of the line), or an order of
/// this possession is pending. A policy of another program: std::logic_error.
PolicyOutput evaluate(PolicyName policy, const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                      const PolicyInput& input, PolicyMemory& memory);

}  // namespace trivela::kicking
