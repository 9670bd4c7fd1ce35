#include "config/field.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/scenario.hpp"

namespace trivela::config {
namespace {

using ::testing::HasSubstr;

sim::Scenario msl_2026() { return load_scenario(TRIVELA_SOURCE_DIR "/config/scenarios/msl_2026.toml"); }

TEST(Field, NodesTakeGoalAndRulesOfTheScenario) {
  const Settings settings = on_field_of(msl_2026(), {});
  EXPECT_EQ(settings.goal.y_m, 11.0);
  EXPECT_EQ(settings.goal.half_width_m, 1.2);
  EXPECT_TRUE(settings.policy.rules.opponents_half_only);
  EXPECT_EQ(settings.policy.rules.carry_limit_m, 3.0);
  EXPECT_FALSE(field_difference(msl_2026(), settings));
}

TEST(Field, ShippedSettingsAndTheDefaultScenarioAgree) {
  const Settings settings = load_settings(TRIVELA_SOURCE_DIR "/config/default.toml");
  EXPECT_FALSE(field_difference(load_scenario(settings.run.scenario), settings));
}

TEST(Field, ADifferenceIsNamedWithBothValues) {
  Settings settings = on_field_of(msl_2026(), {});
  settings.goal.y_m = 9.5;
  const auto difference = field_difference(msl_2026(), settings);
  ASSERT_TRUE(difference);
  EXPECT_THAT(*difference, HasSubstr("goal.y_m = 9.5"));
  EXPECT_THAT(*difference, HasSubstr("say 11"));
  settings.goal.y_m = 11.0;
  settings.policy.rules.carry_limit_m = 2.0;
  EXPECT_THAT(field_difference(msl_2026(), settings).value_or(""), HasSubstr("rules.carry_limit_m = 2"));
}

TEST(Field, OnlyWhatSomebodyAskedForContradicts) {
  EXPECT_FALSE(field_contradiction(msl_2026(), {})) << "defaults are nobody's word";
  Settings settings;
  settings.goal.height_m = 1.3;
  EXPECT_THAT(field_contradiction(msl_2026(), settings).value_or(""), HasSubstr("goal.height_m = 1.3"));
}

}  // namespace
}  // namespace trivela::config
