#include "kicking/model/power_table.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <map>
#include <type_traits>
#include <vector>

#include "kicking/model/robot_model.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::kicking {
namespace {

using testing::HasSubstr;
using testing::Throws;
using testing::ThrowsMessage;

static_assert(!std::is_convertible_v<TrueTable, EffectiveTable> &&
                  !std::is_constructible_v<EffectiveTable, TrueTable> &&
                  !std::is_assignable_v<EffectiveTable&, TrueTable>,
              "an effective table is never made from a true one");

TEST(PowerTable, AgreesWithTheVectors) {
  std::map<std::string, EffectiveTable> robots;  // CAMBADA release 1.0, kicker.map
  robots.emplace("1", RobotModel{}.table);
  robots.emplace(
      "3", EffectiveTable{
               {15, 6.03}, {20, 7.21}, {25, 8.24}, {30, 9.17}, {35, 9.63}, {40, 10.20}, {45, 10.31}, {50, 10.47}});
  robots.emplace(
      "5", EffectiveTable{
               {15, 6.24}, {20, 7.56}, {25, 8.61}, {30, 9.46}, {35, 10.13}, {40, 10.61}, {45, 10.85}, {50, 10.96}});
  const std::map<std::string, PowerRange> ranges{
      {"below", PowerRange::kBelow}, {"in", PowerRange::kIn}, {"above", PowerRange::kAbove}};
  for (const auto& row : tests::rows("power_table.csv")) {
    SCOPED_TRACE(row.where());
    const EffectiveTable& table = robots.at(row.text("robot"));
    const PowerReading reading = table.power_for(row.number("v_wanted"));
    EXPECT_NEAR(reading.power, row.number("power"), 1e-6);
    EXPECT_EQ(reading.range, ranges.at(row.text("range")));
    EXPECT_NEAR(table.speed_for(row.number("power_truncated")) - row.number("v_wanted"),
                row.number("speed_error_trunc"), 1e-6);
  }
}

TEST(PowerTable, SpeedOfThePowerIsTheSpeedAskedFor) {
  const EffectiveTable table = RobotModel{}.table;
  for (double speed = table.front().speed_mps; speed <= table.back().speed_mps; speed += 0.01) {
    EXPECT_NEAR(table.speed_for(table.power_for(speed).power), speed, 1e-12);
  }
}

TEST(PowerTable, ClampsAtItsEnds) {
  const TrueTable table{{10, 4}, {20, 8}};
  EXPECT_EQ(table.speed_for(5), 4);
  EXPECT_EQ(table.speed_for(25), 8);
  EXPECT_EQ(table.power_for(3).range, PowerRange::kBelow);
  EXPECT_EQ(table.power_for(9).range, PowerRange::kAbove);
  EXPECT_EQ(table.power_for(9).power, 20);
}

TEST(PowerTable, NamesIndexAndValueOfABadSetPoint) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto make = [](std::vector<SetPoint> points) {
    return [points] { EffectiveTable table{std::span<const SetPoint>(points)}; };
  };
  EXPECT_THAT(make({{15, 6}, {20, 5.5}}), ThrowsMessage<std::invalid_argument>(HasSubstr("speed_mps[1] = 5.5")));
  EXPECT_THAT(make({{15, 6}, {15, 7}}), ThrowsMessage<std::invalid_argument>(HasSubstr("power[1] = 15")));
  EXPECT_THAT(make({{15, nan}, {20, 7}}), ThrowsMessage<std::invalid_argument>(HasSubstr("speed_mps[0] = nan")));
  EXPECT_THAT(make({{-1, 6}, {20, 7}}), ThrowsMessage<std::invalid_argument>(HasSubstr("power[0] = -1")));
  EXPECT_THAT(make({{15, 6}}), ThrowsMessage<std::invalid_argument>(HasSubstr("1 set-points, need 2 to 256")));
  EXPECT_THAT(make(std::vector<SetPoint>(257)), Throws<std::invalid_argument>());
}

}  // namespace
}  // namespace trivela::kicking
