#include <gmock/gmock.h>

#include "config/team/team.hpp"
#include "config/team/team_settings.hpp"

namespace trivela::config {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

Team example() { return load_team(TRIVELA_SOURCE_DIR "/config/teams/example.toml").team; }

TEST(Team, TheShippedExampleHasNothingWrong) {
  EXPECT_THAT(load_team(TRIVELA_SOURCE_DIR "/config/teams/example.toml").findings, IsEmpty());
  EXPECT_THAT(team_findings(example()), IsEmpty());
}

TEST(Team, EverythingThatIsWrongIsSaidAtOnce) {
  Team team = example();
  team.robots[1].number = 1;
  team.robots[1].address = team.base.address;
  team.robots[0].robot = "nowhere.toml";
  team.robots[0].policy = kicking::PolicyName::kOracle;
  team.team.group = "239.255.0.1";
  team.domains = {.robot = 101, .team = 101, .lines = {}};
  const auto findings = team_findings(team);
  for (const char* said : {"robot 1: another one at", "is the base's, too", "nowhere.toml", "simulator's truth",
                           "default of DDS", "domains.robot = 101", "choose two"})
    EXPECT_THAT(findings, Contains(HasSubstr(said)));
}

TEST(Team, ARobotsSettingsAreTheTeamsWord) {
  const Team team = example();
  const Settings settings = settings_of(team, team.robots[1]);
  EXPECT_EQ(settings.run.robot_id, 2u);
  EXPECT_EQ(settings.domain.tag, "example-2");
  EXPECT_EQ(settings.run.team, "example");
  EXPECT_EQ(settings.recorder.log, "/var/lib/trivela/{team}-{robot}-{time}.db");
  EXPECT_THAT(to_short_toml_text(settings, {}), HasSubstr("policy_by_half = [\"predictive\"]"));
}

}  // namespace
}  // namespace trivela::config
