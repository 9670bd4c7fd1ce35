#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "calibration/robot_update.hpp"
#include "calibration/rows/trials.hpp"
#include "cli/calibrate/robot_file.hpp"
#include "cli/verbs.hpp"
#include "config/robot.hpp"
#include "config/text/error.hpp"
#include "kicking/geometry/angle.hpp"
#include "tests/support/folder.hpp"

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// The verb in an empty current folder.
class CalibrateVerb : public testing::Test {
 protected:
  struct Result {
    std::string out;
    std::string err;  ///< with the sentence of what was thrown
    int exit_code = -1;
  };

  CalibrateVerb() : before_(fs::current_path()) { fs::current_path(folder_.path()); }
  ~CalibrateVerb() override { fs::current_path(before_); }

  static void write(const std::string& file, const std::string& text) { std::ofstream{file} << text; }
  static std::string text_of(const std::string& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static std::vector<std::string> files() {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(".")) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }

  static Result run(const std::string& arguments) {
    CLI::App app;
    Result result;
    add_calibrate_table(app, result.exit_code);
    add_calibrate_deflection(app, result.exit_code);
    add_calibrate_rotation(app, result.exit_code);
    add_calibrate_transfer(app, result.exit_code);
    add_calibrate_delay(app, result.exit_code);
    add_calibrate_plot(app, result.exit_code);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    std::string thrown;
    try {
      app.parse(arguments);
    } catch (const config::BadArgument& error) {
      result.exit_code = kBadUsage;
      thrown = error.what();
    } catch (const CLI::ParseError& error) {
      result.exit_code = kBadUsage;
      thrown = error.what();
    } catch (const std::exception& error) {
      result.exit_code = kFailed;
      thrown = error.what();
    }
    result.out = testing::internal::GetCapturedStdout();
    result.err = testing::internal::GetCapturedStderr() + thrown;
    return result;
  }

 private:
  fs::path before_;
  tests::Folder folder_;
};

const std::string kLobs =
    "# two kicks a set-point\npower,height_m,distance_m\n15,0.65,3.5\n15,0.65,3.5\n25,1.25,6.66\n25,1.25,6.66\n";

TEST_F(CalibrateVerb, TableOfLobsIsTheRobotsFile) {
  write("lobs.csv", kLobs);
  const Result result = run("table lobs.csv --robot seven");
  ASSERT_EQ(result.exit_code, kDone) << result.err;
  const config::Robot robot = config::load_robot("seven.toml");
  EXPECT_EQ(robot.name, "seven");
  EXPECT_NEAR(robot.model.table.front().speed_mps, 5.988580, 1e-5);  // calib_theta_v0.csv
  EXPECT_NEAR(robot.model.table.back().speed_mps, 8.248506, 1e-5);
  EXPECT_NEAR(kicking::degrees(robot.model.exit_angle_rad), 0.5 * (36.607075 + 36.897417), 1e-5);
  EXPECT_FALSE(robot.model.exit_angles);
  const config::Calibration& calibration = *robot.calibration;
  EXPECT_EQ(calibration.kicks, 4u);
  EXPECT_EQ(calibration.source, "trivela calibrate table");
  EXPECT_EQ(calibration.date, today());
  EXPECT_THAT(calibration.table->files, ElementsAre("lobs.csv"));
  EXPECT_THAT(calibration.table->trials, ElementsAre(2, 2));
  EXPECT_THAT(
      text_of("seven.toml"),
      AllOf(StartsWith("# Robot seven, written by trivela calibrate table on "),
            HasSubstr("# Measured: table (4 kicks), exit angle (4 kicks)."),
            HasSubstr(
                "# Not measured, kept as they were: alpha, beta, transfer, delay, sideways scatter, ball, wheels.")));
  EXPECT_THAT(result.out, AllOf(HasSubstr("Written: seven.toml"), HasSubstr("kicker.exit_angle_deg 36.78 -> 36.7522")));
}

