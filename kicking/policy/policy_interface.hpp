#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <typeinfo>
#include <vector>

#include "kicking/policy/rule.hpp"
#include "kicking/range.hpp"

namespace trivela::kicking {

/// kPlay: aims by the configured laws. kPredictive: weighs probabilities and aims by its own. kDrive: calibrates a
/// robot and is no policy of play; its memory outlives the possession.
enum class PolicyKind { kPlay, kPredictive, kDrive };

/// What a policy has to be given besides a robot's own belief: a learned model, the simulator's true state, or the
/// program that has its rule, which this one has not.
enum class PolicyNeeds { kNothing, kModel, kTruth, kProgram };

/// What others need to know of a policy.
struct PolicyFacts {
  const char* name;  ///< in files, flags and logs, and the wire's label
  PolicyKind kind;
  PolicyNeeds needs = PolicyNeeds::kNothing;
  bool rides_along = false;     ///< judged as a shadow while another one is in charge; the wire and the log have four
  bool reads_opponents = true;  ///< PolicyInput::opponents; a simulated robot tracks none for those that do not

  constexpr bool plays() const { return kind != PolicyKind::kDrive; }
  constexpr bool needs_truth() const { return needs == PolicyNeeds::kTruth; }
  constexpr bool needs_model() const { return needs == PolicyNeeds::kModel; }
  constexpr bool needs_program() const { return needs == PolicyNeeds::kProgram; }
};

/// A number of a policy from outside that a file may set: `key` in [policy.own.NAME].
struct PolicySetting {
  std::string key;
  double usual = 0.0;
  Range range{};
};

inline constexpr std::size_t kNoPlace = static_cast<std::size_t>(-1);

/// A policy: its name, its settings and its rule. It knows nothing but its arguments and its memory, and is asked in
/// each cycle in which something may be decided. A policy of your own derives from PolicyOf.
class Policy {
 public:
  Policy(const Policy&) = delete;
  Policy& operator=(const Policy&) = delete;
  virtual ~Policy() = default;

  const PolicyFacts& facts() const { return facts_; }
  std::span<const PolicySetting> settings() const { return settings_; }
  /// Of its settings in PolicyConfig::own; kNoPlace: it is a row of kPolicyRows.
  std::size_t place() const { return place_; }
  /// What tells its rule from a changed one: an experiment that was begun with one does not go on with the other.
  /// Empty: the program does, with the libraries that it has loaded.
  virtual std::string code() const { return {}; }

  virtual std::unique_ptr<PossessionMemory> new_memory() const = 0;
  virtual std::unique_ptr<PossessionMemory> copy(const PossessionMemory& memory) const = 0;
  /// Whether it is a memory of this policy's type.
  virtual bool remembers(const PossessionMemory& memory) const = 0;
  /// As fresh.
  virtual void clear(PossessionMemory& memory) const = 0;
  virtual PolicyOutput ask(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                           const PolicyInput& input, PossessionMemory& memory) const = 0;

 protected:
  explicit Policy(const PolicyFacts& facts) : facts_(facts) {}
  explicit Policy(std::string name)
      : name_(std::move(name)), facts_{.name = name_.c_str(), .kind = PolicyKind::kPlay} {}
  Policy(std::string name, PolicyNeeds needs) : Policy(std::move(name)) { facts_.needs = needs; }

  /// One of its settings, as the configuration has it.
  class Setting {
   public:
    Setting(const Policy& policy, std::size_t place) : policy_(policy), place_(place) {}
    double of(const PolicyConfig& config) const {
      const auto& own = config.own;
      return policy_.place_ < own.size() && place_ < own[policy_.place_].size() ? own[policy_.place_][place_]
                                                                                : policy_.settings_[place_].usual;
    }

   private:
    const Policy& policy_;
    std::size_t place_;
  };

  Setting setting(std::string key, double usual, Range range) {
    settings_.push_back({std::move(key), usual, range});
    return {*this, settings_.size() - 1};
  }

 private:
  friend class PolicyRegistry;

  std::string name_;
  PolicyFacts facts_;
  std::vector<PolicySetting> settings_;
  std::size_t place_ = kNoPlace;  // in PolicyConfig::own
};

/// A policy whose memory is of this type: derived from PossessionMemory, and copied like a value.
template <class Memory>
class PolicyOf : public Policy {
 public:
  using Policy::Policy;

  std::unique_ptr<PossessionMemory> new_memory() const final { return std::make_unique<Memory>(); }
  std::unique_ptr<PossessionMemory> copy(const PossessionMemory& memory) const final {
    return std::make_unique<Memory>(static_cast<const Memory&>(memory));
  }
  bool remembers(const PossessionMemory& memory) const final { return typeid(memory) == typeid(Memory); }
  void clear(PossessionMemory& memory) const final { static_cast<Memory&>(memory) = Memory{}; }
  PolicyOutput ask(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input,
                   PossessionMemory& memory) const final {
    return evaluate(config, robot, goal, input, static_cast<Memory&>(memory));
  }

  /// Fire or hold? Reason kFire: it would kick now, the kicker and an order on its way aside. `drive` is the command to
  /// the base. A pure function but for the memory. It must not allocate: it is asked 50 times a second.
  virtual PolicyOutput evaluate(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                                const PolicyInput& input, Memory& memory) const = 0;
};

}  // namespace trivela::kicking
