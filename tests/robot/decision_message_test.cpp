#include "robot/decision/decision_message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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
  EXPECT_THAT(kicking::policies_where([](const auto&) { return true; }), testing::ElementsAreArray(labels))
      << "rows of kicking/policy/policy.hpp against labels of idl/kick.idl";
  EXPECT_EQ(to_wire(PolicyName::kMoving), msg::POLICY_MOVING);
  for (const auto& reason : bus::enumeration<msg::DecisionReason>::enumerators) {
    const auto ours = static_cast<Reason>(reason.value);
    EXPECT_EQ(to_wire(ours), reason.value);
    EXPECT_STREQ(kicking::name(ours), bus::label(to_wire(ours)));
  }
  EXPECT_EQ(bus::enumeration<msg::DecisionReason>::enumerators.size(), static_cast<std::size_t>(Reason::kWaiting) + 1);
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

TEST(PolicyInput, WithoutAStatusTheKickerIsNotReady) { EXPECT_FALSE(policy_input(world(), nullptr).kicker_ready); }

TEST(DecisionMessage, HasEveryNumberOfTheJudgement) {
  kicking::Judgement j;
  j.fire = true;
  j.reason = kicking::Reason::kFire;
  j.target_x_m = 1;
  j.target_y_m = 2;
  j.target_z_m = 3;
  j.distance_m = 4;
  j.v0_mps = 5;
  j.v_kick_mps = 6;
  j.power = 7;
  j.alpha_rad = 8;
  j.beta_rad = 9;
  j.aligned = true;
  j.offset_right_m = 10;
  j.left_m = 11;
  j.right_m = 12;
  j.predicted = kicking::Crossing{};
  j.predicted->x_m = 13;
  j.predicted->z_m = 14;
  j.predicted->t_flight_s = 15;
  msg::KickerStatus kicker{};
  kicker.charge = 0.75;
  const auto out = decision_message(world(), &kicker, kicking::PolicyName::kMoving, j);
  EXPECT_EQ(out.t_ns, 5'000'000'000);
  EXPECT_EQ(out.half, 2);
  EXPECT_EQ(out.possession_id, 9u);
  EXPECT_EQ(out.policy, msg::POLICY_MOVING);
  EXPECT_TRUE(out.fire);
  EXPECT_EQ(out.reason, msg::REASON_FIRE);
  EXPECT_EQ(out.x_m, 1.0);
  EXPECT_EQ(out.omega_radps, 0.6);
  const double numbers[] = {out.target_x_m,
                            out.target_y_m,
                            out.target_z_m,
                            out.distance_m,
                            out.v0_mps,
                            out.v_kick_mps,
                            out.power,
                            out.alpha_rad,
                            out.beta_rad,
                            out.offset_right_m,
                            out.left_m,
                            out.right_m,
                            out.predicted_x_cross_m,
                            out.predicted_z_cross_m,
                            out.predicted_t_flight_s};
  for (int i = 0; i < 15; ++i) EXPECT_EQ(numbers[i], i + 1);
  EXPECT_TRUE(out.aligned);
  EXPECT_EQ(out.charge, 0.75);
  EXPECT_TRUE(std::isnan(out.opponent_distance_m));
  EXPECT_EQ(out.shadow_count, 0);
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