TEST_F(CalibrateVerb, TableJsonHasTheAgreedKeys) {
  write("lobs.csv", kLobs);
  const json result = json::parse(run("table lobs.csv --robot seven --json").out);
  ASSERT_EQ(result["setpoints"].size(), 2u);
  const json& point = result["setpoints"][1];
  EXPECT_EQ(point.size(), 5u);
  EXPECT_EQ(point["power"], 25.0);
  EXPECT_EQ(point["trials"], 2);
  EXPECT_NEAR(point["exit_speed_mps"].get<double>(), 8.248506, 1e-6);
  EXPECT_NEAR(point["exit_angle_deg"].get<double>(), 36.897417, 1e-6);
  EXPECT_EQ(point["exit_speed_sd_mps"], 0.0);
  EXPECT_NEAR(result["exit_angle_deg"].get<double>(), 36.752246, 1e-6);
  EXPECT_EQ(result["exit_angle_sds_deg"].size(), 2u);
  EXPECT_TRUE(result["warnings"].empty());
}

TEST_F(CalibrateVerb, TableOfCommasMayHaveCommentsAnywhere) {
  write("lobs.csv",
        "  # a calibration\npower,height_m,distance_m # of the centre\n15,0.65,3.5 # first\n   \n25,1.25,6.66\n");
  const Result result = run("table lobs.csv --robot seven --json");
  ASSERT_EQ(result.exit_code, kDone) << result.err;
  EXPECT_EQ(json::parse(result.out)["setpoints"].size(), 2u);
  write("wrong.csv", "# one\npower,height_m,distance_m\n15,0.65,3.5\n25,x,6.66\n");
  EXPECT_THAT(run("table wrong.csv --robot eight").err, HasSubstr("wrong.csv:4: column height_m: 'x'"));
}

TEST_F(CalibrateVerb, ATrueTableDoesNotReplaceACalibratedOne) {
  write("speeds.csv", "power,exit_speed_mps,exit_angle_deg\n10,5,40\n20,7,40\n");
  ASSERT_EQ(run("table speeds.csv --robot seven").exit_code, kDone);
  EXPECT_NE(run("table speeds.csv --robot seven --kind true").exit_code, kDone);
  EXPECT_NO_THROW(config::load_robot("seven.toml"));
}

TEST_F(CalibrateVerb, ANewRobotHasNoKicksOfTheOneItStartsFrom) {
  write("speeds.csv", "power,exit_speed_mps,exit_angle_deg\n10,5,40\n20,7,40\n");
  write("t1.csv", "vx_mps,d_m,b_m\n0.5,6,0.5\n1,6,1\n2,6,1.8\n");
  ASSERT_EQ(run("table speeds.csv --robot seven").exit_code, kDone);
  ASSERT_EQ(run("deflection t1.csv --robot seven --out seven.toml").exit_code, kDone);
  ASSERT_EQ(run("table speeds.csv --robot eight --base seven").exit_code, kDone);
  EXPECT_FALSE(config::load_robot("eight.toml").calibration->deflection);
}

TEST_F(CalibrateVerb, TableGoesToTheRobotsFolderWhereThereIsOne) {
  fs::create_directories("config/robots");
  write("lobs.csv", kLobs);
  EXPECT_EQ(run("table lobs.csv --robot seven").exit_code, kDone);
  EXPECT_TRUE(fs::exists("config/robots/seven.toml"));
  EXPECT_EQ(find_robot("seven"), fs::path("config/robots/seven.toml"));
  EXPECT_EQ(run("table lobs.csv --robot seven --out elsewhere.toml").exit_code, kDone);
  EXPECT_TRUE(fs::exists("elsewhere.toml"));
}

TEST_F(CalibrateVerb, TableReadsBlanksCommentsAndColumnsByPlace) {
  write("lobs.txt", "  # nr power height distance\n1 15 0.65 3.5  # first\n\n2 25 1.25 6.66\n");
  const Result result = run("table lobs.txt --robot seven --columns -,power,height_m,distance_m --json");
  ASSERT_EQ(result.exit_code, kDone) << result.err;
  const json parsed = json::parse(result.out);
  EXPECT_NEAR(parsed["setpoints"][0]["exit_speed_mps"].get<double>(), 5.988580, 1e-6);
  EXPECT_TRUE(parsed["setpoints"][0]["exit_speed_sd_mps"].is_null());
  EXPECT_THAT(parsed["warnings"].dump(), HasSubstr("power 15: a single trial"));
}

