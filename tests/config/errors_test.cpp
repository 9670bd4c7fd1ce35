// Bad configuration gets a sentence with file, line, key and value.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "config/robot.hpp"
#include "config/scenario/scenario.hpp"
#include "config/settings.hpp"
#include "config/text/toml_source.hpp"

namespace trivela::config {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Scratch {
 public:
  Scratch() : folder_(fs::temp_directory_path() / ("trivela_config_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~Scratch() { fs::remove_all(folder_); }
  fs::path file(const std::string& text) const {
    const fs::path path = folder_ / "bad.toml";
    std::ofstream{path} << text;
    return path;
  }

 private:
  fs::path folder_;
};

std::string settings_error(const std::string& text) {
  const Scratch scratch;
  try {
    load_settings(scratch.file(text));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BadSettings, UnknownKeyIsNamedWithItsLine) {
  EXPECT_THAT(settings_error("[run]\nrobot_id = 1\nrobot_di = 2\n"),
              AllOf(HasSubstr("bad.toml:3"), HasSubstr("run.robot_di"), HasSubstr("unknown key")));
}

TEST(BadSettings, UnknownSectionIsNamedWithItsLine) {
  EXPECT_THAT(settings_error("[runn]\nrobot_id = 1\n"),
              AllOf(HasSubstr("bad.toml:1"), HasSubstr("runn"), HasSubstr("unknown key")));
}

TEST(BadSettings, WrongTypeIsNamedWithItsValue) {
  EXPECT_THAT(
      settings_error("[policy]\nsettle_s = \"long\"\n"),
      AllOf(HasSubstr("bad.toml:2"), HasSubstr("policy.settle_s"), HasSubstr("long"), HasSubstr("expected a number")));
  EXPECT_THAT(settings_error("[run]\nlockstep = 1\n"), HasSubstr("expected true or false"));
  EXPECT_THAT(settings_error("[run]\nrobot_id = 1.5\n"), HasSubstr("expected a whole number"));
  EXPECT_THAT(settings_error("run = 3\n"), HasSubstr("expected a table"));
  EXPECT_THAT(settings_error("[kick_decision]\npolicy_by_half = \"moving\"\n"), HasSubstr("expected an array"));
}

TEST(BadSettings, AStandbyHasNoUseInLockstepNorBesideOneProcess) {
  const std::string standby = "[kick_decision]\nstandby = true\n";
  EXPECT_THAT(settings_error("[run]\nlockstep = true\n" + standby), HasSubstr("in lockstep nobody takes over"));
  EXPECT_THAT(settings_error("[run]\none_process = true\n" + standby),
              HasSubstr("run.one_process = true, but kick_decision.standby = true"));
}

TEST(BadSettings, ImpossibleValueIsNamedWithItsRange) {
  EXPECT_THAT(settings_error("[run]\n\ncycle_s = -1.0\n"),
              AllOf(HasSubstr("bad.toml:3"), HasSubstr("run.cycle_s = -1"), HasSubstr("must lie in")));
  EXPECT_THAT(settings_error("[run]\nrobot_id = 256\n"), HasSubstr("must lie in [1, 255]"));
  EXPECT_THAT(settings_error("[policy]\nsettle_s = nan\n"), HasSubstr("finite"));
  EXPECT_THAT(settings_error("[policy]\nsettle_s = inf\n"), HasSubstr("finite"));
}

TEST(BadSettings, ANumberIsShownAsAPersonWritesIt) {
  EXPECT_THAT(settings_error("[policy]\nsettle_s = -0.64\n"), HasSubstr("policy.settle_s = -0.64: must lie in"));
  EXPECT_THAT(settings_error("[policy]\nsettle_s = [0.64, \"x\"]\n"), HasSubstr("policy.settle_s = [ 0.64, 'x' ]: "));
}

TEST(BadSettings, UnknownDeviceIsNamedWithItsLineAndTheKnownOnes) {
  EXPECT_THAT(settings_error("[hal]\nwheels = \"can\"\n"),
              HasSubstr("bad.toml:2: hal.wheels = 'can': expected one of: bus, cia402"));
  EXPECT_THAT(settings_error("[hal]\nkicker = \"\"\n"), HasSubstr("expected one of: bus, ioboard"));
  EXPECT_THAT(settings_error("[scan_recorder]\ndevice = \"tcp://host\"\n"),
              AllOf(HasSubstr("bad.toml:2: scan_recorder.device = 'tcp://host'"), HasSubstr("sim, tcp://HOST:PORT")));
}

TEST(BadSettings, UnknownChoiceNamesTheKnownOnes) {
  EXPECT_THAT(settings_error("[policy]\nheight_law = \"guess\"\n"),
              AllOf(HasSubstr("guess"), HasSubstr("paper, extended_range, exact")));
  EXPECT_THAT(settings_error("[kick_decision]\npolicy_by_half = [\"moving\", \"dancing\"]\n"),
              AllOf(HasSubstr("dancing"), HasSubstr("stopped, moving")));
  EXPECT_THAT(settings_error("[kick_decision]\npolicy_by_half = []\n"), HasSubstr("policy_by_half is empty"));
}

TEST(BadSettings, AMisspeltLogLevelDoesNotSilenceANode) {
  for (const std::string level : {"inof", "INFO", ""})
    EXPECT_THAT(settings_error("[run]\nlog_level = \"" + level + "\"\n"),
                AllOf(HasSubstr("bad.toml:2: run.log_level = "), HasSubstr(level),
                      HasSubstr("expected one of: trace, debug, info, warn, error, off")));
}

TEST(BadSettings, WhatCodeHasSetIsNamedWithoutALine) {
  Settings settings;
  settings.run.log_level = "loud";
  EXPECT_THAT([&] { override_settings(settings, {"run.robot_id = 2"}); },
              ::testing::ThrowsMessage<Error>(HasSubstr("run.log_level: expected one of: trace")));
}

TEST(BadSettings, AKeyOfMorePartsThanAStackHoldsIsRefused) {
  std::string key = "a";
  for (int part = 1; part < 100'000; ++part) key += ".a";
  std::string quoted;
  for (int part = 1; part < 100'000; ++part) quoted += "\"=\".";
  for (const std::string& text :
       {"\n" + key + " = 1\n", "\n[" + key + "]\n", "\nb = {" + key + " = 1}\n", "\n" + quoted + "a = 1\n"})
    EXPECT_THAT(settings_error(text), HasSubstr("bad.toml:2: a key of more than 100 parts"));
  const std::string dots(200, '.');
  EXPECT_EQ(settings_error("# don't " + dots + "\nrun.team = \"\\\"" + dots + "\"  # " + dots + "\n"), "accepted");
}

TEST(BadSettings, BrokenTomlIsNamedWithItsLine) {
  EXPECT_THAT(settings_error("[run]\nrobot_id = \n"), AllOf(HasSubstr("bad.toml:2"), HasSubstr("not valid TOML")));
}

std::string set_error(const std::vector<std::string>& lines) {
  Settings settings;
  try {
    override_settings(settings, lines, "--set");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BadSettings, OfSeveralOverridesTheWrongOneIsNamed) {
  EXPECT_THAT(set_error({"domain.domain_id=61", "run.robot_id=0"}),
              ::testing::StartsWith("--set run.robot_id=0: run.robot_id = 0: must lie in"));
  EXPECT_EQ(set_error({"run.foo=3", "domain.domain_id=61"}), "--set run.foo=3: run.foo: unknown key");
}

TEST(BadSettings, AnOverrideWhoseTextHasNoQuotesSaysHowTheyAreSet) {
  EXPECT_THAT(set_error({"domain.domain_id=61", "hal.wheels=bus"}),
              AllOf(::testing::StartsWith("--set hal.wheels=bus: not valid TOML"),
                    ::testing::EndsWith("; text needs quotes: --set 'hal.wheels=\"bus\"'")));
  EXPECT_THAT(set_error({"hal.ioboard.port = /dev/kicker"}),
              HasSubstr("text needs quotes: --set 'hal.ioboard.port=\"/dev/kicker\"'"));
  for (const char* const line : {"policy.settle_s", "policy.settle_s=", "policy.settle_s=0.5s", "hal.wheels=\"bus"})
    EXPECT_THAT(set_error({line}), AllOf(HasSubstr("not valid TOML"), ::testing::Not(HasSubstr("quotes:")))) << line;
}

TEST(BadSettings, MissingFileIsNamed) {
  EXPECT_THAT([] { load_settings("no/such/file.toml"); },
              ::testing::ThrowsMessage<Error>(HasSubstr("no/such/file.toml: cannot read")));
}

TEST(BadSettings, ATableOfABackendThatIsNotChosenSaysWhereItIsRead) {
  EXPECT_THAT(settings_error("[hal]\nkicker = \"bus\"\n[hal.ioboard]\nport = \"/dev/kicker\"\n"),
              AllOf(HasSubstr("bad.toml:3: hal.ioboard"), HasSubstr("it is read where hal.kicker = \"ioboard\"")));
}

TEST(BadSettings, AGroupThatIsNoMulticastAddressIsRefused) {
  for (const char* const group : {"10.0.0.1", "224.16.32"})
    EXPECT_THAT(settings_error(std::string{"[refbox]\ngroup = \""} + group + "\"\n"), HasSubstr("224.16.32.N"))
        << group;
  EXPECT_EQ(settings_error("[refbox]\ngroup = \"10.0.0.1\"\nletters = true\n"), "accepted");
}

TEST(BadSettings, ALogWithoutANameIsRefused) {
  EXPECT_THAT(settings_error("[recorder]\nlog = \"\""), HasSubstr("recorder.log = \"\""));
}

TEST(Settings, RobotAndWorldThatAFileDoesNotNameAreTheShippedOnesWhereverItLies) {
  const Scratch scratch;
  const Settings settings = load_settings(scratch.file("[run]\nrobot_id = 3\n"));
  EXPECT_TRUE(fs::exists(settings.run.robot)) << settings.run.robot;
  EXPECT_TRUE(fs::exists(settings.run.scenario)) << settings.run.scenario;
}

TEST(Settings, AnEmptyFileGivesTheDefaults) { EXPECT_EQ(settings_error(""), "accepted"); }

std::string robot_error(const std::string& text) {
  const Scratch scratch;
  try {
    load_robot(scratch.file(text));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BadRobot, TrueTableIsNotGivenToDragFreeLaws) {
  EXPECT_THAT(robot_error("[table]\nkind = \"true\"\npowers = [1.0, 2.0]\nexit_speeds_mps = [5.0, 6.0]\n"),
              HasSubstr("effective"));
}

TEST(BadRobot, ColumnsOfUnequalLengthAreRefused) {
  EXPECT_THAT(robot_error("[table]\npowers = [1.0, 2.0]\nexit_speeds_mps = [5.0]\n"),
              AllOf(HasSubstr("2 entries"), HasSubstr("1")));
}

TEST(BadRobot, SpeedsThatDoNotRiseAreNamed) {
  EXPECT_THAT(robot_error("[table]\npowers = [1.0, 2.0]\nexit_speeds_mps = [6.0, 5.0]\n"),
              HasSubstr("bad.toml:3: table.exit_speeds_mps = [ 6.0, 5.0 ]: [1] must be above 6"));
}

TEST(BadRobot, ABaseThatCannotDriveIsNamedWithItsLine) {
  const std::string table = "[table]\npowers = [1.0, 2.0]\nexit_speeds_mps = [5.0, 6.0]\n[base]\n";
  EXPECT_THAT(robot_error(table + "wheel_angles_rad = [0.5, 2.6]\n"),
              HasSubstr("bad.toml:5: base.wheel_angles_rad = [ 0.5, 2.6 ]: an omni base has 3 or 4 wheels, not 2"));
  EXPECT_THAT(robot_error(table + "wheel_angles_rad = []\n"), HasSubstr("bad.toml:5: base.wheel_angles_rad = []"));
  EXPECT_THAT(robot_error(table + "wheel_angles_rad = [0.5, 0.5, 0.5]\n"), HasSubstr("do not span the plane"));
}

TEST(BadRobot, MissingTableIsRefused) { EXPECT_THAT(robot_error("name = \"x\"\n"), HasSubstr("table")); }

TEST(BadScenario, ContradictionIsNamedWithItsLine) {
  const Scratch scratch;
  const fs::path file = scratch.file("[possession]\nspeed_min_mps = 3.0\nspeed_max_mps = 1.0\n");
  EXPECT_THAT([&] { load_scenario(file); },
              ::testing::ThrowsMessage<Error>(AllOf(HasSubstr("bad.toml:"), HasSubstr("possession.speed_m"))));
}

TEST(RoundTrip, ChangedSettingsReadBackTheSame) {
  Settings settings;
  settings.run.robot_id = 7;
  settings.run.log_level = "off";
  settings.run.team = "a \"quoted\" \\ word";
  settings.policy.settle_s = 0.1234567890123;
  settings.kick_decision.policy_by_half = {kicking::PolicyName::kStopped, kicking::PolicyName::kMoving};
  const Scratch scratch;
  Settings again = load_settings(scratch.file(to_toml_text(settings)));
  again.run.robot = settings.run.robot;
  again.run.scenario = settings.run.scenario;
  EXPECT_EQ(to_toml_text(again), to_toml_text(settings));
}

TEST(ChangedWorld, ALineSetsOneValue) {
  sim::Scenario scenario;
  override_scenario(scenario, "keeper.reaction_s = 0.4");
  override_scenario(scenario, "keeper.enabled=true");
  EXPECT_EQ(scenario.keeper.guard.reaction_s, 0.4);
  EXPECT_TRUE(scenario.keeper.enabled);
  scenario.keeper = {};
  EXPECT_EQ(to_toml_text(scenario), to_toml_text(sim::Scenario{}));
}

TEST(ChangedWorld, ABadLineIsNamedWithItsKeyAndValue) {
  const auto said = [](const std::string& line) -> std::string {
    sim::Scenario scenario;
    try {
      override_scenario(scenario, line, "--world");
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(said("keeper.reaction_s = 9"), "--world:1: keeper.reaction_s = 9: must lie in [0, 5]");
  EXPECT_EQ(said("keeper.reactions = 1"), "--world:1: keeper.reactions: unknown key; did you mean reaction_s?");
  EXPECT_NE(said("possession.speed_min_mps = 5").find("the minimum 5 is above the maximum 2"), std::string::npos);
  EXPECT_NE(said("defenders.count = 1.5").find("no whole number"), std::string::npos);
  EXPECT_NE(said("keeper.reaction_s").find("--world"), std::string::npos);
}

TEST(Errors, AFileWithoutEndIsNotRead) {
  EXPECT_THAT([] { parse_file("/dev/zero"); }, testing::ThrowsMessage<Error>("/dev/zero: more than 1 MB: not read"));
  const Scratch scratch;
  EXPECT_THAT([&] { parse_file(scratch.file("a = \"" + std::string(2 << 20, 'x') + "\"")); },
              testing::ThrowsMessage<Error>(HasSubstr("bad.toml: more than 1 MB: not read")));
}

}  // namespace
}  // namespace trivela::config
