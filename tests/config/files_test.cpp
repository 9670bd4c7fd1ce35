// The shipped files against the structs.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "config/robot.hpp"
#include "config/scenario/scenario.hpp"
#include "config/settings.hpp"
#include "config/text/toml_source.hpp"

namespace trivela::config {
namespace {

namespace fs = std::filesystem;
const fs::path kConfig = fs::path{TRIVELA_SOURCE_DIR} / "config";

std::set<std::string> keys(const toml::table& table, const std::string& prefix = "") {
  std::set<std::string> found;
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string{key.str()};
    if (const toml::table* inner = node.as_table()) {
      found.merge(keys(*inner, name + "."));
    } else {
      found.insert(name);
    }
  }
  return found;
}

TEST(DefaultToml, SaysWhatTheStructsSay) {
  Settings settings = load_settings(kConfig / "default.toml");
  settings.run.robot = Settings{}.run.robot;  // made relative to the folder by loading
  settings.run.scenario = Settings{}.run.scenario;
  EXPECT_EQ(to_toml_text(settings), to_toml_text(Settings{}));
}

TEST(DefaultToml, NamesEverySetting) {
  EXPECT_EQ(keys(parse_file(kConfig / "default.toml").root),
            keys(parse_text(to_toml_text(Settings{}), "defaults").root));
}

TEST(DefaultScenario, SaysWhatTheStructSaysAndNamesEveryInput) {
  const fs::path file = kConfig / "scenarios" / "default.toml";
  EXPECT_EQ(to_toml_text(load_scenario(file)), to_toml_text(sim::Scenario{}));
  auto named = keys(parse_file(file).root);
  EXPECT_EQ(named.erase("field_file"), 1U);
  named.merge(keys(parse_file(kConfig / "fields" / "paper.toml").root));
  EXPECT_EQ(named, keys(parse_text(to_toml_text(sim::Scenario{}), "defaults").root));
}

TEST(Scenarios, AllLoadAndReadBackTheSame) {
  for (const auto& entry : fs::directory_iterator(kConfig / "scenarios")) {
    const std::string text = to_toml_text(load_scenario(entry.path()));
    sim::Scenario again;
    EXPECT_NO_THROW(again = load_scenario(entry.path())) << entry.path();
    EXPECT_EQ(to_toml_text(again), text);
  }
}

TEST(Robots, FirstIsTheDefaultOfTheStruct) {
  EXPECT_EQ(to_toml_text(load_robot(kConfig / "robots" / "cambada_1.toml")), to_toml_text(Robot{}));
}

TEST(Robots, HoldThePublishedKickerMap) {
  struct Published {
    const char* name;
    double first_mps, last_mps, exit_angle_deg;
  };
  for (const Published& published : {Published{"cambada_1", 5.97, 10.51, 36.78},
                                     {"cambada_2", 5.97, 10.51, 36.78},
                                     {"cambada_3", 6.03, 10.47, 36.67},
                                     {"cambada_4", 5.97, 10.51, 36.78},
                                     {"cambada_5", 6.24, 10.96, 35.04},
                                     {"cambada_6", 6.24, 10.96, 35.04}}) {
    const Robot robot = load_robot(kConfig / "robots" / (std::string{published.name} + ".toml"));
    EXPECT_EQ(robot.name, published.name);
    EXPECT_DOUBLE_EQ(robot.model.table.front().speed_mps, published.first_mps);
    EXPECT_DOUBLE_EQ(robot.model.table.back().speed_mps, published.last_mps);
    EXPECT_EQ(robot.model.table.set_points().size(), 8u);
    EXPECT_NEAR(kicking::degrees(robot.model.exit_angle_rad), published.exit_angle_deg, 1e-12);
    EXPECT_DOUBLE_EQ(robot.model.transfer_paper.forward, 0.70);
  }
}

}  // namespace
}  // namespace trivela::config
