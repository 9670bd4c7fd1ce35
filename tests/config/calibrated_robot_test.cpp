// A robot's file with its provenance, angles of their own and true tables.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "config/robot.hpp"
#include "config/text/error.hpp"
#include "config/text/installation.hpp"
#include "kicking/ballistics/crossing.hpp"
#include "tests/support/folder.hpp"

namespace trivela::config {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

class CalibratedRobot : public testing::Test {
 protected:
  fs::path file(const std::string& text) const {
    const fs::path path = folder_ / "robot.toml";
    std::ofstream{path} << text;
    return path;
  }

 private:
  tests::Folder folder_;
};

const std::string kTable = "[table]\nkind = \"effective\"\npowers = [10.0, 20.0]\nexit_speeds_mps = [5.0, 7.0]\n";

/// Every key of [calibration] with a value of its own.
Robot fully_calibrated() {
  Robot robot;
  robot.name = "seven";
  Calibration& c = robot.calibration.emplace();
  c.source = "trivela calibrate \"table\"";
  c.date = "2015-04-13";
  c.kicks = 61;
  const std::vector<double> sds{0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.0};
  c.table = TableOrigin{{"2015-04-11", 15, {"lobs 1.db", "lobs_2.db"}}, {2, 2, 2, 2, 2, 2, 2, 1}, sds, 0.0425, true};
  c.exit_angle = ExitAngleOrigin{{"2015-04-12", 16, {"angles.csv"}}, 0.001, 0.02};
  c.deflection = DeflectionOrigin{{"2015-04-13", 17, {}}, 0.003, 0.01, 0.125};
  c.rotation = RotationOrigin{{"2015-04-14", 18, {"turns.csv"}}, 0.0025, 0.011};
  c.transfer = TransferOrigin{{"2015-04-15", 19, {"runs.csv"}}, 0.1, 0.2, 0.3, 0.4};
  c.delay = DelayOrigin{{"2015-04-16", 20, {"runs.csv"}}, 0.0004, 0.0021};
  c.direction = DirectionOrigin{{"2015-04-17", 21, {"stand.db"}}, 0.001, 0.002};
  return robot;
}

TEST_F(CalibratedRobot, ReadsBackWithAllItsProvenance) {
  const Robot robot = fully_calibrated();
  const std::string text = to_toml_text(robot);
  const Robot again = load_robot(file(text));
  EXPECT_EQ(to_toml_text(again), text);
  const Calibration& c = *again.calibration;
  EXPECT_EQ(c.source, "trivela calibrate \"table\"");
  EXPECT_EQ(c.kicks, 61u);
  EXPECT_THAT(c.table->files, testing::ElementsAre("lobs 1.db", "lobs_2.db"));
  EXPECT_THAT(c.table->trials, testing::ElementsAre(2, 2, 2, 2, 2, 2, 2, 1));
  EXPECT_EQ(c.table->exit_speed_sds_mps[2], 0.03);
  EXPECT_TRUE(c.table->isotonic);
  EXPECT_NEAR(c.exit_angle->exit_angle_se_rad, 0.001, 1e-12);
  EXPECT_EQ(c.deflection->lateral_ratio_se, 0.125);
  EXPECT_EQ(c.rotation->date, "2015-04-14");
  EXPECT_EQ(c.transfer->paper_backward_se_ratio, 0.4);
  EXPECT_EQ(c.delay->delay_sd_s, 0.0021);
}

TEST_F(CalibratedRobot, SaysNothingOfFiguresThatWereNotMeasured) {
  Robot robot;
  robot.calibration.emplace().delay = DelayOrigin{{"2015-04-16", 20, {}}, 0.0004, 0.0021};
  const std::string text = to_toml_text(robot);
  EXPECT_THAT(text, AllOf(HasSubstr("[calibration.delay]"), Not(HasSubstr("[calibration.table]"))));
  EXPECT_FALSE(load_robot(file(text)).calibration->table);
  EXPECT_THAT(to_toml_text(Robot{}), AllOf(Not(HasSubstr("calibration")), Not(HasSubstr("exit_angles_deg"))));
  EXPECT_FALSE(load_robot(file(kTable)).calibration);
}

TEST_F(CalibratedRobot, HasAnAngleForEachPowerWhereTheFileDoes) {
  const Robot robot = load_robot(file(kTable + "exit_angles_deg = [44.0, 40.0]\n"));
  ASSERT_TRUE(robot.model.exit_angles);
  EXPECT_NEAR(kicking::degrees(robot.model.exit_angle_at(15.0)), 42.0, 1e-12);
  EXPECT_EQ(to_toml_text(load_robot(file(to_toml_text(robot)))), to_toml_text(robot));
  EXPECT_EQ(load_robot(file(kTable)).model.exit_angle_at(15.0), kicking::RobotModel{}.exit_angle_rad);
}

TEST_F(CalibratedRobot, NamesAnglesThatDoNotFitTheTable) {
  EXPECT_THAT([&] { load_robot(file(kTable + "exit_angles_deg = [44.0]\n")); },
              ThrowsMessage<Error>(HasSubstr("table.powers has 2 entries, table.exit_angles_deg 1")));
  EXPECT_THAT([&] { load_robot(file(kTable + "exit_angles_deg = [44.0, 95.0]\n")); },
              ThrowsMessage<Error>(AllOf(HasSubstr("robot.toml:5"), HasSubstr("must lie in [0, 80]"))));
}

TEST_F(CalibratedRobot, NamesTheLineOfASetPointThatDoesNotRise) {
  const auto refused = [&](const std::string& text, const std::string& says) {
    EXPECT_THAT([&] { load_robot(file(text)); }, ThrowsMessage<Error>(HasSubstr(says)));
  };
  refused("[table]\npowers = [20.0, 15.0]\nexit_speeds_mps = [5.0, 6.0]\n",
          "robot.toml:2: table.powers = [ 20.0, 15.0 ]: [1] must be above 20");
  refused("[table]\npowers = [0.0, 15.0]\nexit_speeds_mps = [5.0, 6.0]\n",
          ":2: table.powers = [ 0.0, 15.0 ]: [0] must be above 0");
  refused(kTable + "[[kinds]]\n[kinds.table]\npowers = [20.0, 25.0]\nexit_speeds_mps = [5.0, 5.0]\n",
          "kinds[0].table.exit_speeds_mps = [ 5.0, 5.0 ]: [1] must be above 5");
  refused("[height_table]\ndistances_m = [3.0, 4.0]\npowers = [22.0, 17.0]\n", ":3: height_table.powers = ");
}

TEST_F(CalibratedRobot, NamesTheFiguresThatItsFileLeavesToTheDefaults) {
  EXPECT_THAT(defaulted_figures(file(kTable)), testing::ElementsAre("base", "kicker"));
  EXPECT_THAT(
      defaulted_figures(file(kTable + "[kicker]\ndelay_s = 0.06\n[[kinds]]\n[kinds.kicker]\nexit_angle_deg = 8.0\n")),
      AllOf(testing::Contains("base"), testing::Contains("kicker.beta_slope_s"),
            testing::Contains("kinds[0].kicker.delay_s"), testing::Contains("kinds[0].kicker.spreads"),
            Not(testing::Contains("kicker.delay_s")), Not(testing::Contains("kicker.direction_deg")),
            Not(testing::Contains("kinds[0].kicker.ball_mass_kg"))));
  EXPECT_THAT(defaulted_figures(shipped("robots/cambada_1.toml")), testing::IsEmpty());
}

TEST_F(CalibratedRobot, HasTheLeversHeightOfItsTable) {
  const Robot robot = load_robot(file(kTable + "levers = [120, 120]\n"));
  EXPECT_EQ(robot.lever, 120);
  EXPECT_EQ(load_robot(file(to_toml_text(robot))).lever, 120);
  EXPECT_EQ(load_robot(file(kTable)).lever, std::nullopt);
  EXPECT_THAT([&] { load_robot(file(kTable + "levers = [120, 130]\n")); },
              ThrowsMessage<Error>(HasSubstr("table.levers[1] = 130, but [0] = 120")));
  EXPECT_THAT([&] { load_robot(file(kTable + "levers = [120]\n")); },
              ThrowsMessage<Error>(HasSubstr("table.powers has 2 entries, table.levers 1")));
  EXPECT_THAT([&] { load_robot(file(kTable + "levers = [12.5, 12.5]\n")); },
              ThrowsMessage<Error>(HasSubstr("no step")));
  EXPECT_THAT([&] { load_robot(file(kTable + "levers = [206, 206]\n")); },
              ThrowsMessage<Error>(HasSubstr("must lie in [0, 205]")));
}

TEST_F(CalibratedRobot, PutsItsLeverWhereTheTableWasMeasured) {
  const Robot robot = load_robot(file(kTable + "levers = [120, 120]\n"));
  Hal devices;
  EXPECT_EQ(text_of(hal_for(devices, robot).kicker), "bus") << "which has none";
  devices.kicker = IoBoardDevice{};
  EXPECT_EQ(std::get<IoBoardDevice>(hal_for(devices, robot).kicker).lever, 120);
  EXPECT_EQ(std::get<IoBoardDevice>(hal_for(devices, Robot{}).kicker).lever, std::nullopt);
  std::get<IoBoardDevice>(devices.kicker).lever = 120;
  EXPECT_NO_THROW(hal_for(devices, robot));
  std::get<IoBoardDevice>(devices.kicker).lever = 100;
  EXPECT_THAT([&] { hal_for(devices, robot); },
              ThrowsMessage<Error>(HasSubstr("hal.ioboard.lever = 100, but the table of robot")));
}

const std::string kFlat =
    "[[kinds]]\nname = \"flat\"\n[kinds.table]\npowers = [12.0, 22.0, 30.0]\nexit_speeds_mps = [6.0, 8.0, 9.0]\n"
    "[kinds.kicker]\nexit_angle_deg = 6.0\ndelay_s = 0.05\n";

TEST_F(CalibratedRobot, HasAWholeModelForEachKindOfKick) {
  const Robot robot = load_robot(file(kTable + "[kicker]\ndelay_s = 0.07\nball_offset_m = 0.25\n" + kFlat));
  ASSERT_EQ(robot.model.kinds(), 2u);
  const kicking::RobotModel& flat = robot.model.kind(1);
  EXPECT_EQ(robot.model.delay_s, 0.07);
  EXPECT_EQ(flat.delay_s, 0.05);
  EXPECT_EQ(flat.table.back().power, 30.0);
  EXPECT_NEAR(flat.exit_angle_rad, kicking::radians(6.0), 1e-12);
  EXPECT_EQ(flat.ball_offset_m, 0.25) << "what the kind does not name is the first one's";
  EXPECT_EQ(flat.spreads.direction_sd_rad, robot.model.spreads.direction_sd_rad);
  const std::string text = to_toml_text(robot);
  EXPECT_EQ(to_toml_text(load_robot(file(text))), text);
  EXPECT_THAT(text, HasSubstr("\n[[kinds]]\nname = \"flat\""));
}

TEST_F(CalibratedRobot, NamesTheKindOfKickThatDoesNotFit) {
  const auto refuses = [&](const std::string& kinds, const std::string& words) {
    EXPECT_THAT([&] { load_robot(file(kTable + kinds)); },
                ThrowsMessage<Error>(AllOf(HasSubstr("robot.toml"), HasSubstr(words))));
  };
  refuses("[[kinds]]\nname = \"flat\"\n", "kinds[0] has no [kinds.table]");
  refuses(kFlat + "ball_offset_m = 0.3\n", "kinds[0]: ball and ball_offset_m are the robot's");
  refuses(kFlat + "exit_angel_deg = 3.0\n", "exit_angel_deg");
  refuses(kFlat + kFlat + kFlat + kFlat, "a robot has 4 kinds of kick at most");
  refuses("[kinds]\nname = \"flat\"\n", "expected an array");
  EXPECT_THAT([&] { load_robot(file(kTable + "levers = [120, 120]\n" + kFlat)); },
              ThrowsMessage<Error>(HasSubstr("either each kind of kick has table.levers, or none")));
}

TEST_F(CalibratedRobot, TellsABoardTheLeversOfAllKinds) {
  std::string flat = kFlat;
  flat.insert(flat.find("[kinds.kicker]"), "levers = [20, 20, 20]\n");
  const Robot robot = load_robot(file(kTable + "levers = [120, 120]\n[kicker]\nlever_s = 0.15\n" + flat));
  Hal devices;
  devices.kicker = IoBoardDevice{};
  const auto board = std::get<IoBoardDevice>(hal_for(devices, robot).kicker);
  EXPECT_THAT(board.levers, testing::ElementsAre(120, 20));
  EXPECT_EQ(board.lever_s, 0.15);
}

TEST_F(CalibratedRobot, OfATrueTableIsForTheToolsAlone) {
  Robot robot;
  robot.true_table.emplace({kicking::SetPoint{10, 5.1}, kicking::SetPoint{20, 7.2}});
  const std::string text = to_toml_text(robot);
  EXPECT_THAT(text, HasSubstr("kind = \"true\""));
  const Robot again = load_robot_of_any_table(file(text));
  EXPECT_EQ(again.true_table->back().speed_mps, 7.2);
  EXPECT_EQ(to_toml_text(again), text);
  EXPECT_THAT([&] { load_robot(file(text)); },
              ThrowsMessage<Error>(AllOf(HasSubstr("robot.toml"), HasSubstr("effective"))));
}

TEST_F(CalibratedRobot, PlaysWithAHeightTableWhereTheFileHasOne) {
  const std::string text = "[height_table]\ndistances_m = [3.0, 5.0, 7.0]\npowers = [17.0, 22.0, 29.0]\n";
  const Robot robot = load_robot(file(text));
  ASSERT_EQ(robot.model.table.set_points().size(), 3u);
  EXPECT_EQ(robot.model.table.front().power, 17.0);
  EXPECT_EQ(to_toml_text(load_robot(file(to_toml_text(robot)))), to_toml_text(robot));
  EXPECT_THAT([&] { load_robot(file(text + kTable)); }, ThrowsMessage<Error>(HasSubstr("not both")));
  EXPECT_THAT([&] { load_robot(file("name = \"none\"\n")); }, ThrowsMessage<Error>(HasSubstr("needs one table")));
  EXPECT_THAT([&] { load_robot(file("[height_table]\ndistances_m = [3.0]\npowers = [17.0, 22.0]\n")); },
              ThrowsMessage<Error>(HasSubstr("height_table.distances_m has 1 entries, height_table.powers 2")));
  EXPECT_THAT([&] { load_robot(file("[height_table]\ndistances_m = [3.0, 4.0]\npowers = [22.0, 17.0]\n")); },
              ThrowsMessage<Error>(HasSubstr("height_table.powers = [ 22.0, 17.0 ]: [1] must be above 22")));
}

TEST_F(CalibratedRobot, ReadsAHeightTableByTheLawAndHeightOfThePolicy) {
  const std::string text =
      "name = \"hand\"\n[height_table]\ndistances_m = [3.0, 5.0, 7.0]\npowers = [17.0, 22.0, 29.0]\n";
  const Robot robot = load_robot(file(text));
  Settings settings;
  kicking::PolicyConfig& policy = settings.policy;
  EXPECT_EQ(robot_for(robot, settings).model.table.back().speed_mps, robot.model.table.back().speed_mps);
  policy.height_law = kicking::HeightLaw::kExact;
  const Robot other = robot_for(robot, settings);
  const kicking::RobotModel& model = other.model;
  EXPECT_NE(model.table.back().speed_mps, robot.model.table.back().speed_mps);
  const auto asked_mps =
      kicking::crossing_speed({5.0, policy.target_height_m - kicking::Ball{}.radius_m}, model.exit_angle_rad);
  EXPECT_NEAR(model.table.power_for(*asked_mps).power, 22.0, 1e-9) << "at rest the table's power";
  EXPECT_EQ(to_toml_text(other), to_toml_text(robot)) << "the file is what it was";
  policy.target_height_m = 50.0;
  EXPECT_THAT([&] { robot_for(robot, settings); },
              ThrowsMessage<Error>(AllOf(HasSubstr("robot hand"), HasSubstr("no speed reaches the target's height"))));
  EXPECT_EQ(to_toml_text(robot_for(Robot{}, settings)), to_toml_text(Robot{})) << "no height table";
}

TEST(HeightTableLaw, IsThePlayingOneWhereSomebodyInChargeAimsByIt) {
  using enum kicking::PolicyName;
  Settings settings;
  settings.policy.height_law = kicking::HeightLaw::kPaper;
  EXPECT_EQ(height_table_law(settings), kicking::HeightLaw::kPaper) << "moving";
  settings.kick_decision.policy_by_half = {kPredictive, kOracle};
  EXPECT_EQ(height_table_law(settings), kicking::HeightLaw::kExact);
  settings.kick_decision.policy_by_robot = {kPredictive, kStopped};
  EXPECT_EQ(height_table_law(settings), kicking::HeightLaw::kPaper);
  settings.kick_decision.random = {kPredictive, kLearned};
  EXPECT_EQ(height_table_law(settings), kicking::HeightLaw::kExact) << "who is drawn is in charge";
}

TEST_F(CalibratedRobot, NamesBrokenProvenance) {
  const auto load = [&](const std::string& calibration) {
    return [this, calibration] { load_robot(file(kTable + "[calibration]\n" + calibration)); };
  };
  EXPECT_THAT(load("kick = 3\n"), ThrowsMessage<Error>(HasSubstr("calibration.kick: unknown key")));
  EXPECT_THAT(load("[calibration.delay]\nkicks = -3\n"), ThrowsMessage<Error>(HasSubstr("calibration.delay.kicks")));
  EXPECT_THAT(load("[calibration.delay]\nfiles = [3]\n"), ThrowsMessage<Error>(HasSubstr("expected strings")));
  EXPECT_THAT(load("[calibration.table]\ntrials = [1.5, 2]\n"),
              ThrowsMessage<Error>(HasSubstr("expected whole numbers")));
  EXPECT_THAT(load("[calibration.table]\ntrials = \"two\"\n"), ThrowsMessage<Error>(HasSubstr("expected an array")));
}

TEST_F(CalibratedRobot, KeepsAnyTextOfItsSource) {
  Robot robot;
  robot.source = "two\nlines, a \"quote\", a \\ and a\ttab";
  EXPECT_EQ(load_robot(file(to_toml_text(robot))).source, robot.source);
}

}  // namespace
}  // namespace trivela::config