TEST_F(CalibrateVerb, TableOfSpeedsTakesOneAngleOrAColumn) {
  write("speeds.csv", "power,exit_speed_mps\n10,5\n20,7\n");
  write("both.csv", "power,exit_speed_mps,exit_angle_deg\n10,5,40\n20,7,41\n");
  const Result flag = run("table speeds.csv --robot seven --exit-angle-deg 36.5");
  ASSERT_EQ(flag.exit_code, kDone) << flag.err;
  EXPECT_NEAR(kicking::degrees(config::load_robot("seven.toml").model.exit_angle_rad), 36.5, 1e-9);
  ASSERT_EQ(run("table both.csv --robot eight").exit_code, kDone);
  EXPECT_NEAR(kicking::degrees(config::load_robot("eight.toml").model.exit_angle_rad), 40.5, 1e-9);
}

TEST_F(CalibrateVerb, TableKeepsAnglesApartWhenAsked) {
  write("falcons.csv", "power,exit_speed_mps,exit_angle_deg\n50,3,47\n90,6,44\n150,8.4,42\n");
  EXPECT_THAT(run("table falcons.csv --robot f").out, HasSubstr("differs by 5 degrees from set-point to set-point"));
  const Result apart = run("table falcons.csv --robot f --angle per-setpoint");
  EXPECT_THAT(apart.out, Not(HasSubstr("from set-point to set-point: one mean")));
  const config::Robot robot = config::load_robot("f.toml");
  EXPECT_NEAR(kicking::degrees(robot.model.exit_angle_at(70)), 45.5, 1e-9);
  EXPECT_EQ(run("table falcons.csv --robot f").exit_code, kDone);
  EXPECT_FALSE(config::load_robot("f.toml").model.exit_angles);
}

TEST_F(CalibrateVerb, TableThatDoesNotRiseIsNamedAndNotWritten) {
  write("lobs.csv", "power,exit_speed_mps,exit_angle_deg\n10,5,40\n20,7,40\n30,6.4,40\n40,8,40\n");
  const Result result = run("table lobs.csv --robot seven --json");
  EXPECT_EQ(result.exit_code, kFailed);
  EXPECT_THAT(result.err, AllOf(HasSubstr("power 30 (1 trial) does not kick faster"), HasSubstr("nothing is written")));
  EXPECT_EQ(json::parse(result.out)["not_rising_powers"], json::array({30.0}));
  EXPECT_THAT(files(), ElementsAre("lobs.csv"));
  ASSERT_EQ(run("table lobs.csv --robot seven --isotonic").exit_code, kDone);
  const config::Robot robot = config::load_robot("seven.toml");
  EXPECT_NEAR(robot.model.table.set_points()[1].speed_mps, 6.7, 0.0011);
  EXPECT_TRUE(robot.calibration->table->isotonic);
}

TEST_F(CalibrateVerb, TrueTableIsWrittenAndRefusedByPolicies) {
  write("speeds.csv", "power,exit_speed_mps,exit_angle_deg\n10,5,40\n20,7,40\n");
  ASSERT_EQ(run("table speeds.csv --robot seven --kind true").exit_code, kDone);
  EXPECT_TRUE(config::load_robot_of_any_table("seven.toml").true_table);
  EXPECT_THROW(config::load_robot("seven.toml"), std::runtime_error);
  ASSERT_EQ(run("table speeds.csv --robot seven").exit_code, kDone);
  EXPECT_NO_THROW(config::load_robot("seven.toml"));
}

