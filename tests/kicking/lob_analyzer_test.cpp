#include "kicking/geometry/time.hpp"
#include "kicking/lob/analyzer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/ballistics/flight.hpp"
#include "sim/laser/laser.hpp"
#include "tests/kicking/lob_scene.hpp"
#include "tests/kicking/reference_laws.hpp"

namespace trivela::kicking::lob {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using tests::kick;
using tests::lobs_of;

/// Effective exit of a flight with drag: what its height and distance give.
LobExit effective_exit(const sim::SyntheticKick& k) {
  const DragFlight flight =
      fly_with_drag(k.exit_speed_mps, k.exit_angle_rad, drag_per_m({}, {.drag_coefficient = k.drag_coefficient}));
  return exit_from_lob(flight.apex_m, flight.range_m);
}

/// Within 0.15 degrees and 0.03 m/s, and within five standard errors where those are larger.
void expect_kick(const LobRecord& lob, const sim::SyntheticKick& k) {
  ASSERT_EQ(lob.refusal, Refusal::kNone) << lob.why;
  const auto near = [](const Estimate& estimate, double truth, double tolerance) {
    EXPECT_NEAR(estimate.value, truth, std::max(tolerance, 5.0 * estimate.se));
  };
  near(lob.true_values->exit_angle_rad, k.exit_angle_rad, radians(0.15));
  near(lob.true_values->exit_speed_mps, k.exit_speed_mps, 0.03);
  const LobExit effective = effective_exit(k);
  near(lob.effective->exit_angle_rad, effective.angle_rad, radians(0.15));
  near(lob.effective->exit_speed_mps, effective.speed_mps, 0.03);
}

TEST(Analyzer, FindsEachLobOfARecordAndNoBounce) {
  sim::RecordPlan plan;
  plan.kicks = {kick(6.0, 35.0), kick(8.39, 36.78), kick(10.5, 38.0)};
  const sim::LaserModel laser;
  const auto record = sim::synthesize_record(laser, plan, {}, 3);
  const auto lobs = tests::lobs_in(record.scans, laser.geometry, record.mount);
  ASSERT_EQ(lobs.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    SCOPED_TRACE(i);
    expect_kick(lobs[i], plan.kicks[i]);
    EXPECT_NEAR(seconds(lobs[i].launch_t_ns - record.truth[i].launch_t_ns), 0.0, 0.003);
  }
}

TEST(Analyzer, RecoversTruthOverExitsAndPlacesOfTheLaser) {
  for (const double x : {-1.0, 2.0, 4.0, 6.0}) {
    sim::LaserModel laser;
    laser.x_m = x;
    sim::RecordPlan plan;
    for (const double speed : {6.0, 8.0, 10.0}) {
      for (const double angle : {30.0, 40.0, 50.0}) plan.kicks.push_back(kick(speed, angle, 0.15 + 0.01 * angle / 5.0));
    }
    const auto lobs = lobs_of(laser, plan, 5);
    ASSERT_EQ(lobs.size(), plan.kicks.size()) << "laser at " << x;
    for (std::size_t i = 0; i < lobs.size(); ++i) {
      SCOPED_TRACE(testing::Message() << "laser at " << x << ", kick " << i);
      expect_kick(lobs[i], plan.kicks[i]);
    }
  }
}

TEST(Analyzer, HardKicksWithMuchDragAreLobsToo) {
  sim::RecordPlan plan;
  for (const double angle : {30.0, 45.0, 60.0}) plan.kicks.push_back(kick(12.0, angle, 0.5));
  plan.fly_s = 3.0;
  const auto lobs = lobs_of({}, plan, 6);
  ASSERT_EQ(lobs.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(lobs[i].refusal, Refusal::kNone) << lobs[i].why;
    EXPECT_NEAR(lobs[i].true_values->exit_speed_mps.value, 12.0, 0.03);
    EXPECT_NEAR(lobs[i].true_values->drag_coefficient.value, 0.5, 0.02);
  }
}

TEST(Analyzer, ScannerOnItsOtherSideSeesTheSameLob) {
  sim::RecordPlan plan;
  plan.kicks = {kick(8.39, 36.78)};
  sim::LaserModel laser;
  for (const bool mirrored : {false, true}) {
    laser.mirrored = mirrored;
    for (const double front_deg : {90.0, 70.0, 110.0}) {
      laser.front_elevation_rad = radians(front_deg);
      const auto lobs = lobs_of(laser, plan);
      ASSERT_EQ(lobs.size(), 1u);
      expect_kick(lobs[0], plan.kicks[0]);
    }
  }
}

/// Mean angle [deg] and speed of lobs, by one of the two fits.
struct MeanExit {
  double angle_deg = 0.0, speed_mps = 0.0;
};

MeanExit mean_exit(const std::vector<LobRecord>& lobs, bool effective) {
  MeanExit mean;
  const auto n = static_cast<double>(lobs.size());
  for (const LobRecord& lob : lobs) {
    EXPECT_EQ(lob.refusal, Refusal::kNone) << lob.why;
    const auto& angle = effective ? lob.effective->exit_angle_rad : lob.true_values->exit_angle_rad;
    const auto& speed = effective ? lob.effective->exit_speed_mps : lob.true_values->exit_speed_mps;
    mean.angle_deg += degrees(angle.value) / n;
    mean.speed_mps += speed.value / n;
  }
  return mean;
}

TEST(Analyzer, HasTheAccuracyOfTheVectors) {
  sim::RecordPlan plan;
  plan.kicks.assign(60, kick(8.39, 36.78));
  int compared = 0;
  for (const double x : {4.0, 9.0, -1.0}) {
    sim::LaserModel laser;
    laser.x_m = x;
    const auto record = sim::synthesize_record(laser, plan, {}, 9);
    for (const auto& row : tests::rows("lob_fit_accuracy.csv")) {
      const std::string estimator = row.text("estimator"), geometry = row.text("geometry");
      if (row.text("scanner") != "UTM40Hz" || std::stod(geometry.substr(geometry.find('=') + 1)) != x) continue;
      AnalyzerConfig config;
      if (estimator == "circle/time+drag(k known)") config.drag_coefficient = 0.25;
      if (estimator != "circle/HD" && !estimator.starts_with("circle/time+drag")) continue;
      const auto lobs = tests::lobs_in(record.scans, laser.geometry, record.mount, config);
      EXPECT_EQ(lobs.size(), plan.kicks.size());
      const MeanExit mean = mean_exit(lobs, estimator == "circle/HD");
      EXPECT_NEAR(mean.angle_deg, row.number("theta_mean"), 0.05) << estimator << ", " << geometry;
      EXPECT_NEAR(mean.speed_mps, row.number("V_mean"), 0.01) << estimator << ", " << geometry;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 9);
}

TEST(Analyzer, TenScansASecondAreEnough) {
  sim::LaserModel laser;
  laser.geometry = tests::urg_04lx();
  sim::RecordPlan plan;
  plan.background_s = 5.0;
  for (int i = 0; i < 4; ++i) plan.kicks.push_back(kick(8.39, 36.78));
  AnalyzerConfig config;
  config.drag_coefficient = 0.25;
  const auto lobs = lobs_of(laser, plan, 2, config);
  ASSERT_EQ(lobs.size(), 4u);
  for (const LobRecord& lob : lobs) {
    ASSERT_EQ(lob.refusal, Refusal::kNone) << lob.why;
    EXPECT_NEAR(degrees(lob.true_values->exit_angle_rad.value), 36.78, 0.3);
    EXPECT_NEAR(lob.true_values->exit_speed_mps.value, 8.39, 0.05);
  }
}

TEST(Analyzer, TimesOfTheBeamsMatterByDegreesAtTenScansASecond) {
  sim::LaserModel laser;
  laser.geometry = tests::urg_04lx();
  sim::RecordPlan plan;
  plan.background_s = 5.0;
  for (int i = 0; i < 4; ++i) plan.kicks.push_back(kick(8.39, 36.78, 0.0));
  const auto record = sim::synthesize_record(laser, plan, {}, 2);
  AnalyzerConfig config;
  config.drag_coefficient = 0.0;
  ScanGeometry no_times = laser.geometry;
  no_times.beam_period_s = 1e-12;
  const auto with = tests::lobs_in(record.scans, laser.geometry, record.mount, config);
  const auto without = tests::lobs_in(record.scans, no_times, record.mount, config);
  ASSERT_EQ(with.size(), 4u);
  ASSERT_EQ(without.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(degrees(with[i].true_values->exit_angle_rad.value), 36.78, 0.3);
    EXPECT_NEAR(degrees(without[i].true_values->exit_angle_rad.value), 36.78 + 2.0, 0.5);
  }
}

TEST(Analyzer, LaunchHeightIsThatOfTheBallThatLay) {
  sim::RecordPlan plan;
  plan.kicks = {kick(8.39, 36.78)};
  const sim::LaserModel laser;
  auto record = sim::synthesize_record(laser, plan, {}, 4);
  const auto right = tests::lobs_in(record.scans, laser.geometry, record.mount);
  record.mount.z_m += 0.04;  // measured badly
  const auto wrong = tests::lobs_in(record.scans, laser.geometry, record.mount);
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_NEAR(wrong[0].effective->height_m.value, right[0].effective->height_m.value, 1e-3);
  EXPECT_NEAR(wrong[0].true_values->exit_speed_mps.value, right[0].true_values->exit_speed_mps.value, 1e-3);
}

TEST(Analyzer, RefusesAKickBesideTheScanPlane) {
  sim::RecordPlan plan;
  plan.kicks = {kick(8.39, 36.78)};
  plan.lateral_error_m = 0.07;  // a ball there covers 0.77 of its angle
  const auto lobs = lobs_of({}, plan);
  ASSERT_EQ(lobs.size(), 1u);
  EXPECT_EQ(lobs[0].refusal, Refusal::kPlaneMisaligned) << lobs[0].why;
  EXPECT_THAT(lobs[0].why, HasSubstr("covers 0.7"));
}

TEST(Analyzer, WhatItAcceptsBesideTheScanPlaneIsStillRight) {
  sim::RecordPlan plan;
  plan.kicks.assign(6, kick(8.39, 36.78));
  const LobExit effective = effective_exit(plan.kicks[0]);
  for (const auto& [direction_deg, lateral_m] : {std::pair{0.5, 0.0}, std::pair{-0.5, 0.0}, std::pair{0.0, 0.04}}) {
    plan.direction_error_rad = radians(direction_deg);
    plan.lateral_error_m = lateral_m;
    const auto lobs = lobs_of({}, plan);
    ASSERT_EQ(lobs.size(), 6u);
    const MeanExit by_shape = mean_exit(lobs, true), by_time = mean_exit(lobs, false);
    EXPECT_NEAR(by_shape.angle_deg, degrees(effective.angle_rad), 0.2);
    EXPECT_NEAR(by_shape.speed_mps, effective.speed_mps, 0.02);
    EXPECT_NEAR(by_time.angle_deg, 36.78, 0.2);
    EXPECT_NEAR(by_time.speed_mps, 8.39, 0.05);
  }
}

TEST(Analyzer, RefusesAKickThatDriftsOutOfThePlane) {
  sim::RecordPlan plan;
  plan.kicks = {kick(8.39, 36.78)};
  plan.direction_error_rad = radians(1.0);
  const auto lobs = lobs_of({}, plan);
  ASSERT_EQ(lobs.size(), 1u);
  EXPECT_EQ(lobs[0].refusal, Refusal::kPlaneMisaligned) << lobs[0].why;
}

TEST(Analyzer, SeesNoLobOfAKickThatLeavesThePlane) {
  sim::RecordPlan plan;
  plan.kicks = {kick(8.39, 36.78)};
  plan.direction_error_rad = radians(4.0);  // out of sight after 1.6 m
  for (const LobRecord& lob : lobs_of({}, plan)) EXPECT_NE(lob.refusal, Refusal::kNone);
}

TEST(Analyzer, ShowsBackgroundForegroundBallAndTrack) {
  sim::RecordPlan plan;
  plan.kicks = {kick(8.39, 36.78)};
  const sim::LaserModel laser;
  const auto record = sim::synthesize_record(laser, plan, {}, 1);
  Analyzer analyzer(laser.geometry, record.mount);
  const std::int64_t launch = record.truth[0].launch_t_ns;
  bool ended = false;
  for (std::size_t i = 0; i < record.scans.size() && !ended; ++i) {
    const Scan& scan = record.scans[i];
    ended = analyzer.add(scan).has_value();
    const ScanView& view = analyzer.view();
    EXPECT_EQ(view.t_ns, scan.t_ns);
    EXPECT_EQ(view.background_known, i >= 39);
    EXPECT_EQ(analyzer.background_m().empty(), i < 39);
    ASSERT_EQ(view.ball.size(), scan.range_mm.size());
    for (std::size_t beam = 0; beam < view.ball.size(); ++beam) EXPECT_LE(view.ball[beam], view.foreground[beam]);
    const double flown_s = seconds(scan.t_ns - launch);
    EXPECT_TRUE(flown_s > -0.1 || view.track == nullptr);
    if (flown_s < 0.2 || flown_s > 0.9) continue;
    ASSERT_TRUE(view.centre);
    ASSERT_NE(view.track, nullptr);
    EXPECT_EQ(view.track->back().t_ns, view.centre->t_ns);
    EXPECT_NEAR(std::count(view.ball.begin(), view.ball.end(), 1), view.centre->returns, 2);
    const double at_s = seconds(view.centre->t_ns - launch);
    EXPECT_NEAR(view.centre->x_m, 8.39 * std::cos(radians(36.78)) * at_s, 0.35);
  }
  EXPECT_TRUE(ended);
  EXPECT_EQ(std::count(analyzer.background_m().begin(), analyzer.background_m().end(), -1.0) > 100, true);
}

TEST(Analyzer, LearnsTheBackgroundAnewWhenTold) {
  const ScanGeometry geometry;
  Analyzer analyzer(geometry, {});
  const Scan near{0, std::vector<std::uint32_t>(geometry.beams, 3000)};
  const Scan nearer{0, std::vector<std::uint32_t>(geometry.beams, 2000)};
  for (int i = 0; i < 40; ++i) analyzer.add(near);
  analyzer.add(nearer);
  EXPECT_EQ(analyzer.view().foreground[500], 1);
  analyzer.forget_background();
  EXPECT_FALSE(analyzer.view().background_known);
  EXPECT_THAT(analyzer.background_m(), IsEmpty());
  for (int i = 0; i < 41; ++i) analyzer.add(nearer);
  EXPECT_EQ(analyzer.view().foreground[500], 0);
  EXPECT_EQ(analyzer.background_m()[500], 2.0);
}

TEST(Analyzer, RefusesScansAndGeometriesThatMakeNoSense) {
  ScanGeometry geometry;
  Analyzer analyzer(geometry, {});
  EXPECT_THROW(analyzer.add({0, std::vector<std::uint32_t>(7, 1)}), std::invalid_argument);
  const auto broken = [](auto change) {
    ScanGeometry g;
    change(g);
    EXPECT_THROW(Analyzer(g, {}), std::invalid_argument);
  };
  broken([](ScanGeometry& g) { g.beams = 0; });
  broken([](ScanGeometry& g) { g.step_rad = 0.0; });
  broken([](ScanGeometry& g) { g.beam_period_s = -1.0; });
  broken([](ScanGeometry& g) { g.scan_period_s = std::nan(""); });
}

TEST(Analyzer, EndOfTheRecordEndsTheFlight) {
  sim::RecordPlan plan;
  plan.kicks = {kick(8.39, 36.78)};
  plan.fly_s = 0.97;  // it is in the air for 1.0 s
  plan.pause_s = 0.0;
  const auto lobs = lobs_of({}, plan);
  ASSERT_EQ(lobs.size(), 1u);
  expect_kick(lobs[0], plan.kicks[0]);
}

}  // namespace
}  // namespace trivela::kicking::lob
