#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "kicking/policy/moving.hpp"
#include "kicking/policy/predictive/predictive.hpp"
#include "kicking/policy/rule.hpp"
#include "kicking/policy/stopped.hpp"
#include "kicking/policy/test_drive.hpp"

namespace trivela::kicking {

/// kPlay: aims by the configured laws. kPredictive: weighs probabilities and aims by its own. kDrive: calibrates a
/// robot and is no policy of play; its memory outlives the possession.
enum class PolicyKind { kPlay, kPredictive, kDrive };

/// What a policy has to be given besides a robot's own belief: a learned model, or the simulator's true state.
enum class PolicyNeeds { kNothing, kModel, kTruth };

/// What others need to know of a policy.
struct PolicyFacts {
  const char* name;  ///< in files, flags and logs, and the wire's label
  PolicyKind kind;
  PolicyNeeds needs = PolicyNeeds::kNothing;
  bool rides_along = false;  ///< judged as a shadow while another one is in charge; the wire and the log have four

  constexpr bool plays() const { return kind != PolicyKind::kDrive; }
  constexpr bool needs_truth() const { return needs == PolicyNeeds::kTruth; }
  constexpr bool needs_model() const { return needs == PolicyNeeds::kModel; }
};

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
    PolicyRow{{.name = "stopped", .kind = PolicyKind::kPlay, .rides_along = true}, evaluate_stopped},
    PolicyRow{{.name = "moving", .kind = PolicyKind::kPlay, .rides_along = true}, evaluate_moving},
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

/// A policy: the place of its row. Those that something singles out have an enumerator; the others need none.
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

inline constexpr std::array kEveryPolicy = [] {
  std::array<PolicyName, kPolicyCount> all{};
  for (std::size_t i = 0; i < kPolicyCount; ++i) all[i] = static_cast<PolicyName>(i);
  return all;
}();

inline constexpr std::array kPolicyNames = [] {
  std::array<const char*, kPolicyCount> names{};
  for (std::size_t i = 0; i < kPolicyCount; ++i) names[i] = kPolicyFacts[i].name;
  return names;
}();

constexpr const PolicyFacts& facts(PolicyName policy) { return kPolicyFacts[static_cast<std::size_t>(policy)]; }
constexpr const char* name(PolicyName policy) { return facts(policy).name; }
constexpr std::optional<PolicyName> policy_named(std::string_view name) {
  if (const auto row = row_of(name)) return static_cast<PolicyName>(*row);
  return std::nullopt;
}

/// Names of the policies with such facts, in the order of the rows.
std::vector<std::string> policies_where(auto&& fits) {
  std::vector<std::string> names;
  for (const PolicyFacts& facts : kPolicyFacts)
    if (fits(facts)) names.emplace_back(facts.name);
  return names;
}

/// A variant of these types, each once.
template <class Variant, class... Types>
struct VariantOf {
  using type = Variant;
};
template <class... Held, class First, class... Rest>
struct VariantOf<std::variant<Held...>, First, Rest...>
    : VariantOf<
          std::conditional_t<(std::is_same_v<Held, First> || ...), std::variant<Held...>, std::variant<Held..., First>>,
          Rest...> {};

template <class... Memory>
auto memory_of(const std::tuple<PolicyRow<Memory>...>&) -> typename VariantOf<std::variant<>, Memory...>::type;

/// What a policy remembers from cycle to cycle. A new possession starts it afresh, but for a drive's progress; so does
/// a policy that remembers something else.
using PolicyMemory = decltype(memory_of(kPolicyRows));

/// Fire or hold? A pure function of its arguments but for the policy's own memory, which it brings up to date; nothing
/// allocates. A policy that is not in charge is judged by the same function with a memory of its own. It never fires
/// when the game stands, the ball is not held, the kicker is not ready, the state is older than max_state_age_s or not
/// finite, no set-point reaches the target height (but for kStandingDrive, which kicks for the laser, and the
/// predictive ones, which choose their height: where full power falls short of the line), or an order of this
/// possession is pending.
PolicyOutput evaluate(PolicyName policy, const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                      const PolicyInput& input, PolicyMemory& memory);

}  // namespace trivela::kicking