TEST_F(CalibrateVerb, FiguresComeTogetherInOneFile) {
  write("lobs.csv", kLobs);
  write("t1.csv", "vx_mps,d_m,b_m\n0.5,6,0.5\n1,6,1\n2,6,1.8\n");
  write("turns.csv", "omega_degps,b_m\n30,0.5\n60,1.0\n90,1.55\n");
  write("delays.csv", "order_t_s,release_t_s\n1,1.05\n2,2.052\n3,3.054\n4,4.5\n");
  write("runs.csv", "vy_mps,power,d_m,z_cross_m\n1,25,5.73,0.95\n1,25,5.73,0.97\n-1,25,5.73,0.5\n-1,25,5.73,0.48\n");
  ASSERT_EQ(run("table lobs.csv --robot seven").exit_code, kDone);
  for (const char* const verb : {"deflection t1.csv", "rotation turns.csv", "delay delays.csv", "transfer runs.csv"}) {
    const Result result = run(std::string(verb) + " --robot seven --out seven.toml");
    ASSERT_EQ(result.exit_code, kDone) << verb << ": " << result.err;
    EXPECT_THAT(result.out, HasSubstr("Written to seven.toml")) << verb;
  }
  const config::Robot robot = config::load_robot("seven.toml");
  EXPECT_NEAR(kicking::degrees(robot.model.alpha_slope_rad_per_mps), 8.61764, 1e-9);
  EXPECT_NEAR(robot.model.delay_s, 0.052, 1e-9);
  EXPECT_NEAR(robot.model.table.front().speed_mps, 5.98858, 1e-12);
  const config::Calibration& calibration = *robot.calibration;
  EXPECT_EQ(calibration.source, "trivela calibrate transfer");
  EXPECT_EQ(calibration.delay->kicks, 3u);
  EXPECT_EQ(calibration.rotation->kicks, 3u);
  EXPECT_EQ(calibration.transfer->kicks, 4u);
  EXPECT_TRUE(calibration.transfer->exact_backward_se_ratio);
  EXPECT_EQ(calibration.kicks, 4u + 3u + 3u + 4u + 3u);
  EXPECT_THAT(
      text_of("seven.toml"),
      AllOf(HasSubstr("# Not measured, kept as they were: sideways scatter, ball, wheels."),
            HasSubstr("exit_speeds_mps = [5.98858, 8.24851]\n"), HasSubstr("alpha_slope_deg_per_mps = 8.61764\n"),
            HasSubstr("alpha_slope_se_deg_per_mps = 0.339\n")));
}

TEST_F(CalibrateVerb, FigureGoesIntoNoFileUnlessAsked) {
  write("t1.csv", "vx_mps,d_m,b_m\n0.5,6,0.5\n1,6,1\n2,6,1.8\n");
  EXPECT_EQ(run("deflection t1.csv --robot cambada_1").exit_code, kDone);
  EXPECT_THAT(files(), ElementsAre("t1.csv"));
}

TEST_F(CalibrateVerb, DeflectionOfTable1SaysThePapersLineAndThePhysicalModel) {
  write("t1.csv", "vx_mps,d_m,b_m\n0.5,6,0.5\n1,6,1\n2,6,1.8\n");
  const json result = json::parse(run("deflection t1.csv --v-h-mps 6.613 --delay-s 0.08 --json").out);
  EXPECT_NEAR(result["line"]["slope_deg_per_mps"].get<double>(), 8.617644, 1e-6);
  EXPECT_NEAR(result["physical"]["travel_s"].get<double>(), 0.923810, 1e-6);
  EXPECT_NEAR(result["rows"][1]["line_residual_deg"].get<double>(), 0.844678, 1e-6);
  EXPECT_NEAR(result["rows"][2]["physical_residual_deg"].get<double>(), -0.416265, 1e-6);
  EXPECT_NEAR(result["transfer"]["lateral_ratio"].get<double>(), 0.93, 0.01);
  EXPECT_THAT(run("deflection t1.csv").out,
              AllOf(HasSubstr("alpha = 8.618 +- 0.34 degrees per m/s, rms 0.634"), HasSubstr("T = 0.9238 +- 0.03 s")));
}

TEST_F(CalibrateVerb, RotationTellsDelayAndLeverApart) {
  write("turns.csv", "omega_radps,allowed_error_m,d_m,v_h_mps\n1,0.85,8,7.5\n-2,1.75,8,7.5\n");
  const json result = json::parse(run("rotation turns.csv --json --cycle-s 0.02 --ball-offset-m 0.27").out);
  const double line = result["line"]["slope_s"].get<double>();
  EXPECT_NEAR(line, 0.1073, 0.001);
  EXPECT_NEAR(result["physical"]["delay_s"].get<double>(), line - 0.01 - 0.036, 1e-3);
  write("plain.csv", "omega_degps,b_m\n30,0.6\n60,1.1\n");
  EXPECT_THAT(run("rotation plain.csv").out, HasSubstr("not told apart"));
}

