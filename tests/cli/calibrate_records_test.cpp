// trivela calibrate from a scan record and from a match log.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

#include "cli/verbs.hpp"
#include "config/robot.hpp"
#include "tests/calibration/drive_log.hpp"
#include "tests/pages/recorded_lobs.hpp"

namespace trivela::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

json run(const std::string& arguments, int expected = kDone) {
  CLI::App app;
  int exit_code = -1;
  add_calibrate_table(app, exit_code);
  add_calibrate_deflection(app, exit_code);
  add_calibrate_rotation(app, exit_code);
  add_calibrate_transfer(app, exit_code);
  add_calibrate_delay(app, exit_code);
  add_calibrate_plot(app, exit_code);
  testing::internal::CaptureStdout();
  try {
    app.parse(arguments + " --json");
  } catch (...) {
    testing::internal::GetCapturedStdout();
    throw;
  }
  EXPECT_EQ(exit_code, expected);
  return json::parse(testing::internal::GetCapturedStdout());
}

TEST(CalibrateRecords, TrueTableOfASyntheticRecordIsWhatWasKicked) {
  const pages::RecordedLobs lobs({{15, 6.1}, {15, 6.1}, {25, 8.7}, {25, 8.7}, {40, 10.8}});
  const std::string out = lobs.path("nine.toml").string();
  const json table = run("table " + lobs.path().string() + " --robot nine --kind true --out " + out);
  ASSERT_EQ(table["setpoints"].size(), 3u);
  const double kicked_mps[] = {6.1, 8.7, 10.8};
  const int trials[] = {2, 2, 1};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(table["setpoints"][i]["exit_speed_mps"].get<double>(), kicked_mps[i], 0.05);
    EXPECT_NEAR(table["setpoints"][i]["exit_angle_deg"].get<double>(), 36.78, 0.2);
    EXPECT_EQ(table["setpoints"][i]["trials"], trials[i]);
  }
  // Effective: drag is absorbed, the ball seems slower and steeper.
  const json effective = run("table " + lobs.path().string() + " --robot nine --out " + out);
  EXPECT_LT(effective["setpoints"][2]["exit_speed_mps"].get<double>(), 0.97 * 10.8);
  EXPECT_GT(effective["exit_angle_deg"].get<double>(), 36.9);
  EXPECT_NO_THROW(config::load_robot(out));
}

TEST(CalibrateRecords, AFigureOfSyntheticLobsSaysSo) {
  const pages::RecordedLobs lobs({{15, 6.1}, {25, 8.7}});
  const auto figure_of = [&](const std::string& input) {
    const std::string out = lobs.path("5.svg").string();
    run("plot " + input + " --out " + out);
    std::ifstream file{out};
    return std::string{std::istreambuf_iterator<char>{file}, {}};
  };
  EXPECT_THAT(figure_of(lobs.path().string()), HasSubstr(">simulated: "));
  const std::string measured = lobs.path("lobs.csv").string();
  std::ofstream{measured} << "power,height_m,distance_m\n15,0.6,3.3\n25,1.3,7\n";
  EXPECT_THAT(figure_of(measured), Not(HasSubstr("simulated")));
}

class CalibrateDrives : public calibration::DriveLog {};

TEST_F(CalibrateDrives, GiveTheWorldThatMadeThem) {
  const kicking::Transfer world{0.9, 0.6, 0.8};
  for (const double v : {-1.0, -0.5, 0.5, 1.0}) {
    kick("lateral_drive", {0.0, 3.0, 0.05}, {v, 0.0, 0.0}, world);
    kick("turn_drive", {0.0, 3.0, 0.0}, {0.0, 0.0, v}, {1, 1, 1});
    kick("straight_drive", {0.1, 3.0, 0.02}, {0.0, v, 0.0}, std::nullopt, std::nullopt);
    see_flight(6.6, 5.0, (v > 0.0 ? 0.9 : 0.6) * v);
    kick("straight_drive", {0.1, 3.0, 0.02}, {0.0, 0.0, 0.0}, std::nullopt, std::nullopt);
    see_flight(6.6, 5.0, 0.0);
  }
  writer_.finalise();
  const std::string log = path().string();
  const std::string out = " --robot cambada_1 --out " + path("nine.toml").string();
  EXPECT_NEAR(run("deflection " + log + out)["transfer"]["lateral_ratio"].get<double>(), 0.8, 1e-6);
  const std::string same = " --robot " + path("nine.toml").string() + " --out " + path("nine.toml").string();
  EXPECT_NEAR(run("rotation " + log + same)["physical"]["delay_s"].get<double>(), calibration::kDelay_s, 0.002);
  const json transfer = run("transfer " + log + same);
  // In the speeds of the drag-free law, which are smaller than those over ground.
  const kicking::RobotModel model;
  const double effective = model.table.speed_for(calibration::kPower) * std::cos(model.exit_angle_rad) / 6.6;
  EXPECT_NEAR(transfer["forward"]["exact"]["value"].get<double>(), 0.9 * effective, 2e-3);
  EXPECT_NEAR(transfer["backward"]["exact"]["value"].get<double>(), 0.6 * effective, 2e-3);
  const config::Robot robot = config::load_robot(path("nine.toml"));
  EXPECT_EQ(robot.calibration->deflection->kicks, 4u);
  EXPECT_EQ(robot.calibration->deflection->files, std::vector<std::string>{"match.db"});
  EXPECT_NEAR(robot.model.transfer_exact.lateral, 0.8, 1e-5);
}

TEST_F(CalibrateDrives, NeedARobotAndTheRightKindOfRecord) {
  kick("lateral_drive", {0.0, 3.0, 0.05}, {1.0, 0.0, 0.0}, {});
  writer_.finalise();
  const std::string log = path().string();
  EXPECT_THAT([&] { run("deflection " + log); }, ThrowsMessage<UsageError>(HasSubstr("it needs --robot")));
  EXPECT_THAT([&] { run("deflection " + log + " --robot cambada_1"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("1 row, need at least 2")));
  EXPECT_THAT([&] { run("table " + log + " --robot nine --out " + path("nine.toml").string()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("is a match log; a table needs")));
  const pages::RecordedLobs lobs({{15, 6.1}});
  EXPECT_THAT([&] { run("delay " + lobs.path().string() + " --robot cambada_1"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("is a scan record; this needs")));
}

}  // namespace
}  // namespace trivela::cli
