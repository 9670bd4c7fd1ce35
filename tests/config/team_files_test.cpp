#include "config/team/team_settings.hpp"

#include <gmock/gmock.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "config/team/team.hpp"
#include "config/team/team_bus.hpp"
#include "config/text/error.hpp"
#include "tests/support/folder.hpp"

namespace trivela::config {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Team five_robots() {
  Team team = load_team(TRIVELA_SOURCE_DIR "/config/teams/example.toml").team;
  for (std::uint32_t number = 3; number <= 5; ++number) {
    TeamRobot robot = team.robots.front();
    robot.number = number;
    robot.address = "172.16.39." + std::to_string(number);
    team.robots.push_back(robot);
  }
  return team;
}

std::string text_in(const std::vector<TeamFile>& files, const std::string& name) {
  for (const TeamFile& file : files)
    if (file.name == name) return file.text;
  return "no " + name;
}

/// A file of a test's own folder, which goes with the object.
class WrittenFile {
 public:
  explicit WrittenFile(const std::string& text) { std::ofstream{path()} << text; }
  std::filesystem::path path() const { return folder_ / "written.toml"; }

 private:
  tests::Folder folder_;
};

TEST(TeamFiles, SettingsReadBackAreThoseOfTheTeam) {
  const Team team = five_robots();
  const TeamRobot* const robot = team.robot(2);
  const WrittenFile written{text_in(team_files(team, robot, "/etc/trivela/here", ""), "settings.toml")};
  const Settings read = load_settings(written.path());
  Settings meant = settings_of(team, *robot);
  meant.run.robot = std::filesystem::absolute(meant.run.robot).lexically_normal().string();
  meant.team_link.dds_file = "/etc/trivela/here/team_bus.xml";
  meant.run.scenario = read.run.scenario;  // the simulator's
  EXPECT_EQ(to_toml_text(read), to_toml_text(meant));
  EXPECT_EQ(read.run.robot_id, 2u);
}

TEST(TeamFiles, SettingsOfTheBaseReadBackNameEveryRobot) {
  const Team team = five_robots();
  const WrittenFile written{text_in(team_files(team, nullptr, "/etc/trivela/here", ""), "settings.toml")};
  const Settings read = load_settings(written.path());
  EXPECT_THAT(read.refbox.robots, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_EQ(read.domain.tag, "example-base");
  EXPECT_TRUE(read.team_link.base);
  EXPECT_EQ(read.team_link.interface, "eth0");
  EXPECT_EQ(read.team_link.domain_id, team.domains.team);
}

TEST(TeamFiles, TheSameTeamGivesTheSameFiles) {
  const Team team = five_robots();
  const auto once = team_files(team, team.robot(1), "out", "/etc/trivela");
  const auto again = team_files(team, team.robot(1), "./out", "/etc/trivela");
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].text, again[i].text) << once[i].name;
}

TEST(TeamFiles, TheEnvironmentNamesWhatTheLauncherReads) {
  const Team team = five_robots();
  const std::string robot = text_in(team_files(team, team.robot(1), "/here", "/etc/trivela"), "robot.env");
  EXPECT_THAT(robot, HasSubstr("TRIVELA_CONFIG=\"/etc/trivela\"\nTRIVELA_SETTINGS=\"/here/settings.toml\"\n"));
  EXPECT_THAT(robot,
              HasSubstr("CYCLONEDDS_URI=\"file:///etc/trivela/cyclonedds/loopback.xml\"\nTRIVELA_TAG=\"example-1\"\n"));
  EXPECT_THAT(robot, HasSubstr("TRIVELA_FLAGS_kicker_driver=\"--realtime 50\"\n"));
  EXPECT_THAT(robot, HasSubstr("kicker_driver shot_observer kicker_drift\"\n"));
  const std::string base = text_in(team_files(team, nullptr, "/here", ""), "robot.env");
  EXPECT_THAT(base, HasSubstr("TRIVELA_NODES=\"recorder team_link refbox\"\n"));
  EXPECT_THAT(base, Not(HasSubstr("TRIVELA_CONFIG")));
}

/// The folder holds what a robot's settings say beside the team's.
std::vector<TeamFile> files_with_settings(Team team, const std::string& settings) {
  const WrittenFile written{settings};
  team.team.settings = written.path().string();
  return team_files(team, team.robot(1), "/here", "/etc/trivela");
}

