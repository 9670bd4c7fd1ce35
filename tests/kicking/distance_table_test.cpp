#include "kicking/model/distance_table.hpp"

#include <gtest/gtest.h>

#include "kicking/policy/shot.hpp"

namespace trivela::kicking {
namespace {

const DistanceTable kTable{{{3.0, 17.0}, {4.0, 19.0}, {5.0, 22.0}, {6.0, 25.0}, {7.0, 29.0}, {8.0, 33.0}}};

TEST(DistanceTable, ARobotAtRestKicksWithItsPowerByEveryLaw) {
  for (const HeightLaw law : {HeightLaw::kPaper, HeightLaw::kExtendedRange, HeightLaw::kExact}) {
    PolicyConfig config;
    config.height_law = law;
    const RobotModel robot = with_distance_table(RobotModel{}, kTable, law, config.target_height_m);
    for (const DistancePoint& point : kTable.points) {
      PolicyInput input;
      input.pose = {0.0, Goal{}.y_m - point.distance_m - robot.ball_offset_m, 0.0};
      const Shot shot = stopped_shot(config, robot, Goal{}, input, {0.0, Goal{}.y_m});
      ASSERT_TRUE(shot.power);
      EXPECT_NEAR(*shot.power, point.power, 1e-9) << static_cast<int>(law) << " from " << point.distance_m;
    }
  }
}

TEST(DistanceTable, RefusesWhatIsNoTable) {
  const auto make = [](const DistanceTable& table) {
    return effective_table(table, HeightLaw::kExact, 0.70, RobotModel{});
  };
  EXPECT_THROW(make({}), std::invalid_argument);
  EXPECT_THROW(make({{{3.0, 17.0}}}), std::invalid_argument);
  EXPECT_THROW(make({{{3.0, 17.0}, {3.0, 19.0}}}), std::invalid_argument);  // one distance twice
  EXPECT_THROW(make({{{3.0, 17.0}, {4.0, 17.0}}}), std::invalid_argument);  // powers that do not rise
  EXPECT_THROW(make({{{0.5, 17.0}, {4.0, 19.0}}}), std::invalid_argument);  // too near for the height
}

}  // namespace
}  // namespace trivela::kicking
