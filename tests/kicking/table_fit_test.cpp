#include "kicking/fit/table_fit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "kicking/geometry/angle.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::kicking {
namespace {

using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::ThrowsMessage;

const double kAngle = radians(37.0);

TEST(TableFit, TrialsOfLobsAreThoseOfTheVectors) {
  for (const auto& row : tests::rows("calib_theta_v0.csv")) {
    const Trial trial = trial_of_lob(20, row.number("H_m"), row.number("D_m"));
    EXPECT_NEAR(trial.exit_angle_rad, row.number("theta_rad"), 1e-6);
    EXPECT_NEAR(trial.exit_speed_mps, row.number("v0_mps"), 1e-6);
  }
}

TEST(TableFit, AveragesTheTrialsOfAPower) {
  const TableFit fit = fit_table(std::vector<Trial>{
      {30, radians(37.2), 8.0}, {20, radians(36.8), 6.1}, {30, radians(37.0), 8.4}, {20, radians(37.0), 6.1}});
  ASSERT_EQ(fit.set_points.size(), 2u);
  EXPECT_EQ(fit.set_points[0].power, 20);
  EXPECT_EQ(fit.set_points[1].trials, 2);
  EXPECT_NEAR(fit.set_points[1].exit_speed_mps.mean, 8.2, 1e-12);
  EXPECT_NEAR(fit.set_points[1].exit_speed_mps.sd, 0.4 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(degrees(fit.set_points[0].exit_angle_rad.mean), 36.9, 1e-12);
  EXPECT_NEAR(degrees(fit.exit_angle_rad.value), 37.0, 1e-12);
  EXPECT_NEAR(degrees(fit.exit_angle_rad.se), std::sqrt(0.08 / 3.0) / 2.0, 1e-12);
  EXPECT_NEAR(degrees(fit.angle_spread_rad), 0.2, 1e-12);
  EXPECT_NEAR(fit.exit_speed_sd_mps, 0.2, 1e-12);  // sqrt((0 + 0.08) / 2)
  EXPECT_NEAR(fit.residual_mps[2], 0.2, 1e-12);
  EXPECT_THAT(fit.warnings, IsEmpty());
  EXPECT_EQ(fit.shared_angle_warning, "");
  EXPECT_TRUE(fit.rises());
  EXPECT_EQ(fit.table()[1].speed_mps, fit.set_points[1].exit_speed_mps.mean);
}

TEST(TableFit, WarnsOfAnglesThatDifferAndOfSingleTrials) {
  const TableFit fit = fit_table(std::vector<Trial>{{20, radians(45.0), 6},
                                                    {30, radians(43.5), 7},
                                                    {30, radians(43.5), 7},
                                                    {40, radians(43.0), 8},
                                                    {40, radians(44.5), 8}});
  EXPECT_THAT(fit.shared_angle_warning, HasSubstr("differs by 1.5 degrees from set-point to set-point"));
  EXPECT_THAT(fit.warnings, ElementsAre(HasSubstr("power 20: a single trial"),
                                        HasSubstr("power 40: the exit angle differs by 1.5 degrees from trial")));
}

TEST(TableFit, LeavesWeakKicksOutOfTheAngleWhenAsked) {
  const std::vector<Trial> trials{{15, radians(40), 5}, {25, radians(36), 6}, {35, radians(37), 7}};
  EXPECT_NEAR(degrees(fit_table(trials, {.least_angle_power = 25}).exit_angle_rad.value), 36.5, 1e-12);
  EXPECT_THAT([&] { fit_table(trials, {.least_angle_power = 99}); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("no power reaches 99")));
}

TEST(TableFit, NamesTheRowsThatDoNotRiseAndMakesNoTableOfThem) {
  const TableFit fit =
      fit_table(std::vector<Trial>{{10, kAngle, 5}, {20, kAngle, 7}, {30, kAngle, 6.5}, {40, kAngle, 7}});
  EXPECT_THAT(fit.not_rising, ElementsAre(2, 3));
  EXPECT_FALSE(fit.rises());
  EXPECT_THAT([&] { fit.table(); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("power 30 is not faster (6.5 m/s)")));
}

TEST(TableFit, PoolsViolatorsByTrialsWhenAsked) {
  const TableFit fit = fit_table(
      std::vector<Trial>{{10, kAngle, 5}, {20, kAngle, 7}, {20, kAngle, 7}, {30, kAngle, 6.4}, {40, kAngle, 8}},
      {.isotonic = true});
  EXPECT_TRUE(fit.isotonic);
  EXPECT_THAT(fit.not_rising, ElementsAre(2));
  EXPECT_NEAR(fit.set_points[1].exit_speed_mps.mean, 6.8 - 0.001, 1e-12);  // (2 * 7 + 6.4) / 3
  EXPECT_NEAR(fit.set_points[2].exit_speed_mps.mean, 6.8 + 0.001, 1e-12);
  EXPECT_EQ(fit.set_points[3].exit_speed_mps.mean, 8);
  EXPECT_NO_THROW(EffectiveTable{std::span<const SetPoint>(fit.table())});
}

TEST(TableFit, IsotonicLeavesARisingTableAlone) {
  const std::vector<Trial> trials{{10, kAngle, 5}, {20, kAngle, 7}};
  EXPECT_FALSE(fit_table(trials, {.isotonic = true}).isotonic);
  EXPECT_EQ(fit_table(trials, {.isotonic = true}).table()[1].speed_mps, 7);
}

TEST(Isotonic, RisesAndIsNearestOfAll) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> step(-3, 4);
  for (int run = 0; run < 200; ++run) {
    std::vector<WeightedSpeed> speeds;
    for (int i = 0; i < 10; ++i) speeds.push_back({7.0 + 0.1 * step(random), 1.0 + run % 3});
    const std::vector<double> rising = rising_speeds(speeds);
    double mean_before = 0.0, mean_after = 0.0;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      if (i > 0) {
        EXPECT_GT(rising[i], rising[i - 1]);
      }
      mean_before += speeds[i].speed_mps;
      mean_after += rising[i];
    }
    EXPECT_NEAR(mean_after, mean_before, 1e-9);
    // Min-max formula: the pooled value at i is max over j <= i of min over k >= i of the mean of j..k.
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      double best = -HUGE_VAL;
      for (std::size_t j = 0; j <= i; ++j) {
        double least = HUGE_VAL;
        for (std::size_t k = i; k < speeds.size(); ++k) {
          double sum = 0.0;
          for (std::size_t m = j; m <= k; ++m) sum += speeds[m].speed_mps;
          least = std::min(least, sum / static_cast<double>(k - j + 1));
        }
        best = std::max(best, least);
      }
      EXPECT_NEAR(rising[i], best, 0.0101);  // ten members 2 mm/s apart
    }
  }
}

