#include "robot/decision/decision_message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <type_traits>

#include "hal/kicker.hpp"
#include "kicking/outcome/outcome.hpp"
#include "sim/truth.hpp"

namespace trivela::robot {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(WireEnums, CarryTheAlgorithmsLabels) {
  using kicking::PolicyName;
  using kicking::Reason;
  std::vector<std::string> labels;
  for (const auto& policy : bus::enumeration<msg::Policy>::enumerators) {
    EXPECT_EQ(std::size_t{policy.value}, labels.size()) << policy.label;
    labels.emplace_back(policy.label);
  }
  std::vector<std::string> names(kicking::kPolicyNames.begin(), kicking::kPolicyNames.end());
  names.emplace_back("own");
  EXPECT_EQ(names, labels) << "rows of kicking/policy/policy.hpp against labels of idl/kick.idl";
  EXPECT_EQ(to_wire(PolicyName::kMoving), msg::POLICY_MOVING);
  for (const auto& reason : bus::enumeration<msg::DecisionReason>::enumerators) {
    const auto ours = static_cast<Reason>(reason.value);
    EXPECT_EQ(to_wire(ours), reason.value);
    EXPECT_STREQ(kicking::name(ours), bus::label(to_wire(ours)));
  }
  EXPECT_EQ(bus::enumeration<msg::DecisionReason>::enumerators.size(), static_cast<std::size_t>(Reason::kOwnHalf) + 1);
  for (const auto& outcome : bus::enumeration<msg::Outcome>::enumerators) {
    EXPECT_STREQ(kicking::name(static_cast<kicking::Outcome>(outcome.value)), outcome.label);
  }
  EXPECT_EQ(bus::enumeration<msg::Outcome>::enumerators.size(),
            static_cast<std::size_t>(kicking::Outcome::kUnknown) + 1);
}

TEST(WireEnums, CarryTheDevicesAndTheSimulatorsLists) {
  EXPECT_EQ(msg::FAULT_CHARGER, static_cast<msg::KickerFault>(hal::KickerFault::kCharger));
  EXPECT_EQ(msg::FAULT_COIL, static_cast<msg::KickerFault>(hal::KickerFault::kCoil));
  EXPECT_EQ(msg::FAULT_LINK, static_cast<msg::KickerFault>(hal::KickerFault::kLink));
  EXPECT_EQ(bus::enumeration<msg::KickerFault>::enumerators.size(),
            static_cast<std::size_t>(hal::KickerFault::kLink) + 1);
  EXPECT_EQ(msg::POSSESSION_KICKED, static_cast<msg::PossessionEnd>(sim::PossessionEnd::kKicked));
  EXPECT_EQ(msg::POSSESSION_DISPUTED, static_cast<msg::PossessionEnd>(sim::PossessionEnd::kDisputed));
  EXPECT_EQ(msg::POSSESSION_TIMED_OUT, static_cast<msg::PossessionEnd>(sim::PossessionEnd::kTimedOut));
}

msg::WorldState world() {
  msg::WorldState out{};
  out.t_ns = 5'000'000'000;
  out.half = 2;
  out.playing = out.possession = true;
  out.possession_id = 9;
  out.x_m = 1.0;
  out.y_m = 2.0;
  out.heading_rad = 0.3;
  out.vx_mps = 0.4;
  out.vy_mps = 0.5;
  out.omega_radps = 0.6;
  out.opponent_distance_m = kNaN;
  return out;
}

TEST(PolicyInput, TellsThePoliciesWhatTheMessagesSay) {
  msg::KickerStatus kicker{};
  kicker.t_ns = 4'900'000'000;
  kicker.ready = true;
  auto state = world();
  auto input = policy_input(state, &kicker);
  EXPECT_EQ(input.t_ns, state.t_ns);
  EXPECT_EQ(input.pose.x_m, 1.0);
  EXPECT_EQ(input.pose.y_m, 2.0);
  EXPECT_EQ(input.pose.heading_rad, 0.3);
  EXPECT_EQ(input.twist.vx_mps, 0.4);
  EXPECT_EQ(input.twist.vy_mps, 0.5);
  EXPECT_EQ(input.twist.omega_radps, 0.6);
  EXPECT_TRUE(input.playing && input.possession && input.kicker_ready);
  EXPECT_EQ(input.possession_id, 9u);
  EXPECT_NEAR(input.state_age_s, 0.1, 1e-12);
  EXPECT_FALSE(input.opponent_distance_m);
  kicker.t_ns = 5'100'000'000;
  state.opponent_distance_m = 1.5;
  input = policy_input(state, &kicker);
  EXPECT_NEAR(input.state_age_s, 0.1, 1e-12) << "whichever of the two is older";
  EXPECT_EQ(input.opponent_distance_m, 1.5);
}

TEST(PolicyInput, HasAKeeperWhereOneIsTracked) {
  auto state = world();
  EXPECT_FALSE(policy_input(state, nullptr).keeper) << "a message that says nothing of one";
  state.keeper_x_m = kNaN;
  state.keeper_sd_m = kNaN;
  EXPECT_FALSE(policy_input(state, nullptr).keeper);
  state.keeper_x_m = -0.2;
  state.keeper_sd_m = 0.1;
  const auto keeper = policy_input(state, nullptr).keeper;
  ASSERT_TRUE(keeper);
  EXPECT_EQ(keeper->x_m, -0.2);
  EXPECT_EQ(keeper->sd_m, 0.1);
}

TEST(PolicyInput, WithoutAStatusTheKickerIsNotReady) { EXPECT_FALSE(policy_input(world(), nullptr).kicker_ready); }

double number_of(bool value) { return value; }
double number_of(double value) { return value; }
double number_of(std::uint8_t value) { return value; }
double number_of(const std::optional<double>& value) { return *value; }
double number_of(kicking::Reason reason) { return to_wire(reason); }

/// Every part is there, each with a number of its own.
kicking::PolicyOutput whole_output() {
  kicking::PolicyOutput j;
  double next = 100.0;
  const auto set = [&]<class Of, class Part>(Part Of::*part) {
    if constexpr (std::is_same_v<Part, bool>) j.*part = true;
    if constexpr (std::is_same_v<Part, kicking::Reason>) j.*part = kicking::Reason::kWaiting;
    if constexpr (std::is_convertible_v<double, Part> && !std::is_same_v<Part, bool>) j.*part = ++next;
  };
  const auto set_member = [&](auto get) {
    if constexpr (std::is_member_object_pointer_v<decltype(get)>) set(get);
  };
  std::apply([&](const auto&... field) { (set_member(field.get), ...); }, kicking::kRecordedFields);
  j.predicted = kicking::PredictedCrossing{};
  j.predicted->x_m = ++next;
  j.predicted->z_m = ++next;
  j.predicted->t_flight_s = ++next;
  return j;
}

/// The numbers of a message by the names of their fields.
template <class Message>
std::map<std::string_view, double> numbers_of(const Message& message) {
  std::map<std::string_view, double> numbers;
  bus::visit_fields(message, [&](std::string_view name, std::string_view, const auto& field) {
    using Field = std::remove_cvref_t<decltype(field)>;
    if constexpr (std::is_arithmetic_v<Field> || std::is_enum_v<Field>) numbers[name] = double(field);
  });
  return numbers;
}

std::map<std::string_view, double> numbers_of(const kicking::PolicyOutput& output) {
  std::map<std::string_view, double> numbers;
  const auto add = [&](const auto& field) { numbers[field.name] = number_of(std::invoke(field.get, output)); };
  std::apply([&](const auto&... field) { (add(field), ...); }, kicking::kRecordedFields);
  return numbers;
}

TEST(DecisionMessage, HasEveryNumberOfTheJudgement) {
  const kicking::PolicyOutput output = whole_output();
  msg::KickerStatus kicker{};
  kicker.charge = 0.75;
  auto state = world();
  state.opponent_distance_m = 1.5;
  const auto numbers = numbers_of(decision_message(state, &kicker, kicking::PolicyName::kMoving, output));
  for (const auto& [name, number] : numbers_of(output)) EXPECT_EQ(numbers.at(name), number) << name;
  for (const auto& [name, number] : numbers_of(state)) {
    const bool of_the_node = name == "robot_id" || name == "seq";
    if (!numbers.contains(name) || of_the_node) continue;
    EXPECT_EQ(numbers.at(name), number) << name;
  }
  EXPECT_EQ(numbers.at("policy"), msg::POLICY_MOVING);
  EXPECT_EQ(numbers.at("charge"), 0.75);
  for (const auto& [name, number] : numbers) {
    const bool of_the_node =
        name == "robot_id" || name == "seq" || name == "kick_id" || name == "shadow_count" || name == "estimate";
    EXPECT_EQ(number == 0.0, of_the_node) << name << ": who fills it?";
  }
}

TEST(DecisionMessage, AShadowHasWhatItsFieldsSayOfTheJudgement) {
  const kicking::PolicyOutput output = whole_output();
  const auto of_output = numbers_of(output);
  for (const auto& [name, number] : numbers_of(shadow_message(kicking::PolicyName::kMoving, output))) {
    EXPECT_EQ(number, name == "policy" ? double{msg::POLICY_MOVING} : of_output.at(name)) << name;
  }
}

TEST(DecisionMessage, WhatIsMissingIsNaN) {
  const auto out = decision_message(world(), nullptr, kicking::PolicyName::kStopped, {});
  for (const double number : {out.v0_mps, out.v_kick_mps, out.power, out.offset_right_m, out.predicted_x_cross_m,
                              out.predicted_z_cross_m, out.predicted_t_flight_s})
    EXPECT_TRUE(std::isnan(number));
  EXPECT_EQ(out.kick_id, 0);
  EXPECT_EQ(out.charge, 0.0);
  const auto shadow = shadow_message(kicking::PolicyName::kStopped, {});
  for (const double number : {shadow.power, shadow.v_kick_mps, shadow.offset_right_m}) EXPECT_TRUE(std::isnan(number));
}

}  // namespace
}  // namespace trivela::robot
