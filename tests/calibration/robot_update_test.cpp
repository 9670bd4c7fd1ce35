// What a calibration leaves in a robot's file: every figure of every fit, and what it must not touch.
#include "calibration/robot_update.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "config/text/error.hpp"
#include "kicking/geometry/angle.hpp"
#include "tests/support/folder.hpp"

namespace trivela::calibration {
namespace {

using kicking::degrees;
using kicking::radians;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::ThrowsMessage;

RobotUpdate update(config::Robot robot = {}) { return {std::move(robot), "trivela calibrate", "2026-11-29"}; }

/// Two kicks of each of two set-points, 0.2 m/s and 2 degrees apart.
kicking::TableFit two_set_points() {
  return kicking::fit_table(std::vector<kicking::Trial>{
      {10, radians(39), 4.9}, {10, radians(41), 5.1}, {20, radians(39), 6.9}, {20, radians(41), 7.1}});
}

kicking::DelayFit delay_of(double mean_s, double sd_s, std::size_t readings, std::size_t rejected) {
  kicking::DelayFit fit;
  fit.mean_s = {mean_s, 0.001};
  fit.sd_s = sd_s;
  fit.residual_s.resize(readings);
  fit.rejected.resize(rejected);
  return fit;
}

kicking::DirectionFit direction_of(double sd_rad) {
  kicking::DirectionFit fit;
  fit.sd_rad = {sd_rad, radians(0.25)};
  fit.observer_sd_rad = radians(0.5);
  return fit;
}

kicking::TransferDirection transfer_of(double exact, double exact_se, double paper, double paper_se, int kicks) {
  kicking::TransferDirection direction;
  direction.kicks = kicks;
  direction.exact = {exact, exact_se};
  direction.paper = {paper, paper_se};
  direction.rows.resize(static_cast<std::size_t>(kicks));
  return direction;
}

kicking::DeflectionFit deflection_of(double slope_rad, std::optional<kicking::Estimate> lateral) {
  kicking::DeflectionFit fit;
  fit.alpha_rad = {0.1, 0.2, 0.3};
  fit.line = {{slope_rad, radians(0.3)}, {}, radians(0.6)};
  if (lateral) fit.lateral = kicking::OriginLine{*lateral, {}, 0.0};
  return fit;
}

/// The file that is written, read back.
config::Robot written(const RobotUpdate& robot) {
  const tests::Folder folder;
  robot.write(folder / "robot.toml");
  return config::load_robot_of_any_table(folder / "robot.toml");
}

TEST(RobotUpdate, ATableSetsTheSpreadsThatItsKicksShow) {
  RobotUpdate robot = update();
  const kicking::TableFit fit = two_set_points();
  robot.set_table(fit, {}, {"lobs.csv"});
  const config::Robot read = written(robot);
  const kicking::KickSpreads& spreads = read.model.spreads;
  EXPECT_NEAR(spreads.speed_sd_ratio, fit.exit_speed_sd_ratio, 5e-6);
  EXPECT_NEAR(degrees(spreads.exit_angle_sd_rad), std::sqrt(2.0), 1e-5);
  EXPECT_NEAR(spreads.table_sd_ratio, fit.exit_speed_se_ratio, 5e-6);
  EXPECT_NE(spreads.speed_sd_ratio, spreads.table_sd_ratio);
  EXPECT_NEAR(degrees(read.model.exit_angle_rad), 40.0, 1e-9);
  EXPECT_THAT(read.calibration->table->exit_speed_sds_mps, ElementsAre(0.141, 0.141));
  EXPECT_NEAR(read.calibration->table->exit_speed_sd_mps.value(), 0.141, 1e-9);
}

TEST(RobotUpdate, SpreadsThatSingleKicksDoNotShowStayAndThatIsSaid) {
  RobotUpdate robot = update();
  const kicking::KickSpreads before = robot.robot().model.spreads;
  robot.set_table(kicking::fit_table(std::vector<kicking::Trial>{{10, radians(40), 5.0}, {20, radians(40), 7.0}}), {},
                  {"lobs.csv"});
  const config::Robot read = written(robot);
  EXPECT_EQ(read.model.spreads.speed_sd_ratio, before.speed_sd_ratio);
  EXPECT_NEAR(read.model.spreads.exit_angle_sd_rad, before.exit_angle_sd_rad, 1e-9);
  EXPECT_EQ(read.model.spreads.table_sd_ratio, before.table_sd_ratio);
  EXPECT_THAT(robot.changes(), Contains("kicker.spreads.speed_sd_ratio stays 0.03: the kicks do not show it"));
  EXPECT_FALSE(read.calibration->table->exit_speed_sd_mps);
  EXPECT_TRUE(read.calibration->table->exit_speed_sds_mps.empty());
}

TEST(RobotUpdate, ATableThatWasMeasuredReplacesTheOneMadeByHand) {
  config::Robot by_hand;
  by_hand.height_table = kicking::DistanceTable{{{3.0, 15.0}, {6.0, 25.0}}};
  by_hand.model.spreads.exit_angle_se_rad = radians(2.0);
  RobotUpdate robot = update(by_hand);
  kicking::TableFit table = two_set_points();
  table.exit_angle_rad.se = radians(0.03);
  robot.set_table(table, {}, {"lobs.csv"});
  const config::Robot read = written(robot);
  EXPECT_FALSE(read.height_table);
  EXPECT_EQ(read.model.table.set_points().size(), 2u);
  EXPECT_EQ(read.model.spreads.exit_angle_se_rad, 0.0) << "the angle is no longer a guess";
}

TEST(RobotUpdate, FiguresHaveFiveDecimalsOfTheirUnitAndErrorsThreeDigits) {
  RobotUpdate robot = update();
  robot.set_delay(delay_of(0.0512345678, 0.00212345678, 12, 2), {"delays.csv"});
  EXPECT_EQ(robot.robot().model.delay_s, 0.05123);
  EXPECT_EQ(robot.robot().model.spreads.delay_sd_s, 0.00212);
  EXPECT_EQ(robot.robot().calibration->delay->delay_sd_s, 0.00212);
  robot.set_deflection(deflection_of(radians(8.123456789), {}), {"t1.csv"});
  EXPECT_NEAR(degrees(robot.robot().model.alpha_slope_rad_per_mps), 8.12346, 1e-12);
}

TEST(RobotUpdate, ADelayCountsNoReadingThatWasLeftOutAndIsNoGuessAnyMore) {
  config::Robot guessed;
  guessed.model.spreads.delay_se_s = 0.02;
  RobotUpdate robot = update(guessed);
  robot.set_delay(delay_of(0.05, 0.002, 12, 2), {"delays.csv"});
  const config::Robot read = written(robot);
  EXPECT_EQ(read.calibration->delay->kicks, 10u);
  EXPECT_EQ(read.calibration->kicks, 10u);
  EXPECT_EQ(read.model.spreads.delay_se_s, 0.0);
  EXPECT_EQ(read.model.spreads.delay_sd_s, 0.002);
}

TEST(RobotUpdate, AFewKicksLeaveTheErrorsThatTheyHave) {
  config::Robot guessed;
  guessed.model.spreads.delay_se_s = 0.06;
  guessed.model.spreads.exit_angle_se_rad = radians(4.0);
  RobotUpdate robot = update(guessed);
  kicking::DelayFit delay = delay_of(0.05, 0.02, 4, 0);
  delay.mean_s.se = 0.01;
  robot.set_delay(delay, {"delays.csv"});
  kicking::TableFit table = two_set_points();
  table.exit_angle_rad.se = radians(0.65);
  robot.set_table(table, {}, {"lobs.csv"});
  EXPECT_THAT(robot.changes(), Contains("kicker.spreads.delay_se_s 0.06 -> 0.01 (4 kicks)"));
  const config::Robot read = written(robot);
  EXPECT_EQ(read.model.spreads.delay_se_s, 0.01);
  EXPECT_NEAR(degrees(read.model.spreads.exit_angle_se_rad), 0.65, 1e-9);
}

TEST(RobotUpdate, OfASingleKickTheErrorOfBeforeStays) {
  config::Robot guessed;
  guessed.model.spreads.exit_angle_se_rad = radians(4.0);
  RobotUpdate robot = update(guessed);
  kicking::TableFit table = two_set_points();
  table.exit_angle_rad.se = std::nan("");
  robot.set_table(table, {}, {"lobs.csv"});
  EXPECT_THAT(robot.changes(), Contains("kicker.spreads.exit_angle_se_deg stays 4: the kicks do not show it"));
  EXPECT_NEAR(degrees(robot.robot().model.spreads.exit_angle_se_rad), 4.0, 1e-9);
}

TEST(RobotUpdate, ADeflectionSetsTheLateralShareOfTheExactLawAlone) {
  RobotUpdate robot = update();
  const kicking::RobotModel before = robot.robot().model;
  robot.set_deflection(deflection_of(radians(8.0), kicking::Estimate{0.93, 0.04}), {"t1.csv"});
  const config::Robot read = written(robot);
  EXPECT_EQ(read.model.transfer_exact.lateral, 0.93);
  EXPECT_EQ(read.model.transfer_exact.forward, before.transfer_exact.forward);
  EXPECT_EQ(read.model.transfer_paper.lateral, before.transfer_paper.lateral);
  EXPECT_EQ(read.model.spreads.transfer_sd_ratio, 0.04);
  EXPECT_EQ(read.calibration->deflection->kicks, 3u);
}

TEST(RobotUpdate, ADeflectionWithoutALateralShareKeepsTheErrorOfTheOneBefore) {
  RobotUpdate robot = update();
  robot.set_deflection(deflection_of(radians(8.0), kicking::Estimate{0.93, 0.04}), {"t1.csv"});
  robot.set_deflection(deflection_of(radians(9.0), {}), {"t2.csv"});
  EXPECT_EQ(robot.robot().model.transfer_exact.lateral, 0.93);
  EXPECT_EQ(robot.robot().calibration->deflection->lateral_ratio_se, 0.04);
  EXPECT_EQ(robot.robot().model.spreads.transfer_sd_ratio, 0.04);
}

TEST(RobotUpdate, TheSpreadOfTheTransferIsTheRootMeanSquareOfTheExactLawsErrors) {
  RobotUpdate robot = update();
  robot.set_deflection(deflection_of(radians(8.0), kicking::Estimate{0.93, 0.06}), {"t1.csv"});
  kicking::TransferFit fit;
  fit.forward = transfer_of(0.9, 0.03, 0.7, 0.5, 4);
  fit.backward = transfer_of(0.6, 0.02, 0.4, 0.5, 5);
  robot.set_transfer(fit, {"runs.csv"});
  const config::Robot read = written(robot);
  EXPECT_NEAR(read.model.spreads.transfer_sd_ratio, std::sqrt((0.0036 + 0.0009 + 0.0004) / 3.0), 5e-6);
  EXPECT_EQ(read.model.transfer_exact.forward, 0.9);
  EXPECT_EQ(read.model.transfer_exact.backward, 0.6);
  EXPECT_EQ(read.model.transfer_paper.forward, 0.7);
  EXPECT_EQ(read.model.transfer_paper.backward, 0.4);
  EXPECT_EQ(read.calibration->transfer->kicks, 9u);
}

TEST(RobotUpdate, ATransferOfOneDirectionKeepsTheOtherWithItsKicksAndFiles) {
  RobotUpdate robot = update();
  kicking::TransferFit both, forward;
  both.forward = transfer_of(0.9, 0.03, 0.7, 0.05, 4);
  both.backward = transfer_of(0.6, 0.02, 0.4, 0.06, 5);
  forward.forward = transfer_of(0.8, 0.01, 0.65, 0.02, 3);
  robot.set_transfer(both, {"both.csv"});
  robot.set_transfer(forward, {"forward.csv"});
  const config::TransferOrigin& transfer = *robot.robot().calibration->transfer;
  EXPECT_EQ(robot.robot().model.transfer_exact.forward, 0.8);
  EXPECT_EQ(robot.robot().model.transfer_exact.backward, 0.6);
  EXPECT_EQ(transfer.exact_backward_se_ratio, 0.02);
  EXPECT_EQ(transfer.kicks, 12u);
  EXPECT_THAT(transfer.files, ElementsAre("both.csv", "forward.csv"));
  robot.set_transfer(both, {"again.csv"});
  EXPECT_EQ(robot.robot().calibration->transfer->kicks, 9u) << "nothing is kept where both are new";
  EXPECT_THAT(robot.robot().calibration->transfer->files, ElementsAre("again.csv"));
}

TEST(RobotUpdate, ATransferALittleBeyondWhatAFloorCanDoIsHeldAndMoreThanThatIsRefused) {
  RobotUpdate robot = update();
  kicking::TransferFit fit;
  fit.forward = transfer_of(1.55, 0.03, 0.7, 0.05, 4);
  robot.set_transfer(fit, {"runs.csv"});
  EXPECT_EQ(robot.robot().model.transfer_exact.forward, 1.5);
  EXPECT_THAT(robot.changes(), Contains(HasSubstr("forward_ratio 1 -> 1.5 (+- 0.03, 4 kicks, held to 0 to 1.5)")));
  const tests::Folder folder;
  const auto path = folder / "robot.toml";
  robot.write(path);
  const auto content = [&] {
    std::ifstream in(path);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const std::string before = content();
  fit.forward = transfer_of(1.57, 0.03, 0.7, 0.05, 4);
  robot.set_transfer(fit, {"runs.csv"});
  EXPECT_THAT([&] { robot.write(path); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("a figure is impossible"), HasSubstr("1.57"))));
  EXPECT_EQ(content(), before);
  EXPECT_THAT(folder.files(""), ElementsAre("robot.toml")) << "nothing is left beside it";
}

TEST(RobotUpdate, AScatterThatTheCamerasNoiseExplainsStays) {
  RobotUpdate robot = update();
  const double before_rad = robot.robot().model.spreads.direction_sd_rad;
  robot.set_direction(direction_of(kicking::kNotKnown), 8, {"standing.db"});
  EXPECT_EQ(robot.robot().model.spreads.direction_sd_rad, before_rad);
  EXPECT_FALSE(robot.robot().calibration && robot.robot().calibration->direction);
  EXPECT_THAT(robot.changes(), ElementsAre("kicker.spreads.direction_sd_deg stays 2: the kicks do not show it"));
  robot.set_direction(direction_of(radians(1.25)), 8, {"standing.db"});
  EXPECT_NEAR(degrees(robot.robot().model.spreads.direction_sd_rad), 1.25, 1e-12);
  EXPECT_EQ(robot.robot().calibration->direction->kicks, 8u);
  EXPECT_NEAR(degrees(robot.robot().calibration->direction->observer_sd_rad), 0.5, 1e-12);
}

TEST(RobotUpdate, ATurnSetsTheSlopeOfBetaAlone) {
  RobotUpdate robot = update();
  kicking::RotationFit fit;
  fit.beta_rad = {0.05, 0.1};
  fit.line = {{0.1034567, 0.00345678}, {}, radians(0.4)};
  robot.set_rotation(fit, {"turns.csv"});
  const config::Robot read = written(robot);
  EXPECT_EQ(read.model.beta_slope_s, 0.10346);
  EXPECT_EQ(read.model.delay_s, kicking::RobotModel{}.delay_s);
  EXPECT_EQ(read.calibration->rotation->beta_slope_se_s, 0.00346);
  EXPECT_EQ(read.calibration->rotation->kicks, 2u);
}

/// A robot whose lever has a further position.
config::Robot robot_of_two_kinds() {
  config::Robot robot;
  robot.lever = 1;
  kicking::RobotModel flat = robot.model;
  flat.exit_angle_rad = radians(8.0);
  robot.model.further_kinds = {flat};
  robot.kinds = {{.name = "flat", .source = "not measured", .lever = 2}};
  return robot;
}

TEST(RobotUpdate, AFurtherKindOfKickGetsTableDelaySpreadsAndTheTransferOfTheFirst) {
  config::Robot before = robot_of_two_kinds();
  before.model.transfer_exact = {0.9, 0.4, 0.95};
  RobotUpdate robot = update(before);
  robot.set_kind(1, two_set_points(), delay_of(0.04, 0.003, 9, 1), direction_of(radians(1.5)), {"flat.db"});
  const config::Robot read = written(robot);
  const kicking::RobotModel& flat = read.model.kind(1);
  EXPECT_EQ(flat.table.set_points().size(), 2u);
  EXPECT_EQ(flat.delay_s, 0.04);
  EXPECT_EQ(flat.spreads.delay_sd_s, 0.003);
  EXPECT_NEAR(degrees(flat.spreads.direction_sd_rad), 1.5, 1e-9);
  EXPECT_NEAR(flat.spreads.speed_sd_ratio, two_set_points().exit_speed_sd_ratio, 5e-6);
  EXPECT_NEAR(flat.spreads.table_sd_ratio, two_set_points().exit_speed_se_ratio, 5e-6);
  EXPECT_EQ(flat.transfer_exact.lateral, 0.95);
  EXPECT_NEAR(degrees(flat.exit_angle_rad), 8.0, 1e-9) << "nobody measured it";
  EXPECT_EQ(read.kinds.front().source,
            "trivela calibrate on 2026-11-29: table, delay and spreads of 4 kicks (flat.db); the angle was not "
            "measured");
  EXPECT_EQ(read.model.delay_s, before.model.delay_s) << "of the first kind";
  EXPECT_EQ(read.model.table.set_points().size(), before.model.table.set_points().size());
  EXPECT_FALSE(read.calibration);
}

TEST(RobotUpdate, AKindWhoseScatterIsNotKnownKeepsIt) {
  RobotUpdate robot = update(robot_of_two_kinds());
  const kicking::KickSpreads before = robot.robot().model.kind(1).spreads;
  robot.set_kind(1, kicking::fit_table(std::vector<kicking::Trial>{{10, 0.7, 5.0}, {20, 0.7, 7.0}}),
                 delay_of(0.04, 0.003, 9, 1), direction_of(kicking::kNotKnown), {"flat.db"});
  const kicking::KickSpreads& after = robot.robot().model.kind(1).spreads;
  EXPECT_EQ(after.direction_sd_rad, before.direction_sd_rad);
  EXPECT_EQ(after.speed_sd_ratio, before.speed_sd_ratio);
  EXPECT_EQ(after.table_sd_ratio, before.table_sd_ratio);
}

kicking::KickerEstimate estimate_in_play() {
  kicking::KickerEstimate estimate;
  estimate.mean << std::log(1.1), radians(1.0), radians(-2.0), 0.01, -0.05, -0.1;
  estimate.se << 0.01, radians(0.2), radians(0.3), 0.004, 0.02, 0.03;
  estimate.elevation_sd_rad = radians(0.6);
  estimate.direction_sd_rad = radians(1.7);
  estimate.delay_sd_s = 0.007;
  estimate.speed_sd_ratio = 0.02;
  estimate.kicks = 31;
  return estimate;
}

TEST(RobotUpdate, KicksInPlayCorrectEveryFigureByWhatTheyShow) {
  RobotUpdate robot = update();
  const kicking::RobotModel before = robot.robot().model;
  robot.set_play(estimate_in_play(), {"match.db"});
  const kicking::RobotModel after = written(robot).model;
  EXPECT_NEAR(after.table.front().speed_mps, 1.1 * before.table.front().speed_mps, 1e-5);
  EXPECT_NEAR(after.table.back().speed_mps, 1.1 * before.table.back().speed_mps, 1e-5);
  EXPECT_NEAR(degrees(after.exit_angle_rad), degrees(before.exit_angle_rad) + 1.0, 1e-5);
  EXPECT_NEAR(degrees(after.direction_rad), -2.0, 1e-5);
  EXPECT_NEAR(after.delay_s, before.delay_s + 0.01, 1e-5);
  EXPECT_NEAR(after.transfer_exact.forward, before.transfer_exact.forward - 0.05, 1e-5);
  EXPECT_NEAR(after.transfer_exact.backward, before.transfer_exact.backward - 0.05, 1e-5);
  EXPECT_NEAR(after.transfer_exact.lateral, before.transfer_exact.lateral - 0.1, 1e-5);
}

TEST(RobotUpdate, KicksInPlayLeaveTheirScatterAndTheirStandardErrors) {
  RobotUpdate robot = update();
  robot.set_play(estimate_in_play(), {"match.db"});
  const config::Robot read = written(robot);
  const kicking::KickSpreads& spreads = read.model.spreads;
  EXPECT_NEAR(degrees(spreads.exit_angle_sd_rad), 0.6, 1e-9);
  EXPECT_NEAR(degrees(spreads.direction_sd_rad), 1.7, 1e-9);
  EXPECT_EQ(spreads.delay_sd_s, 0.007);
  EXPECT_NEAR(degrees(spreads.exit_angle_se_rad), 0.2, 1e-9);
  EXPECT_NEAR(degrees(spreads.direction_se_rad), 0.3, 1e-9);
  EXPECT_EQ(spreads.delay_se_s, 0.004);
  const config::PlayOrigin& play = *read.calibration->play;
  EXPECT_EQ(play.kicks, 31u);
  EXPECT_EQ(play.speed_se_ratio, 0.01);
  EXPECT_EQ(play.delay_se_s, 0.004);
  EXPECT_EQ(play.along_se_ratio, 0.02);
  EXPECT_EQ(play.sideways_se_ratio, 0.03);
  EXPECT_THAT(robot.text(), AllOf(HasSubstr("# Measured: all of it in play (31 kicks).\n"),
                                  HasSubstr("# Not measured, kept as they were: ball, wheels.\n")));
}

TEST(RobotUpdate, KicksThatGaveADelayBesideAnotherFigureCountOnce) {
  RobotUpdate robot = update();
  robot.set_table(two_set_points(), {}, {"out/1_standing.scans.db"});
  robot.set_delay(delay_of(0.05, 0.002, 6, 0), {"out/1_standing.db"});
  EXPECT_EQ(written(robot).calibration->kicks, 6u) << "4 of the scans are among the 6 of the log";
  robot.set_delay(delay_of(0.05, 0.002, 6, 0), {"out/2_turn.db"});
  EXPECT_EQ(written(robot).calibration->kicks, 10u);
}

TEST(RobotUpdate, ATrueTableTakesTheEffectiveOnesPlaceOnlyWhereThatWasNotMeasured) {
  RobotUpdate robot = update();
  robot.set_table(two_set_points(), {.kind = kicking::TableKind::kTrue}, {"true.csv"});
  EXPECT_TRUE(robot.robot().true_table);
  robot.set_table(two_set_points(), {.kind = kicking::TableKind::kTrue}, {"true.csv"});
  EXPECT_TRUE(robot.robot().true_table) << "a true one may be measured again";
  robot.set_table(two_set_points(), {}, {"lobs.csv"});
  EXPECT_FALSE(robot.robot().true_table);
  EXPECT_THAT([&] { robot.set_table(two_set_points(), {.kind = kicking::TableKind::kTrue}, {"true.csv"}); },
              ThrowsMessage<config::BadArgument>(HasSubstr("has a calibrated effective table")));
}

TEST(RobotUpdate, TheFileSaysWhoWroteItAndAFigureThatNobodyMeasuredIsNamed) {
  RobotUpdate robot = update();
  EXPECT_THAT(robot.text(), AllOf(StartsWith("# Robot cambada_1, written by trivela calibrate on 2026-11-29.\n"),
                                  Not(HasSubstr("Measured"))));
  robot.set_delay(delay_of(0.05, 0.002, 6, 0), {"delays.csv"});
  EXPECT_THAT(
      robot.text(),
      AllOf(HasSubstr("# Measured: delay (6 kicks).\n"),
            HasSubstr("kept as they were: table, exit angle, alpha, beta, transfer, sideways scatter, ball, wheels.")));
}

}  // namespace
}  // namespace trivela::calibration
