// A calibration in this process.
#include "experiment/calibration/simulated_calibration.hpp"
#include "config/text/installation.hpp"

#include <gmock/gmock.h>

#include "config/scenario/scenario.hpp"
#include "experiment/calibration/calibration_check.hpp"

namespace trivela::experiment {
namespace {

std::string figures_of(const config::Robot& robot) {
  config::Robot same = robot;
  same.name = same.source = "";
  if (same.calibration) {
    same.calibration->source = same.calibration->date = "";
    same.calibration->kicks = 0;
    for (config::FigureOrigin* origin : std::initializer_list<config::FigureOrigin*>{
             &*same.calibration->table, &*same.calibration->exit_angle, &*same.calibration->deflection,
             &*same.calibration->rotation, &*same.calibration->transfer, &*same.calibration->delay,
             &*same.calibration->direction})
      origin->date = "";
  }
  return config::to_toml_text(same);
}

// config/robots/calibrated_1.toml names its command.
TEST(SimulatedCalibration, MakesTheShippedRobotAgain) {
  const SimulatedCalibration calibration = play_calibration(default_simulated_calibration());
  EXPECT_EQ(figures_of(calibration.robot.robot()),
            figures_of(config::load_robot(config::shipped("robots/calibrated_1.toml"))));
}

TEST(SimulatedCalibration, OfTheDefaultWorldIsThatOfCalibrationToml) {
  const SimulatedCalibrationOptions options = default_simulated_calibration();
  const sim::Scenario world = config::load_scenario(config::shipped("scenarios/default.toml"));
  EXPECT_EQ(config::to_toml_text(calibration_scenario(options.scenario, world)),
            config::to_toml_text(options.scenario));
}

TEST(SimulatedCalibration, FindsTheWorldsKickerAndNothingOfIt) {
  sim::Scenario world = config::load_scenario(config::shipped("scenarios/default.toml"));
  world.kicker.transfer_forward_ratio = 0.6;
  world.kicker.speed_scale_ratio = 0.95;
  const config::Robot robot = calibrated_robot(world, 3);
  EXPECT_NEAR(robot.model.transfer_exact.forward, 0.57, 0.12) << "three rms errors";
  EXPECT_NEAR(robot.model.transfer_exact.backward, 0.95, 0.12);
  EXPECT_NEAR(robot.model.table.speed_for(30.0), 0.95 * 9.21, 0.1);
}

TEST(SimulatedCalibration, MeasuresAFurtherKindOfKickAndLeavesTheFirstAsItIs) {
  sim::Scenario world;
  const config::Robot lob = calibrated_robot(world, 3);
  world.kicker.flat.enabled = true;
  world.kicker.flat.delay_s = 0.09;
  for (double& speed_mps : world.kicker.flat.exit_speeds_mps) speed_mps *= 1.15;
  const config::Robot both = calibrated_robot(world, 3);
  ASSERT_EQ(both.model.kinds(), 2u);
  const kicking::RobotModel& flat = both.model.kind(1);
  EXPECT_NEAR(flat.delay_s, 0.09, 0.012);
  for (std::size_t i = 2; i < world.kicker.flat.powers.size(); ++i) {
    const double v_mps = world.kicker.flat.exit_speeds_mps[i];
    EXPECT_NEAR(flat.table.speed_for(world.kicker.flat.powers[i]), v_mps, 0.08 * v_mps) << "the file guesses 15 % less";
  }
  EXPECT_NEAR(flat.spreads.direction_sd_rad, world.kicker.flat.direction_sd_rad,
              0.5 * world.kicker.flat.direction_sd_rad);
  EXPECT_EQ(both.model.table.back().speed_mps, lob.model.table.back().speed_mps);
  EXPECT_EQ(both.model.delay_s, lob.model.delay_s);
  EXPECT_EQ(flat.transfer_exact.forward, lob.model.transfer_exact.forward);
}

TEST(SimulatedCalibration, DependsOnItsSeedAndNotOnTheThreads) {
  SimulatedCalibrationOptions options = default_simulated_calibration();
  options.seed = 20;
  const auto two = play_calibrations(options, 2, 2);
  options.seed = 21;
  EXPECT_EQ(figures_of(two[1].robot.robot()), figures_of(play_calibration(options).robot.robot()));
  EXPECT_NE(figures_of(two[0].robot.robot()), figures_of(two[1].robot.robot()));
}

TEST(SimulatedCalibration, CoversTheWorldsFigures) {
  SimulatedCalibrationOptions options = default_simulated_calibration();
  options.seed = 100;
  const auto figures = study_figures(play_calibrations(options, 16, 2), options);
  EXPECT_GE(figures.size(), 14u);
  for (const StudiedFigure& figure : figures) {
    EXPECT_GE(figure.covered, 0.74) << figure.key << ": 5 of 16 calibrations outside is one in a thousand";
    if (figure.key.starts_with("transfer_")) {
      EXPECT_LE(figure.rms, 0.05) << figure.key;
    }
  }
}

}  // namespace
}  // namespace trivela::experiment