TEST_F(CalibrateVerb, ChartsAreWrittenWhereAsked) {
  write("lobs.csv", kLobs);
  write("t1.csv", "vx_mps,d_m,b_m\n0.5,6,0.5\n1,6,1\n2,6,1.8\n");
  write("turns.csv", "omega_degps,b_m\n30,0.5\n60,1.0\n");
  EXPECT_EQ(run("deflection t1.csv --plot 8.svg").exit_code, kDone);
  EXPECT_EQ(run("rotation turns.csv --plot 10.svg").exit_code, kDone);
  const json numbers = json::parse(run("plot lobs.csv --out 5.svg --json").out);
  EXPECT_THAT(text_of("5.svg"), AllOf(HasSubstr(">p15-1<"), HasSubstr(">p25-2<"), HasSubstr("[m]")));
  EXPECT_THAT(text_of("8.svg"), HasSubstr("[m/s]"));
  EXPECT_THAT(text_of("10.svg"), HasSubstr("[degrees/s]"));
  EXPECT_NEAR(numbers["setpoints"][1]["distance_m"].get<double>(), 6.66, 1e-9);
  EXPECT_NEAR(numbers["setpoints"][1]["height_m"].get<double>(), 1.25, 1e-9);
  EXPECT_THAT(run("plot lobs.csv --out 5.svg --csv").out, StartsWith("power,trials,exit_speed_mps,"));
}

TEST_F(CalibrateVerb, DeflectionsToTheOtherSideAreWarnedOf) {
  write("left.csv", "vx_mps,d_m,b_m\n0.5,6,-0.5\n1,6,-1.0\n2,6,-1.8\n");
  EXPECT_THAT(run("deflection left.csv --robot cambada_1").out,
              HasSubstr("the ball goes against the robot's motion in 3 of 3 rows: are vx_mps and b_m positive to the "
                        "right?"));
  write("right.csv", "vx_mps,d_m,b_m\n0.5,6,0.5\n-1,6,-1.0\n2,6,1.8\n");
  EXPECT_THAT(run("deflection right.csv --robot cambada_1").out, testing::Not(HasSubstr("against")));
}

TEST_F(CalibrateVerb, LengthsInCentimetresAreNamedWithTheirRow) {
  write("lobs.csv", "power,height_m,distance_m\n15,0.6,3.3\n20,95,505\n");
  const Result cm = run("table lobs.csv --robot seven");
  EXPECT_EQ(cm.exit_code, kFailed);
  EXPECT_THAT(cm.err, HasSubstr("lobs.csv:3: column height_m: '95' is above 15 m: lengths are in metres"));
  write("far.csv", "power,height_m,distance_m\n15,0.6,330\n");
  EXPECT_THAT(run("table far.csv --robot seven").err, HasSubstr("far.csv:2: column distance_m: '330' is above 40 m"));
  write("fast.csv", "power,exit_speed_mps\n15,597\n");
  EXPECT_THAT(run("table fast.csv --robot seven --exit-angle-deg 37").err, HasSubstr("'597' is above 40 m/s"));
  write("t1.csv", "vx_mps,d_m,b_m\n0.5,600,50\n1,600,100\n");
  EXPECT_THAT(run("deflection t1.csv").err, HasSubstr("t1.csv:2: column d_m: '600' is above 40 m"));
  write("mm.csv", "vx_mps,d_m,b_m\n500,6,0.5\n");
  EXPECT_THAT(run("deflection mm.csv").err,
              HasSubstr("mm.csv:2: column vx_mps: '500' is above 10 m/s: speeds are in metres a second"));
  write("wide.csv", "vx_mps,d_m,b_m\n0.5,6,-50\n");
  EXPECT_THAT(run("deflection wide.csv").err, HasSubstr("wide.csv:2: column b_m: '-50' is below -18 m"));
  write("ms.csv", "delay_s\n60\n61\n");
  EXPECT_THAT(run("delay ms.csv --robot cambada_1").err,
              HasSubstr("ms.csv:2: column delay_s: '60' is above 1 s: times are in seconds"));
  write("degrees.csv", "omega_radps,b_m\n90,0.5\n180,1\n");
  EXPECT_THAT(run("rotation degrees.csv").err, HasSubstr("column omega_radps: '90' is above 20 rad/s"));
  write("kmh.csv", "vy_mps,v0_mps,d_m,z_cross_m\n1000,8,6,0.5\n");
  EXPECT_THAT(run("transfer kmh.csv --exit-angle-deg 37").err, HasSubstr("column vy_mps: '1000' is above 10 m/s"));
  write("turns.csv", "omega_degps,b_m,d_m\n30,0.5,600\n60,1.0,600\n");
  EXPECT_THAT(run("rotation turns.csv").err, HasSubstr("turns.csv:2: column d_m: '600' is above 40 m"));
  EXPECT_FALSE(fs::exists("seven.toml"));
}