TEST(TeamFiles, TheTargetStartsTheNodesThatTheLauncherDoes) {
  const Team team = five_robots();
  for (const TeamRobot* const robot : {team.robot(1), static_cast<const TeamRobot*>(nullptr)}) {
    const auto files = team_files(team, robot, "/here", "");
    const std::string env = text_in(files, "robot.env");
    std::string meant = "[Unit]\n";
    const auto begin = env.find("TRIVELA_NODES=\"") + 15;
    std::istringstream nodes{env.substr(begin, env.find('"', begin) - begin)};
    for (std::string node; nodes >> node;) meant += "Wants=trivela@" + node + ".service\n";
    EXPECT_EQ(text_in(files, "trivela.target.conf"), meant);
    EXPECT_THAT(meant, HasSubstr("trivela@team_link.service"));
  }
}

TEST(TeamFiles, TheSecondDecisionNodeIsStartedWhereItStandsBy) {
  const Team team = five_robots();
  for (const char* const name : {"robot.env", "trivela.target.conf"}) {
    EXPECT_THAT(text_in(team_files(team, team.robot(1), "/here", ""), name), Not(HasSubstr("kick_decision_second")));
    EXPECT_THAT(text_in(files_with_settings(team, "[kick_decision]\nstandby = true\n"), name),
                HasSubstr("kick_decision_second"));
  }
}

TEST(TeamFiles, OneProcessStandsInForTheThreeOfTheDecisionPath) {
  const std::string env = text_in(files_with_settings(five_robots(), "[run]\none_process = true\n"), "robot.env");
  EXPECT_THAT(env, HasSubstr("\"recorder team_link chain kicker_driver shot_observer kicker_drift\""));
  EXPECT_THAT(env, HasSubstr("TRIVELA_FLAGS_chain=\"--realtime 40\"\n"));
  EXPECT_THAT(env, Not(HasSubstr("odometry")));
}

TEST(TeamFiles, EveryNodeOfTheDecisionPathIsInRealTimeAndNoOther) {
  const Team team = five_robots();
  const std::string env = text_in(files_with_settings(team, "[kick_decision]\nstandby = true\n"), "robot.env");
  for (const char* const flags :
       {"odometry=\"--realtime 50\"", "kicker_driver=\"--realtime 50\"", "world_state=\"--realtime 40\"",
        "kick_decision=\"--realtime 40\"", "kick_decision_second=\"--realtime 41\""})
    EXPECT_THAT(env, HasSubstr(std::string{"TRIVELA_FLAGS_"} + flags + "\n"));
  for (const char* const node : {"recorder", "team_link", "shot_observer"})
    EXPECT_THAT(env, Not(HasSubstr(std::string{"TRIVELA_FLAGS_"} + node)));
  EXPECT_THAT(text_in(team_files(team, nullptr, "/here", ""), "robot.env"), Not(HasSubstr("TRIVELA_FLAGS")));
}

TEST(TeamFiles, TheFolderOfKeysIsToldToTheNodes) {
  Team team = five_robots();
  EXPECT_THAT(text_in(team_files(team, team.robot(1), "/here", ""), "robot.env"), Not(HasSubstr("TRIVELA_SECURITY")));
  team.team.keys = "/etc/trivela/keys";
  for (const TeamRobot* const robot : {team.robot(1), static_cast<const TeamRobot*>(nullptr)})
    EXPECT_THAT(text_in(team_files(team, robot, "/here", ""), "robot.env"),
                HasSubstr("TRIVELA_SECURITY=\"/etc/trivela/keys\"\n"));
}

TEST(TeamFiles, AFolderThatTheUnitsDoNotSeeIsAFindingAtItsLine) {
  Team team = five_robots();
  team.team.keys = "/home/team/keys";
  team.team.logs = "/var/../root";
  EXPECT_THAT(team_findings(team), ElementsAre(HasSubstr("example.toml:10: team.logs = \"/var/../root\""),
                                               HasSubstr("example.toml:11: team.keys = \"/home/team/keys\"")));
  team.team.keys = "keys";
  team.team.logs = "/homeless";
  EXPECT_THAT(team_findings(team), ElementsAre(HasSubstr("team.keys = \"keys\": must be a whole path")));
}

