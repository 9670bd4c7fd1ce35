#include <algorithm>
#include <array>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "kicking/policy/policy.hpp"

namespace trivela::kicking {
namespace {

/// A policy whose rule is a function.
template <class Memory>
class RulePolicy final : public PolicyOf<Memory> {
 public:
  explicit RulePolicy(const PolicyRow<Memory>& row) : PolicyOf<Memory>(row.facts), rule_(row.evaluate) {}

  PolicyOutput evaluate(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input,
                        Memory& memory) const override {
    return rule_(config, robot, goal, input, memory);
  }

 private:
  Rule<Memory>* rule_;
};

/// "all" is every policy in gates, "own" any policy from outside on the bus.
constexpr std::array<std::string_view, 2> kReserved{"all", "own"};

void check_name(const std::string& called, const std::string& name) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  const bool right =
      !name.empty() && name.size() <= 31 && name[0] >= 'a' && name[0] <= 'z' && std::ranges::all_of(name, fits);
  if (!right) throw std::invalid_argument(called + " \"" + name + "\": 1 to 31 of a-z, 0-9 and _, a letter first");
}

void check_settings(const Policy& policy) {
  const std::string of = "policy " + std::string{policy.facts().name} + ": setting ";
  for (const PolicySetting& setting : policy.settings()) {
    check_name(of, setting.key);
    if (std::ranges::count(policy.settings(), setting.key, &PolicySetting::key) > 1)
      throw std::invalid_argument(of + setting.key + " stands twice");
    if (!setting.range.contains(setting.usual))
      throw std::invalid_argument(of + setting.key + ": its usual value is not in its range");
  }
}

}  // namespace

/// Stands for the policy of another program.
class DeclaredPolicy final : public PolicyOf<PossessionMemory> {
 public:
  explicit DeclaredPolicy(const std::string& name) : PolicyOf(name, PolicyNeeds::kProgram) {}

  void add(const std::string& key) {
    const auto has = [&](const PolicySetting& setting) { return setting.key == key; };
    if (std::ranges::none_of(settings(), has)) setting(key, 0.0, {-1e300, 1e300});
  }

  PolicyOutput evaluate(const PolicyConfig&, const RobotModel&, const Goal&, const PolicyInput&,
                        PossessionMemory&) const override {
    throw std::logic_error("the policy " + std::string{facts().name} + " is another program's");
  }
};

/// Filled when it is first asked for; grows only before anything is played.
class PolicyRegistry {
 public:
  static PolicyRegistry& of_program() {
    static PolicyRegistry registry;
    return registry;
  }

  std::span<const Policy* const> all() const { return all_; }
  const Policy* find(std::string_view name) const {
    const auto found = std::ranges::find_if(all_, [&](const Policy* policy) { return name == policy->facts().name; });
    return found == all_.end() ? nullptr : *found;
  }

  PolicyName add(std::unique_ptr<Policy> policy) {
    if (!policy) throw std::invalid_argument("register_policy() got no policy");
    check_name("policy", policy->facts().name);
    if (find(policy->facts().name) != nullptr ||
        std::ranges::count(kReserved, std::string_view{policy->facts().name}) > 0)
      throw std::invalid_argument("policy \"" + std::string{policy->facts().name} + "\": the name is taken");
    check_settings(*policy);
    policy->place_ = all_.size() - kPolicyCount;
    return append(std::move(policy));
  }

  void declare(const std::string& name, const std::vector<std::string>& keys) {
    const Policy* known = find(name);
    if (known == nullptr) {
      auto made = std::make_unique<DeclaredPolicy>(name);
      known = made.get();
      add(std::move(made));
    }
    const auto same =
        std::ranges::find(declared_, known, [](DeclaredPolicy* policy) -> const Policy* { return policy; });
    if (same == declared_.end()) return;  // this program has it
    for (const std::string& key : keys) {
      check_name("policy " + name + ": setting", key);
      (*same)->add(key);
    }
  }

 private:
  PolicyRegistry() {
    std::apply(
        [this](const auto&... row) {
          (append(std::make_unique<RulePolicy<typename std::remove_cvref_t<decltype(row)>::Remembered>>(row)), ...);
        },
        kPolicyRows);
  }

  PolicyName append(std::unique_ptr<Policy> policy) {
    if (auto* const declared = dynamic_cast<DeclaredPolicy*>(policy.get())) declared_.push_back(declared);
    all_.push_back(policy.get());
    owned_.push_back(std::move(policy));
    return static_cast<PolicyName>(all_.size() - 1);
  }

  std::vector<const Policy*> all_;
  std::vector<DeclaredPolicy*> declared_;
  std::vector<std::unique_ptr<Policy>> owned_;
};

std::span<const Policy* const> policies() { return PolicyRegistry::of_program().all(); }

PolicyName register_policy(std::unique_ptr<Policy> policy) {
  return PolicyRegistry::of_program().add(std::move(policy));
}

void declare_policy(const std::string& name, const std::vector<std::string>& keys) {
  PolicyRegistry::of_program().declare(name, keys);
}

void complete_own_settings(std::vector<std::vector<double>>& own) {
  const auto outside = policies().subspan(kPolicyCount);
  own.resize(outside.size());
  for (std::size_t i = 0; i < outside.size(); ++i) {
    const auto settings = outside[i]->settings();
    for (std::size_t k = own[i].size(); k < settings.size(); ++k) own[i].push_back(settings[k].usual);
  }
}

const PolicyFacts& facts(PolicyName policy) { return policies()[static_cast<std::size_t>(policy)]->facts(); }

std::optional<PolicyName> policy_named(std::string_view name) {
  const auto all = policies();
  const auto found = std::ranges::find_if(all, [&](const Policy* policy) { return name == policy->facts().name; });
  if (found == all.end()) return std::nullopt;
  return static_cast<PolicyName>(found - all.begin());
}

}  // namespace trivela::kicking
