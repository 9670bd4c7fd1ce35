#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/kicking/lob_scene.hpp"

namespace trivela::kicking::lob {
namespace {

using ::testing::HasSubstr;

constexpr ScannerPlace kPlace{4.0, 0.05};
const std::string kUnder = "lob_scan_utm_under.csv";
const std::string kNoiseless = "lob_scan_utm_under_noiseless_nodrag.csv";

void expect_effective(const LobRecord& lob, double angle_deg, double speed_mps) {
  ASSERT_TRUE(lob.effective);
  EXPECT_NEAR(degrees(lob.effective->exit_angle_rad.value), angle_deg, 0.1);
  EXPECT_NEAR(lob.effective->exit_speed_mps.value, speed_mps, 0.02);
}

void expect_true(const LobRecord& lob, double angle_deg, double speed_mps) {
  ASSERT_TRUE(lob.true_values);
  EXPECT_NEAR(degrees(lob.true_values->exit_angle_rad.value), angle_deg, 0.1);
  EXPECT_NEAR(lob.true_values->exit_speed_mps.value, speed_mps, 0.02);
}

TEST(LobVectors, NoisyFlightWithDragGivesItsTruth) {
  const LobRecord lob = analyse_returns(tests::returns_of(kUnder), kPlace);
  EXPECT_EQ(lob.refusal, Refusal::kNone) << lob.why;
  EXPECT_EQ(lob.centres.size(), 41u);
  expect_effective(lob, 37.61, 8.0927);
  expect_true(lob, 36.78, 8.39);
  EXPECT_NEAR(lob.true_values->drag_coefficient.value, 0.25, 0.02);
  EXPECT_GT(lob.true_values->drag_coefficient.se, 0.0);
  EXPECT_NEAR(static_cast<double>(lob.launch_t_ns), 0.0, 1e6);
}

TEST(LobVectors, KnownDragGivesTheTruthMoreClosely) {
  AnalyzerConfig config;
  config.drag_coefficient = 0.25;
  const LobRecord lob = analyse_returns(tests::returns_of(kUnder), kPlace, config);
  EXPECT_NEAR(degrees(lob.true_values->exit_angle_rad.value), 36.78, 0.05);
  EXPECT_NEAR(lob.true_values->exit_speed_mps.value, 8.39, 0.01);
  EXPECT_EQ(lob.true_values->drag_coefficient.value, 0.25);
  EXPECT_EQ(lob.true_values->drag_coefficient.se, 0.0);
}

TEST(LobVectors, WithoutNoiseAndDragBothFitsAgree) {
  const LobRecord lob = analyse_returns(tests::returns_of(kNoiseless), kPlace);
  EXPECT_EQ(lob.refusal, Refusal::kNone) << lob.why;
  expect_effective(lob, 36.78, 8.39);
  expect_true(lob, 36.78, 8.39);
  EXPECT_NEAR(lob.true_values->drag_coefficient.value, 0.0, 0.01);
  EXPECT_LT(lob.true_values->residual_rms_m, 0.002);
}

TEST(LobVectors, PapersCentreShowsItsBias) {
  AnalyzerConfig config;
  config.centre = CentreMethod::kMiddleOfLimits;
  const LobRecord lob = analyse_returns(tests::returns_of(kUnder), kPlace, config);
  EXPECT_EQ(lob.refusal, Refusal::kNone) << lob.why;
  for (const auto& row : tests::rows("lob_fit_accuracy.csv")) {
    if (row.text("geometry") != "under path x=4" || row.text("scanner") != "UTM40Hz") continue;
    if (row.text("estimator") != "endmid/HD") continue;
    EXPECT_NEAR(degrees(lob.effective->exit_angle_rad.value), row.number("theta_mean"), 3 * row.number("theta_sd"));
    EXPECT_NEAR(lob.effective->exit_speed_mps.value, row.number("V_mean"), 3 * row.number("V_sd"));
    return;
  }
  FAIL() << "no such row";
}

TEST(LobVectors, IgnoringTheTimesOfTheBeamsTiltsTheTimedFit) {
  auto returns = tests::returns_of(kUnder);
  for (auto& r : returns) r.beam_t_ns = r.scan_t_ns;
  AnalyzerConfig config;
  config.drag_coefficient = 0.25;
  const LobRecord lob = analyse_returns(returns, kPlace, config);
  ASSERT_TRUE(lob.true_values);
  EXPECT_GT(degrees(lob.true_values->exit_angle_rad.value), 36.78 + 0.3);
  expect_effective(lob, 37.61, 8.0927);  // the parabola has no times
}

TEST(AnalyseReturns, OrderOfTheRowsDoesNotMatter) {
  auto returns = tests::returns_of(kUnder);
  const LobRecord sorted = analyse_returns(returns, kPlace);
  std::shuffle(returns.begin(), returns.end(), std::mt19937(3));
  const LobRecord shuffled = analyse_returns(returns, kPlace);
  EXPECT_EQ(sorted.true_values->exit_speed_mps.value, shuffled.true_values->exit_speed_mps.value);
  EXPECT_EQ(sorted.effective->exit_angle_rad.value, shuffled.effective->exit_angle_rad.value);
}

TEST(AnalyseReturns, MirroredFlightIsTheSameLob) {
  auto returns = tests::returns_of(kUnder);
  const LobRecord lob = analyse_returns(returns, kPlace);
  for (auto& r : returns) r.elevation_rad = std::numbers::pi - r.elevation_rad;
  const LobRecord mirrored = analyse_returns(returns, {-4.0, 0.05});
  EXPECT_EQ(mirrored.refusal, Refusal::kNone) << mirrored.why;
  EXPECT_NEAR(mirrored.true_values->exit_speed_mps.value, lob.true_values->exit_speed_mps.value, 1e-3);
  EXPECT_NEAR(mirrored.true_values->exit_angle_rad.value, lob.true_values->exit_angle_rad.value, 5e-5);
  EXPECT_NEAR(mirrored.effective->exit_speed_mps.value, lob.effective->exit_speed_mps.value, 1e-3);
  EXPECT_NEAR(mirrored.effective->distance_m.value, lob.effective->distance_m.value, 1e-3);
}

TEST(AnalyseReturns, WronglyMeasuredPlaceAlongTheKickDoesNoHarm) {
  const auto returns = tests::returns_of(kUnder);
  const LobRecord right = analyse_returns(returns, kPlace), wrong = analyse_returns(returns, {4.4, 0.05});
  EXPECT_EQ(wrong.refusal, Refusal::kNone) << wrong.why;
  EXPECT_NEAR(wrong.true_values->exit_speed_mps.value, right.true_values->exit_speed_mps.value, 1e-6);
  EXPECT_NEAR(wrong.effective->exit_angle_rad.value, right.effective->exit_angle_rad.value, 1e-6);
}

/// The returns of the scans [first, last].
std::vector<ForegroundReturn> scans(std::vector<ForegroundReturn> returns, std::int64_t first, std::int64_t last) {
  std::erase_if(returns, [&](const auto& r) { return r.scan < first || r.scan > last; });
  return returns;
}

TEST(Refusal, TooFewPointsSaysHowMany) {
  const LobRecord lob = analyse_returns(scans(tests::returns_of(kUnder), 17, 23), kPlace);
  EXPECT_EQ(lob.refusal, Refusal::kTooFewPoints);
  EXPECT_EQ(lob.why, "7 centres of the ball, at least 8 are needed");
}

TEST(Refusal, OneSideOfTheApexSaysWhereTheApexIs) {
  for (const auto& [first, last] : {std::pair{0, 16}, std::pair{24, 41}}) {
    const LobRecord lob = analyse_returns(scans(tests::returns_of(kUnder), first, last), kPlace);
    EXPECT_EQ(lob.refusal, Refusal::kOneSideOfApex) << lob.why;
    EXPECT_THAT(lob.why, HasSubstr("on one side of the apex at x = 3."));
  }
}

TEST(Refusal, BadFitSaysByHowMuch) {
  AnalyzerConfig config;
  config.drag_coefficient = 0.9;  // of another ball
  const LobRecord lob = analyse_returns(tests::returns_of(kUnder), kPlace, config);
  EXPECT_EQ(lob.refusal, Refusal::kBadFit) << lob.why;
  EXPECT_THAT(lob.why, HasSubstr("at most 0.030 m are allowed"));
}

TEST(Refusal, FlightFromElsewhereIsABounceOrAWrongPlace) {
  const LobRecord lob = analyse_returns(tests::returns_of(kUnder), {6.5, 0.05});
  EXPECT_EQ(lob.refusal, Refusal::kBadFit);
  EXPECT_THAT(lob.why, HasSubstr("the flight starts at x = 2.5"));
}

TEST(Refusal, KeepsTheFitsThatCouldBeMade) {
  const LobRecord lob = analyse_returns(scans(tests::returns_of(kUnder), 17, 23), kPlace);
  EXPECT_TRUE(lob.effective);
  EXPECT_TRUE(lob.true_values);
}

TEST(WeakData, FallsBackToTheNominalDragAndSaysSo) {
  const LobRecord lob = analyse_returns(scans(tests::returns_of(kUnder), 17, 24), kPlace);
  ASSERT_TRUE(lob.true_values);
  EXPECT_EQ(lob.true_values->drag_coefficient.value, 0.25);
  EXPECT_EQ(lob.true_values->drag_coefficient.se, 0.0);
}

TEST(AnalyseReturns, NothingIsNoLob) {
  EXPECT_EQ(analyse_returns({}, kPlace).refusal, Refusal::kTooFewPoints);
  const ForegroundReturn one{0, 0, 1000, 1.0, 3.0};
  EXPECT_EQ(analyse_returns(std::vector{one}, kPlace).why, "no flight of a ball among 1 returns");
}

TEST(AnalyseReturns, RefusesContradictions) {
  const std::vector<ForegroundReturn> two_starts{{0, 0, 1000, 1.0, 3.0}, {0, 5, 1000, 1.01, 3.0}};
  EXPECT_THROW(analyse_returns(two_starts, kPlace), std::invalid_argument);
  const std::vector<ForegroundReturn> twice{{0, 0, 1000, 1.0, 3.0}, {0, 0, 1000, 1.0, 3.0}};
  EXPECT_THROW(analyse_returns(twice, kPlace), std::invalid_argument);
}

TEST(RefusalNames, AreTheOnesOfTheFiles) {
  EXPECT_STREQ(name(Refusal::kNone), "none");
  EXPECT_STREQ(name(Refusal::kTooFewPoints), "too_few_points");
  EXPECT_STREQ(name(Refusal::kOneSideOfApex), "one_side_of_apex");
  EXPECT_STREQ(name(Refusal::kPlaneMisaligned), "plane_misaligned");
  EXPECT_STREQ(name(Refusal::kBadFit), "bad_fit");
  EXPECT_STREQ(name(Refusal::kOperator), "operator");
}

}  // namespace
}  // namespace trivela::kicking::lob