TEST(TeamFiles, APathThatAShellWouldReadOtherwiseIsRefused) {
  const Team team = five_robots();
  EXPECT_THROW(team_files(team, nullptr, "/here/$HOME", ""), Error);
  EXPECT_THROW(team_files(team, nullptr, "/here/\"x", ""), Error);
}

TEST(TeamBus, AGroupIsTheDiscoverysAndPeersAreEveryMachine) {
  Team team = five_robots();
  EXPECT_THAT(team_bus_xml(team, "wlan0"), HasSubstr("<SPDPMulticastAddress>224.16.32.39</SPDPMulticastAddress>"));
  team.team.group.clear();
  team.team.peers = {"172.16.39.77"};
  const std::string peers = team_bus_xml(team, "wlan0");
  for (const char* address : {"172.16.39.1\"", "172.16.39.5\"", "172.16.39.100\"", "172.16.39.77\""})
    EXPECT_THAT(peers, HasSubstr(std::string{"<Peer address=\""} + address));
  EXPECT_THAT(peers, HasSubstr("<AllowMulticast>false</AllowMulticast>"));
}

TEST(TeamBus, TheEstimateIsTheDocumentedArithmetic) {
  const AirEstimate air = air_estimate(five_robots());
  EXPECT_DOUBLE_EQ(air.referee_bps, 5 * 10 * (120 + 104) * 8);
  EXPECT_DOUBLE_EQ(air.state_bps, (5 * 10 + 5 * 5 * 5) * (300 + 104) * 8);
  EXPECT_DOUBLE_EQ(air.discovery_bps, (6 * 480 + 6 * 5 * 100) * 8 / 2);
}

TEST(TeamBus, WithKeysTheEstimateHasWhatEncryptionAddsToEachMessage) {
  Team team = five_robots();
  team.team.keys = "/etc/trivela/keys";
  const AirEstimate air = air_estimate(team);
  EXPECT_DOUBLE_EQ(air.referee_bps, 5 * 10 * (120 + 104 + 80) * 8);
  EXPECT_DOUBLE_EQ(air.state_bps, (5 * 10 + 5 * 5 * 5) * (300 + 104 + 80) * 8);
  EXPECT_DOUBLE_EQ(air.discovery_bps, (6 * 480 + 6 * 5 * (100 + 80)) * 8 / 2);
  EXPECT_LT(air.total_bps(), 1e6);
}

TEST(TeamBus, FiveRobotsAndABaseKeepTheDefaultBudgetByGroupAndByPeers) {
  Team team = five_robots();
  EXPECT_LT(air_estimate(team).total_bps(), TeamFields{}.budget_bps);
  team.team.group.clear();
  EXPECT_LT(air_estimate(team).total_bps(), TeamFields{}.budget_bps);
}

TEST(TeamBus, MoreThanTheBudgetIsAFindingAtItsLine) {
  Team team = five_robots();
  team.team.budget_bps = 600'000;
  EXPECT_THAT(team_findings(team), ElementsAre(HasSubstr("example.toml:12: team.budget_bps = 600000")));
}

TEST(TeamReader, EveryUnknownKeyAndWrongTypeIsSaidWithItsLine) {
  const WrittenFile written{
      "[team]\nname = 7\nnummber = 39\nbudget_bps = \"much\"\n\n[[robot]]\nnumber = 300\n\n[bose]\naddress = \"\"\n"};
  const ReadTeam read = load_team(written.path());
  const auto& findings = read.findings;
  EXPECT_THAT(team_findings(read.team), Not(Contains(HasSubstr("number is missing")))) << "it is there, and wrong";
  for (const char* said : {"written.toml:2: team.name", "written.toml:3: team.nummber", "did you mean",
                           "written.toml:4: team.budget_bps", "written.toml:7: robot.number", "written.toml:9: bose"})
    EXPECT_THAT(findings, Contains(HasSubstr(said)));
}

TEST(TeamReader, ARobotThatIsNoArrayAndATeamThatIsNoTableAreSaid) {
  const WrittenFile written{"team = 3\nrobot = 4\n"};
  EXPECT_THAT(load_team(written.path()).findings,
              ElementsAre(HasSubstr("written.toml:1: team: expected a table"),
                          HasSubstr("written.toml:2: robot: expected [[robot]] tables")));
}

}  // namespace
}  // namespace trivela::config
