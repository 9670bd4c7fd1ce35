#include "sim/kicker/hand_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kicking/ballistics/flight.hpp"
#include "sim/kicker/flight.hpp"
#include "sim/kicker/kicker.hpp"

namespace trivela::sim {
namespace {

Scenario careful_hand() {
  Scenario scenario;
  scenario.hand_table.eye_height_sd_m = 0.0;
  scenario.hand_table.day_sd_ratio = 0.0;
  scenario.kicker.speed_sd_ratio = 0.0;
  return scenario;
}

/// Height at which a ball of that power crosses the distance, over the launch.
double height_m(const Scenario& scenario, const kicking::DistancePoint& point) {
  const Exit exit = exit_at(scenario.kicker, point.power);
  return kicking::cross_with_drag(point.distance_m, scenario.kicker.speed_scale_ratio * exit.speed_mps,
                                  exit.elevation_rad, drag_per_m(scenario.ball))
      .height_m;
}

TEST(HandTable, OfACarefulHandPassesNearTheTargetsHeight) {
  for (const double scale : {0.96, 1.0, 1.04}) {
    Scenario scenario = careful_hand();
    scenario.kicker.speed_scale_ratio = scale;
    const auto table = draw_hand_table(scenario, scenario.kicker, 1, 1, 1);
    ASSERT_GE(table.points.size(), 5u);
    // What whole numbers and a parabola through them cost.
    for (const auto& point : table.points) EXPECT_NEAR(height_m(scenario, point), 0.59, 0.25) << point.distance_m;
  }
}

TEST(HandTable, IsTheSameForEveryArmAndAnotherInEachMatch) {
  const Scenario scenario;
  const auto powers = [&](std::uint64_t seed, std::uint32_t match, std::uint32_t robot) {
    std::vector<double> out;
    for (const auto& point : draw_hand_table(scenario, scenario.kicker, seed, match, robot).points)
      out.push_back(point.power);
    return out;
  };
  EXPECT_EQ(powers(1, 2, 1), powers(1, 2, 1));
  EXPECT_NE(powers(1, 2, 1), powers(1, 3, 1));
  EXPECT_NE(powers(1, 2, 1), powers(2, 2, 1));
  EXPECT_NE(powers(1, 2, 1), powers(1, 2, 2));
}

TEST(HandTable, RisesInEveryDraw) {
  const Scenario scenario;
  for (std::uint32_t match = 0; match < 300; ++match) {
    const auto table = draw_hand_table(scenario, scenario.kicker, 5, match, 1);
    for (std::size_t i = 1; i < table.points.size(); ++i) {
      EXPECT_GT(table.points[i].power, table.points[i - 1].power);
      EXPECT_GT(table.points[i].distance_m, table.points[i - 1].distance_m);
    }
    EXPECT_NO_THROW(kicking::effective_table(table, kicking::HeightLaw::kExact, 0.70, {}));
  }
}

TEST(HandTable, AKickerThatWasFasterOnItsDayIsTooWeakInTheMatch) {
  Scenario scenario = careful_hand();
  scenario.hand_table.day_sd_ratio = 0.05;
  int weak = 0, strong = 0;
  for (std::uint32_t match = 0; match < 200; ++match) {
    const auto table = draw_hand_table(scenario, scenario.kicker, 9, match, 1);
    (height_m(scenario, table.points[2]) < 0.59 ? weak : strong) += 1;
  }
  EXPECT_GT(weak, 60);
  EXPECT_GT(strong, 60);
}

TEST(HandTable, ACommonErrorOfTheEyeMovesAllHeightsOfATable) {
  Scenario scenario = careful_hand();
  scenario.hand_table.eye_bias_sd_m = 0.15;
  double sum = 0.0, squares = 0.0, within = 0.0;
  constexpr int kTables = 300;
  for (std::uint32_t match = 0; match < kTables; ++match) {
    const auto table = draw_hand_table(scenario, scenario.kicker, 4, match, 1);
    // Of the distances in the middle, where whole numbers are fine.
    const double near = height_m(scenario, table.points[2]), far = height_m(scenario, table.points[3]);
    const double error = 0.5 * (near + far) - 0.59;
    sum += error;
    squares += error * error;
    within += (near - far) * (near - far);
  }
  EXPECT_NEAR(sum / kTables, 0.0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / kTables), 0.15, 0.04);
  EXPECT_LT(std::sqrt(within / kTables), 0.15) << "a table's heights err alike";
}

TEST(HandTable, ACommonErrorChangesNoOtherDraw) {
  Scenario scenario;
  const auto before = draw_hand_table(scenario, scenario.kicker, 4, 7, 1);
  scenario.hand_table.eye_bias_sd_m = 1e-12;
  const auto after = draw_hand_table(scenario, scenario.kicker, 4, 7, 1);
  ASSERT_EQ(before.points.size(), after.points.size());
  for (std::size_t i = 0; i < before.points.size(); ++i)
    EXPECT_NEAR(before.points[i].power, after.points[i].power, 1e-9);
}

TEST(HandTable, ATableThatNobodyCouldPlayByIsMadeAgain) {
  Scenario scenario;
  scenario.hand_table.day_sd_ratio = 0.08;  // with this one of the first 400 matches drew a table of one distance
  for (std::uint32_t match = 0; match < 3000; ++match) {
    const auto table = draw_hand_table(scenario, scenario.kicker, 1, match, 1);
    EXPECT_GE(table.points.size(), 2u);
  }
  scenario.hand_table.day_sd_ratio = 0.15;
  for (std::uint32_t match = 0; match < 3000; ++match)
    EXPECT_GE(draw_hand_table(scenario, scenario.kicker, 1, match, 1).points.size(), 2u);
}

TEST(HandTable, SaysWhenTheKickerReachesNoDistance) {
  Scenario scenario = careful_hand();
  scenario.hand_table.distances_m = {18.0, 20.0};
  EXPECT_THROW(draw_hand_table(scenario, scenario.kicker, 1, 1, 1), std::runtime_error);
}

}  // namespace
}  // namespace trivela::sim
