#include "idl/messages.hpp"

#include <gmock/gmock.h>

#include <cstring>
#include <string>
#include <vector>

namespace trivela::bus {
namespace {

/// The names of T's fields in the order of the IDL.
template <Struct T>
constexpr auto field_names() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<std::string_view, sizeof...(I)>{meta<T>::fields[I].name...};
  }
  (std::make_index_sequence<meta<T>::fields.size()>{});
}

using ::testing::Contains;
using ::testing::ElementsAre;

TEST(Messages, NameTopicAndProfileComeFromTheIdl) {
  EXPECT_EQ(meta<msg::Odometry>::name, "Odometry");
  EXPECT_EQ(meta<msg::Odometry>::topic, "odometry");
  EXPECT_EQ(meta<msg::Odometry>::profile, Profile::kState);
  EXPECT_EQ(meta<msg::KickOrder>::profile, Profile::kOrder);
  EXPECT_EQ(meta<msg::KickDecision>::profile, Profile::kEvent);
  EXPECT_EQ(meta<msg::DeviceFire>::topic, "device/fire");
}

TEST(Messages, WritersComeFromTheIdl) {
  EXPECT_THAT(meta<msg::Odometry>::writers, ElementsAre("odometry"));
  EXPECT_THAT(meta<msg::KickOrder>::writers, ElementsAre("kick_decision", "kick_decision_second"));
}

TEST(Messages, TheDescriptorIsTheTypesOwn) {
  EXPECT_STREQ(meta<msg::KickReceipt>::descriptor().m_typename, "trivela::msg::KickReceipt");
  EXPECT_EQ(meta<msg::KickReceipt>::descriptor().m_size, sizeof(msg::KickReceipt));
}

TEST(Messages, ANestedStructHasFieldsButNoTopic) {
  static_assert(Struct<msg::ShadowDecision> && !Message<msg::ShadowDecision>);
  static_assert(Message<msg::KickDecision>);
  EXPECT_EQ(field_names<msg::ShadowDecision>().front(), "policy");
}

TEST(Messages, FieldNamesAreKnownAtCompileTimeInTheOrderOfTheIdl) {
  constexpr auto names = field_names<msg::KickOrder>();
  static_assert(names.size() == 9);
  EXPECT_THAT(names, ElementsAre("robot_id", "seq", "t_ns", "kick_id", "power", "fire_t_ns", "valid_until_t_ns",
                                 "possession", "kick_kind"));
}

TEST(Messages, KeysAreMarked) {
  static_assert(meta<msg::StepDone>::fields[0].key && meta<msg::StepDone>::fields[1].key);
  static_assert(!meta<msg::StepDone>::fields[2].key);
}

// What a recorder does with a message it has no code for.
struct Text {
  std::string out;

  template <class T>
  void operator()(std::string_view name, std::string_view unit, const T& value) {
    out += name;
    if (!unit.empty()) out.append("[").append(unit).append("]");
    out += "=";
    print(value);
    out += ";";
  }
  template <class T>
  void print(const T& value) {
    if constexpr (Enumeration<T>) {
      out += label(value);
    } else if constexpr (std::is_array_v<T>) {
      for (const auto& element : value) print(element), out += ",";
    } else if constexpr (Struct<T>) {
      out += "{";
      visit_fields(value, *this);
      out += "}";
    } else {
      out += std::to_string(value);
    }
  }
};

TEST(Messages, TheVisitorSeesNamesUnitsAndValuesInOrder) {
  const msg::DriveCommand drive{
      .robot_id = 3, .seq = 4, .t_ns = 5, .vx_mps = 1, .vy_mps = 2, .omega_radps = -1, .lever_kind = 1};
  Text text;
  visit_fields(drive, text);
  EXPECT_EQ(
      text.out,
      "robot_id=3;seq=4;t_ns=5;vx_mps[m/s]=1.000000;vy_mps[m/s]=2.000000;omega_radps[rad/s]=-1.000000;lever_kind=1;");
}

TEST(Messages, TheVisitorSeesArraysEnumsAndNestedStructs) {
  msg::DeviceWheels wheels{};
  wheels.wheel_radps[2] = 7;
  Text wheels_text;
  visit_fields(wheels, wheels_text);
  EXPECT_THAT(wheels_text.out, ::testing::HasSubstr("wheel_radps[rad/s]=0.000000,0.000000,7.000000,0.000000,;"));

  msg::KickDecision decision{};
  decision.reason = msg::REASON_NOT_ALIGNED;
  decision.shadows[1].policy = msg::POLICY_MOVING;
  Text text;
  visit_fields(decision, text);
  EXPECT_THAT(text.out, ::testing::HasSubstr("reason=not_aligned;"));
  EXPECT_THAT(text.out, ::testing::HasSubstr("shadows={policy=stopped;"));
  EXPECT_THAT(text.out, ::testing::HasSubstr(",{policy=moving;fire=0;"));
}

TEST(Messages, FieldsOfAMutableMessageCanBeWritten) {
  msg::Referee referee{};
  visit_fields(referee, [](std::string_view name, std::string_view, auto& value) {
    if (name == "possession_id") value = static_cast<std::remove_reference_t<decltype(value)>>(42);
  });
  EXPECT_EQ(referee.possession_id, 42u);
}

TEST(Messages, VisitorAndFieldNamesAgree) {
  std::vector<std::string_view> seen;
  visit_fields(msg::KickDecision{},
               [&](std::string_view name, std::string_view, const auto&) { seen.push_back(name); });
  EXPECT_THAT(seen, ::testing::ElementsAreArray(field_names<msg::KickDecision>()));
}

TEST(Messages, LabelsAreLowerCaseWithoutTheCommonPrefix) {
  EXPECT_STREQ(label(msg::OUTCOME_WIDE_LEFT), "wide_left");
  EXPECT_STREQ(label(msg::REASON_NOT_ALIGNED), "not_aligned");
  EXPECT_STREQ(label(msg::POLICY_MOVING), "moving");
  EXPECT_STREQ(label(msg::STEP_KICK_DECISION), "kick_decision");
  EXPECT_STREQ(label(static_cast<msg::Outcome>(77)), "invalid");
}

TEST(Messages, EveryLabelLeadsBackToItsValue) {
  for (const auto& e : enumeration<msg::DecisionReason>::enumerators) {
    EXPECT_EQ(from_label<msg::DecisionReason>(e.label), e.value);
    EXPECT_STREQ(label(e.value), e.label);
  }
  EXPECT_EQ(from_label<msg::DecisionReason>("nonsense"), std::nullopt);
}

}  // namespace
}  // namespace trivela::bus
