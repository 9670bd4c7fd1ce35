#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "kicking/policy/policy.hpp"

namespace trivela::kicking {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

struct CountingMemory : PossessionMemory {
  int cycles = 0;
  int interrupted = 0;

  void interrupt() override { ++interrupted; }
};

/// Fires always; aims so far to the right as its settings say.
class Eager final : public PolicyOf<CountingMemory> {
 public:
  explicit Eager(const std::string& name) : PolicyOf(name) {}

  PolicyOutput evaluate(const PolicyConfig& config, const RobotModel&, const Goal&, const PolicyInput&,
                        CountingMemory& memory) const override {
    ++memory.cycles;
    PolicyOutput output;
    output.target_x_m = right_m_.of(config);
    output.power = 20.0;
    output.reason = Reason::kFire;
    return output;
  }

 private:
  const Setting right_m_ = setting("right_m", 0.25, {-1.0, 1.0});
};

/// With settings that cannot be.
class Wrong final : public PolicyOf<PossessionMemory> {
 public:
  Wrong(const std::vector<PolicySetting>& settings, const std::string& name) : PolicyOf(name) {
    for (const PolicySetting& one : settings) setting(one.key, one.usual, one.range);
  }
  PolicyOutput evaluate(const PolicyConfig&, const RobotModel&, const Goal&, const PolicyInput&,
                        PossessionMemory&) const override {
    return {};
  }
};

PolicyName eager() {
  static const PolicyName name = register_policy(std::make_unique<Eager>("eager"));
  return name;
}

PolicyInput ready() {
  PolicyInput input;
  input.pose = {0.0, 4.0, 0.0};
  input.playing = input.possession = input.kicker_ready = true;
  input.possession_id = 1;
  return input;
}

auto refused(const std::string& why) { return ThrowsMessage<std::invalid_argument>(HasSubstr(why)); }

TEST(OwnPolicy, IsKnownByItsNameBehindTheRows) {
  const PolicyName registered = eager();
  EXPECT_EQ(policy_named("eager"), registered);
  EXPECT_TRUE(from_outside(eager()));
  EXPECT_STREQ(name(eager()), "eager");
  EXPECT_TRUE(facts(eager()).plays());
  EXPECT_FALSE(from_outside(PolicyName::kOracle));
}

TEST(OwnPolicy, FiresWithinWhatHoldsForEveryPolicy) {
  PolicyMemory memory(eager());
  EXPECT_TRUE(evaluate(eager(), {}, {}, {}, ready(), memory).fire);
  EXPECT_EQ(evaluate(eager(), {}, {}, {}, ready(), memory).reason, Reason::kOrderPending);
  PolicyInput stopped = ready();
  stopped.playing = false;
  EXPECT_EQ(evaluate(eager(), {}, {}, {}, stopped, memory).reason, Reason::kNotPlaying);
  EXPECT_EQ(memory.as<CountingMemory>().cycles, 2) << "it is not asked while the game stands";
  EXPECT_EQ(memory.as<CountingMemory>().interrupted, 1);
  PolicyInput charging = ready();
  charging.possession_id = 2;
  charging.kicker_ready = false;
  EXPECT_EQ(evaluate(eager(), {}, {}, {}, charging, memory).reason, Reason::kKickerNotReady);
  EXPECT_EQ(memory.as<CountingMemory>().cycles, 1) << "a new possession starts it afresh";
}

/// Fires with what its test gave it.
struct Nonsense final : PolicyOf<PossessionMemory> {
  Nonsense() : PolicyOf("nonsense") {}
  PolicyOutput evaluate(const PolicyConfig&, const RobotModel&, const Goal&, const PolicyInput&,
                        PossessionMemory&) const override {
    return given;
  }
  inline static PolicyOutput given;
};

TEST(OwnPolicy, ThatReturnsNonsenseNeitherKicksNorDrives) {
  const PolicyName nonsense = register_policy(std::make_unique<Nonsense>());
  const auto said = [&](auto&& spoil) {
    Nonsense::given = {};
    Nonsense::given.reason = Reason::kFire;
    Nonsense::given.power = 20.0;
    Nonsense::given.drive.vy_mps = 1.0;
    spoil(Nonsense::given);
    PolicyMemory memory;
    return evaluate(nonsense, {}, {}, {}, ready(), memory);
  };
  EXPECT_TRUE(said([](PolicyOutput&) {}).fire);
  EXPECT_EQ(said([](PolicyOutput& out) { out.power = std::nullopt; }).reason, Reason::kOutOfRange);
  EXPECT_EQ(said([](PolicyOutput& out) { out.power = std::numeric_limits<double>::infinity(); }).reason,
            Reason::kOutOfRange);
  EXPECT_EQ(said([](PolicyOutput& out) { out.kick_kind = 200; }).reason, Reason::kOutOfRange);
  for (const double after_s : {1e9, -3.0})
    EXPECT_EQ(said([&](PolicyOutput& out) { out.fire_after_s = after_s; }).reason, Reason::kOutOfRange);
  for (OptionalDouble PolicyOutput::*p : {&PolicyOutput::p_on_target, &PolicyOutput::p_goal})
    EXPECT_FALSE(said([&](PolicyOutput& out) { out.*p = 9.0; }).*p);
  for (double PolicyOutput::*number :
       {&PolicyOutput::target_x_m, &PolicyOutput::target_y_m, &PolicyOutput::target_z_m, &PolicyOutput::alpha_rad,
        &PolicyOutput::beta_rad, &PolicyOutput::fire_after_s}) {
    const PolicyOutput output = said([&](PolicyOutput& out) { out.*number = NAN; });
    EXPECT_EQ(output.reason, Reason::kOutOfRange);
    EXPECT_EQ(output.*number, 0.0) << "the log needs a number";
  }
  EXPECT_EQ(said([](PolicyOutput& out) { out.reason = static_cast<Reason>(99); }).reason, Reason::kWaiting);
  const PolicyOutput fast = said([](PolicyOutput& out) { out.drive = {-1e9, 1e9, 1e9}; });
  EXPECT_EQ(fast.drive.vx_mps, -PolicyConfig{}.max_forward_mps);
  EXPECT_EQ(fast.drive.vy_mps, PolicyConfig{}.max_forward_mps);
  EXPECT_EQ(fast.drive.omega_radps, PolicyConfig{}.max_turn_rate_radps);
  EXPECT_EQ(said([](PolicyOutput& out) { out.lever_kind = 200; }).lever_kind, 0);
  for (double Twist::*part : {&Twist::vx_mps, &Twist::vy_mps, &Twist::omega_radps}) {
    const PolicyOutput output = said([&](PolicyOutput& out) { out.drive.*part = NAN; });
    EXPECT_EQ(output.drive.vy_mps, 0.0);
    EXPECT_TRUE(output.fire);
  }
}

TEST(OwnPolicy, ThatThrowsIsNamedAndItsExceptionKept) {
  struct Throwing final : PolicyOf<PossessionMemory> {
    Throwing() : PolicyOf("throwing") {}
    PolicyOutput evaluate(const PolicyConfig&, const RobotModel&, const Goal& goal, const PolicyInput&,
                          PossessionMemory&) const override {
      if (goal.y_m < 0.0) throw 42;
      throw std::out_of_range("no such corner");
    }
  };
  const PolicyName throwing = register_policy(std::make_unique<Throwing>());
  PolicyMemory memory;
  try {
    evaluate(throwing, {}, {}, {}, ready(), memory);
    FAIL() << "it must throw";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "policy throwing: no such corner");
    EXPECT_THROW(std::rethrow_if_nested(error), std::out_of_range);
  }
  EXPECT_THAT([&] { evaluate(throwing, {}, {}, {.y_m = -1.0}, ready(), memory); },
              ThrowsMessage<std::runtime_error>(HasSubstr("policy throwing: threw something else than an exception")));
}