TEST_F(CalibrateVerb, WhatCannotBeWrittenIsSaidBeforeAnythingIsRead) {
  write("lobs.csv", kLobs);
  for (const std::string arguments :
       {"plot nothing.csv --out no/5.svg", "deflection nothing.csv --plot no/8.svg",
        "rotation nothing.csv --plot no/10.svg", "table nothing.csv --robot seven --out no/seven.toml"}) {
    const Result refused = run(arguments);
    EXPECT_EQ(refused.exit_code, kFailed) << arguments;
    EXPECT_THAT(refused.err, AllOf(HasSubstr("cannot write"), HasSubstr("no/"), HasSubstr("there is no folder no")));
  }
  EXPECT_THAT(run("plot nothing.csv --out .").err, HasSubstr("cannot write --out .: it is a folder"));
  EXPECT_EQ(run("plot nothing.csv --out new.svg").exit_code, kFailed);
  write("old.svg", "a chart");
  EXPECT_EQ(run("plot nothing.csv --out old.svg").exit_code, kFailed);
  EXPECT_EQ(text_of("old.svg"), "a chart") << "what could not be made again stays";
  EXPECT_THAT(files(), testing::ElementsAre("lobs.csv", "old.svg"));
}

TEST(TrialsOfLobs, AreThoseAcceptedWithAPower) {
  using kicking::lob::LobRecord;
  LobRecord good;
  good.power = 20;
  good.effective.emplace();
  good.effective->exit_speed_mps.value = 7.0;
  good.effective->exit_angle_rad.value = 0.64;
  LobRecord rejected = good;
  rejected.refusal = kicking::lob::Refusal::kOperator;
  LobRecord unknown = good;
  unknown.power.reset();
  const calibration::Trials trials =
      calibration::trials_of_lobs({good, rejected, unknown, good}, kicking::TableKind::kEffective, "a.db");
  ASSERT_EQ(trials.trials.size(), 2u);
  EXPECT_EQ(trials.trials[0].exit_speed_mps, 7.0);
  EXPECT_THAT(trials.warnings,
              ElementsAre("a.db: 1 lob left out: no set-point known", "a.db: 1 lob left out: operator"));
  EXPECT_THAT(calibration::trials_of_lobs({good}, kicking::TableKind::kTrue, "a.db").trials, IsEmpty());
}

struct Mistake {
  std::string name;
  std::string arguments;
  int exit_code;
  std::string says;
};

class CalibrateMistake : public CalibrateVerb, public testing::WithParamInterface<Mistake> {};

TEST_P(CalibrateMistake, IsNamedInOneSentenceAndWritesNothing) {
  write("lobs.csv", kLobs);
  write("speeds.csv", "power,exit_speed_mps\n10,5\n20,7\n");
  write("angles.csv", "power,exit_speed_mps,exit_angle_deg\n10,5,40\n20,7,40\n");
  write("word.csv", "power,height_m,distance_m\n15,0.65,3.5\n25,high,6.66\n");
  write("short.csv", "power,height_m,distance_m\n15,0.65\n");
  write("bare.txt", "15 0.65 3.5\n25 1.25 6.66\n");
  write("one.csv", "power,height_m,distance_m\n15,0.65,3.5\n15,0.66,3.5\n");
  write("empty.csv", "# nothing\n");
  write("header.csv", "power,height_m,distance_m\n");
  write("twice.csv", "power,power,height_m,distance_m\n1,1,1,1\n");
  write("t1.csv", "vx_mps,d_m,b_m\n0.5,6,0.5\n1,6,1\n");
  write("still.csv", "vx_mps,d_m,b_m\n0,6,0.5\n0,6,1\n");
  write("runs.csv", "vy_mps,power,d_m,z_cross_m\n1,25,5.73,0.1\n1,25,5.73,0.1\n");
  write("other.toml", config::to_toml_text(config::Robot{}));
  const auto before = files();
  const std::string robot_before = text_of("other.toml");
  const Result result = run(GetParam().arguments);
  EXPECT_EQ(result.exit_code, GetParam().exit_code);
  EXPECT_THAT(result.err, HasSubstr(GetParam().says));
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(files(), before);
  EXPECT_EQ(text_of("other.toml"), robot_before);
}