TEST(TableFit, RefusesWhatIsNoTable) {
  const auto fit = [](std::vector<Trial> trials) { return [trials] { fit_table(trials); }; };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(fit({}), ThrowsMessage<std::invalid_argument>("table: 0 powers, need 2 to 256"));
  EXPECT_THAT(fit({{10, kAngle, 5}, {10, kAngle, 6}}),
              ThrowsMessage<std::invalid_argument>("table: 1 power, need 2 to 256"));
  EXPECT_THAT(fit({{10, kAngle, 5}, {nan, kAngle, 6}}),
              ThrowsMessage<std::invalid_argument>(HasSubstr("trial 2: the power")));
  EXPECT_THAT(fit({{10, kAngle, -5}, {20, kAngle, 6}}),
              ThrowsMessage<std::invalid_argument>(HasSubstr("trial 1: the exit speed")));
  EXPECT_THAT(fit({{10, 0, 5}, {20, kAngle, 6}}),
              ThrowsMessage<std::invalid_argument>(HasSubstr("trial 1: the exit angle")));
  std::vector<Trial> many;
  for (int i = 1; i <= 257; ++i) many.push_back({double(i), kAngle, double(i)});
  EXPECT_THAT(fit(many), ThrowsMessage<std::invalid_argument>(HasSubstr("257 powers")));
  EXPECT_THROW(trial_of_lob(20, 0, 3), std::invalid_argument);
}

}  // namespace
}  // namespace trivela::kicking