TEST(OwnPolicy, AMemoryIsCopiedWithWhatItHolds) {
  PolicyMemory memory;
  evaluate(eager(), {}, {}, {}, ready(), memory);
  PolicyMemory copy = memory;
  evaluate(eager(), {}, {}, {}, ready(), copy);
  EXPECT_EQ(memory.as<CountingMemory>().cycles, 1);
  EXPECT_EQ(copy.as<CountingMemory>().cycles, 2);
  evaluate(PolicyName::kMoving, {}, {}, {}, ready(), copy);
  EXPECT_THROW(copy.as<CountingMemory>(), std::bad_cast) << "another policy remembers something else";
}

TEST(OwnPolicy, ASettingIsTheConfigurationsOrTheUsualOne) {
  PolicyMemory memory;
  PolicyConfig config;
  EXPECT_EQ(evaluate(eager(), config, {}, {}, ready(), memory).target_x_m, 0.25);
  complete_own_settings(config.own);
  ASSERT_EQ(config.own.at(static_cast<std::size_t>(eager()) - kPolicyCount).size(), 1u);
  config.own[static_cast<std::size_t>(eager()) - kPolicyCount][0] = -0.5;
  EXPECT_EQ(evaluate(eager(), config, {}, {}, ready(), memory).target_x_m, -0.5);
}

TEST(OwnPolicy, IsRefusedWithANameOrSettingsThatCannotBe) {
  eager();
  for (const char* const name : {"", "Eager", "1st", "with space", "a_name_of_more_than_31_characters"})
    EXPECT_THAT([&] { register_policy(std::make_unique<Eager>(name)); }, refused("1 to 31 of a-z, 0-9 and _")) << name;
  for (const char* const taken : {"eager", "moving", "oracle", "all", "own"})
    EXPECT_THAT([&] { register_policy(std::make_unique<Eager>(taken)); }, refused("the name is taken")) << taken;
  const auto with = [](const std::vector<PolicySetting>& settings) {
    return [settings] { register_policy(std::make_unique<Wrong>(settings, "wrong")); };
  };
  EXPECT_THAT(with({{"x", 0.0, {0.0, 1.0}}, {"x", 0.0, {0.0, 1.0}}}), refused("setting x stands twice"));
  EXPECT_THAT(with({{"x", 2.0, {0.0, 1.0}}}), refused("its usual value is not in its range"));
  EXPECT_THAT(with({{"X", 0.0, {0.0, 1.0}}}), refused("\"X\": 1 to 31"));
  EXPECT_FALSE(policy_named("wrong"));
}

TEST(OwnPolicy, OfAnotherProgramIsKnownAndNotPlayed) {
  declare_policy("elsewhere", {"a"});
  declare_policy("elsewhere", {"a", "b"});
  const PolicyName elsewhere = policy_named("elsewhere").value();
  EXPECT_TRUE(facts(elsewhere).needs_program());
  EXPECT_EQ(policies()[static_cast<std::size_t>(elsewhere)]->settings().size(), 2u);
  PolicyMemory memory;
  EXPECT_THROW(evaluate(elsewhere, {}, {}, {}, ready(), memory), std::logic_error);
  eager();
  declare_policy("eager", {"no_key_of_it"});
  EXPECT_EQ(policies()[static_cast<std::size_t>(eager())]->settings().size(), 1u) << "this program has it";
}

}  // namespace
}  // namespace trivela::kicking
