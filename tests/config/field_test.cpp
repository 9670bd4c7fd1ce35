#include "config/field.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "config/scenario/scenario.hpp"
#include "config/text/error.hpp"
#include "tests/support/folder.hpp"

namespace trivela::config {
namespace {

using ::testing::AllOf;
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

TEST(Field, AHalfIsAsLongAsTheScenarioHasItUnlessTheSettingsSayOtherwise) {
  EXPECT_EQ(msl_2026().referee.half_minutes, 15.0);
  Simulator settings;
  settings.half_minutes = 0.0;
  EXPECT_EQ(half_minutes(settings, msl_2026()), 15.0);
  settings.half_minutes = 2.5;
  EXPECT_EQ(half_minutes(settings, msl_2026()), 2.5);
}

const std::string kFields = TRIVELA_SOURCE_DIR "/config/fields/";

class FieldFileTest : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& text) const {
    std::ofstream{folder / name} << text;
    return folder / name;
  }
  static std::string message_of(auto&& read) {
    try {
      read();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  tests::Folder folder;
};

TEST_F(FieldFileTest, NodesAndScenarioThatNameOneFileAgree) {
  for (const std::string name : {"paper", "msl_2026"}) {
    const Settings settings = load_settings(file("nodes.toml", "run.field_file = \"" + kFields + name + ".toml\"\n"));
    const sim::Scenario scenario = load_scenario(file("world.toml", "field_file = \"" + kFields + name + ".toml\"\n"));
    EXPECT_FALSE(field_difference(scenario, settings)) << name;
    EXPECT_FALSE(field_contradiction(scenario, settings)) << name;
    EXPECT_EQ(settings.field.side_line_x_m, scenario.field.side_line_x_m) << name;
    EXPECT_EQ(settings.goal.y_m, name == "paper" ? 9.0 : 11.0);
    EXPECT_EQ(settings.policy.rules.set_piece_s, name == "paper" ? 0.0 : 7.0);
  }
}

TEST_F(FieldFileTest, ItsNameIsRelativeToWhoeverNamesIt) {
  file("pitch.toml", "[field]\ngoal_line_y_m = 10.0\nside_line_x_m = 6.5\n");
  EXPECT_EQ(load_settings(file("nodes.toml", "run.field_file = \"pitch.toml\"\n")).goal.y_m, 10.0);
  EXPECT_EQ(load_scenario(file("world.toml", "field_file = \"pitch.toml\"\n")).field.side_line_x_m, 6.5);
  Settings settings;
  override_settings(settings, {"run.field_file = \"" + (folder / "pitch.toml").string() + "\""});
  EXPECT_EQ(settings.field.side_line_x_m, 6.5);
}

TEST_F(FieldFileTest, WhoSaysOtherwiseBesideItIsRefusedWithBothValues) {
  file("pitch.toml", "[field]\ngoal_line_y_m = 10.0\n\n[rules]\ncarry_limit_m = 3.0\n");
  const std::string name = "run.field_file = \"pitch.toml\"\n";
  EXPECT_NO_THROW(load_settings(file("same.toml", name + "goal.y_m = 10.0\n")));
  EXPECT_THAT(message_of([&] { load_settings(file("nodes.toml", name + "goal.y_m = 9.0\n")); }),
              AllOf(HasSubstr("nodes.toml:2: goal.y_m = 9"), HasSubstr("pitch.toml, says 10")));
  Settings settings = load_settings(file("nodes.toml", name));
  EXPECT_THAT(message_of([&] { override_settings(settings, {"rules.carry_limit_m = 2.0"}, "--set"); }),
              AllOf(HasSubstr("--set rules.carry_limit_m = 2.0: rules.carry_limit_m = 2"), HasSubstr("says 3")));
  EXPECT_THAT(message_of([&] { load_scenario(file("world.toml", "field_file = \"pitch.toml\"\n[rules]\n")); }),
              HasSubstr("world.toml:2: [rules]: field_file, pitch.toml, says it"));
  EXPECT_THAT(message_of([&] { load_scenario(file("world.toml", "field_file = 3\n")); }), HasSubstr("expected a text"));
  EXPECT_THAT(message_of([&] { load_scenario(file("world.toml", "field_file = \"none.toml\"\n")); }),
              HasSubstr("none.toml"));
}

TEST_F(FieldFileTest, AFileThatTheNodesNameIsNotOverruledByAScenario) {
  const Settings settings = load_settings(file("nodes.toml", "run.field_file = \"" + kFields + "paper.toml\"\n"));
  EXPECT_THAT(field_contradiction(msl_2026(), settings).value_or(""), HasSubstr("goal."));
  EXPECT_EQ(on_field_of(msl_2026(), settings).run.field_file, "") << "whose values these are not any more";
}

TEST_F(FieldFileTest, WhatItNamesByAnUnknownKeyIsRefused) {
  EXPECT_THAT(message_of([&] { load_field(file("pitch.toml", "[field]\nlength_m = 22\n")); }), HasSubstr("length_m"));
}

}  // namespace
}  // namespace trivela::config