INSTANTIATE_TEST_SUITE_P(
    Calibrate, CalibrateMistake,
    testing::Values(
        Mistake{"NoRobot", "table lobs.csv", 2, "--robot is required"},
        Mistake{"RobotIsAPath", "table lobs.csv --robot ../seven", 2, "--robot '../seven': a name of letters"},
        Mistake{"FileOfAnotherRobot", "table lobs.csv --robot seven --out other.toml", 2, "of robot 'cambada_1', not"},
        Mistake{"BaseBesideAFile", "table lobs.csv --robot cambada_1 --out other.toml --base cambada_3", 2,
                "--base goes"},
        Mistake{"NoSuchBase", "table lobs.csv --robot seven --base nobody", 1, "no robot nobody"},
        Mistake{"MissingInput", "table nope.csv --robot seven", 1, "cannot read nope.csv"},
        Mistake{"Empty", "table empty.csv --robot seven", 1, "empty.csv: no rows"},
        Mistake{"HeaderAlone", "table header.csv --robot seven", 1, "header.csv: a header and no rows"},
        Mistake{"NoHeader", "table bare.txt --robot seven", 1, "bare.txt:1: the first line names no columns"},
        Mistake{"ColumnTwice", "table twice.csv --robot seven", 1, "column power stands twice"},
        Mistake{"ColumnsTwice", "table bare.txt --robot seven --columns power,power,height_m", 2, "power stands twice"},
        Mistake{"ColumnsTooFew", "table bare.txt --robot seven --columns power,height_m", 1, "no column distance_m"},
        Mistake{"ColumnMissing", "table t1.csv --robot seven", 1,
                "t1.csv: no column power (there are: vx_mps, d_m, b_m)"},
        Mistake{"WordForANumber", "table word.csv --robot seven", 1,
                "word.csv:3: column height_m: 'high' is not a number"},
        Mistake{"CellsMissing", "table short.csv --robot seven", 1, "short.csv:2: 2 cells under 3 columns"},
        Mistake{"OnePower", "table one.csv --robot seven", 1, "table: 1 power, need 2 to 256"},
        Mistake{"NoAngle", "table speeds.csv --robot seven", 2, "give one angle with --exit-angle-deg"},
        Mistake{"AngleTwice", "table angles.csv --robot seven --exit-angle-deg 40", 2, "has a column exit_angle_deg"},
        Mistake{"AngleBesideHeights", "table lobs.csv --robot seven --exit-angle-deg 40", 2, "which give the angle"},
        Mistake{"TrueHeights", "table lobs.csv --robot seven --kind true", 2, "which give effective values"},
        Mistake{"UnknownKind", "table lobs.csv --robot seven --kind real", 2, "real"},
        Mistake{"OutWithoutRobot", "deflection t1.csv --out new.toml", 2, "--out needs --robot"},
        Mistake{"OutOfAnother", "deflection t1.csv --robot cambada_1 --out other.toml", 2,
                "is not the file of --robot"},
        Mistake{"NoSpeeds", "deflection still.csv", 1, "deflection: all speeds are 0"},
        Mistake{"WrongColumns", "rotation t1.csv", 1, "no column omega_radps or omega_degps"},
        Mistake{"DelayColumns", "delay t1.csv", 1, "no column delay_s or order_t_s"},
        Mistake{"PowerWithoutRobot", "transfer runs.csv", 2, "it needs --robot with the table"},
        Mistake{"ImpossibleFigure", "transfer runs.csv --robot ./other.toml --out other.toml", 1,
                "cannot write the robot's file other.toml: a figure is impossible:"},
        Mistake{"UnwritableOut", "deflection t1.csv --robot cambada_1 --out no/such/seven.toml", 1,
                "cannot write --out no/such/seven.toml: there is no folder no/such"},
        Mistake{"UnwritableChart", "deflection t1.csv --plot no/such/8.svg", 1,
                "cannot write --plot no/such/8.svg: there is no folder no/such"},
        Mistake{"PlotWithoutOut", "plot lobs.csv", 2, "--out is required"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace trivela::cli
