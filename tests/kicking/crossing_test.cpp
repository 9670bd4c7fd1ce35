#include "kicking/ballistics/crossing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kicking/geometry/angle.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::kicking {
namespace {

/// The paper's range law (section 2.2) [m/s]: V0 = sqrt(D g / sin(2 theta)).
double range_speed(double range_m, double exit_angle_rad) {
  return std::sqrt(range_m * kGravity_mps2 / std::sin(2.0 * exit_angle_rad));
}

TEST(CrossingSpeed, AgreesWithTheVectors) {
  for (const auto& row : tests::rows("v0_for_crossing.csv")) {
    SCOPED_TRACE(row.where());
    const double angle = radians(row.number("theta_deg"));
    const FlightPoint point{row.number("d_m"), row.number("h_rel_m")};
    const auto v0 = crossing_speed(point, angle);
    ASSERT_TRUE(v0);
    EXPECT_NEAR(*v0, row.number("v0_exact_mps"), 1e-6);
    EXPECT_EQ(descends_through(point, angle), row.flag("descending"));
    EXPECT_NEAR(range_speed(row.number("D_landing_m"), angle), *v0, 1e-6);

    const double released = range_speed(extended_range(point, angle), angle);
    EXPECT_NEAR(released, row.number("v0_cambada_extended_range_mps"), 1e-6);
    EXPECT_NEAR(height_at(point.distance_m, released * std::cos(angle), released * std::sin(angle)),
                row.number("height_really_crossed_by_cambada_m"), 1e-6);
  }
}

TEST(CrossingSpeed, SendsTheBallThroughThePoint) {
  for (double angle_deg = 5; angle_deg < 89; angle_deg += 7) {
    for (double d = 0.3; d < 15; d *= 1.5) {
      for (double h = -0.1; h < 2; h += 0.3) {
        const double angle = radians(angle_deg);
        const auto v0 = crossing_speed({d, h}, angle);
        ASSERT_EQ(v0.has_value(), d * std::tan(angle) > h);
        if (v0) {
          EXPECT_NEAR(height_at(d, *v0 * std::cos(angle), *v0 * std::sin(angle)), h, 1e-9);
        }
      }
    }
  }
}

TEST(CrossingSpeed, IsNoneWhereNoSpeedReaches) {
  EXPECT_FALSE(crossing_speed({1.0, 1.0}, radians(45)));  // the line of the kick itself
  EXPECT_FALSE(crossing_speed({0.0, -1.0}, radians(45)));
  EXPECT_FALSE(crossing_speed({-2.0, 0.0}, radians(45)));
  EXPECT_FALSE(crossing_speed({std::numeric_limits<double>::quiet_NaN(), 0.0}, radians(45)));
}

}  // namespace
}  // namespace trivela::kicking
