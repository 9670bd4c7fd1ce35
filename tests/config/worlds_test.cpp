#include "config/scenario/scenario.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "config/text/error.hpp"
#include "config/text/installation.hpp"
#include "tests/support/folder.hpp"

namespace trivela::config {
namespace {

using testing::HasSubstr;

std::string refused_worlds(const std::string& text) {
  const tests::Folder folder;
  std::ofstream{folder / "worlds.toml"} << text;
  try {
    load_worlds(folder / "worlds.toml", {});
  } catch (const Error& error) {
    return error.what();
  }
  return "they were taken";
}

TEST(Worlds, TheShippedOnesDifferFromTheDefaultButForTheFirst) {
  const auto worlds = load_worlds(shipped("studies/robustness.toml"), {});
  ASSERT_GT(worlds.size(), 25u);
  EXPECT_EQ(to_toml_text(worlds[0].scenario), to_toml_text(sim::Scenario{}));
  for (std::size_t i = 1; i < worlds.size(); ++i) {
    EXPECT_NE(to_toml_text(worlds[i].scenario), to_toml_text(sim::Scenario{})) << worlds[i].name;
    EXPECT_FALSE(worlds[i].why.empty()) << worlds[i].name;
  }
}

TEST(Worlds, StandOnTheStudysScenario) {
  const tests::Folder folder;
  std::ofstream{folder / "worlds.toml"} << "[[world]]\nname = \"late\"\nset = [\"kicker.delay_s = 0.2\"]\n";
  sim::Scenario base;
  base.possession.time_limit_s = 5.0;
  const auto worlds = load_worlds(folder / "worlds.toml", base);
  EXPECT_EQ(worlds.at(0).scenario.kicker.delay_s, 0.2);
  EXPECT_EQ(worlds.at(0).scenario.possession.time_limit_s, 5.0);
}

TEST(Worlds, WhatIsNoneIsRefusedWithItsPlace) {
  EXPECT_THAT(refused_worlds(""), HasSubstr("worlds.toml: no [[world]]"));
  EXPECT_THAT(refused_worlds("[[arm]]\n"), HasSubstr("worlds.toml:1: arm: unknown key"));
  EXPECT_THAT(refused_worlds("[[world]]\nwhy = \"x\"\n"), HasSubstr("a world needs a name"));
  EXPECT_THAT(refused_worlds("[[world]]\nname = \"a\"\n[[world]]\nname = \"a\"\n"), HasSubstr("stands there twice"));
  EXPECT_THAT(refused_worlds("[[world]]\nname = \"a\"\nset = [\"kicker.delay_s = -1\"]\n"), HasSubstr("world a: set"));
  EXPECT_THAT(refused_worlds("[[world]]\nname = \"a\"\nscenario = \"none.toml\"\n"), HasSubstr("none.toml"));
  EXPECT_THAT(refused_worlds("[[world]]\nname = \"a\"\ncolour = 1\n"), HasSubstr("colour"));
}

}  // namespace
}  // namespace trivela::config
