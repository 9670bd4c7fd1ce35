#include "kicking/ballistics/moving_kick.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::kicking {
namespace {

const Elevation kAngle(radians(36.78));

TEST(DirectedKick, OfARobotAtRestThatFacesTheLineIsTheCrossingSpeed) {
  const auto kick = directed_kick({5.73, 1.0, 0.0}, 0.59, kAngle);
  ASSERT_TRUE(kick);
  EXPECT_NEAR(kick->v_kick_mps, *crossing_speed({5.73, 0.59}, kAngle.angle_rad), 1e-9);
}

TEST(DirectedKick, CrossesAtTheHeightWhereverItPointsAndHoweverItIsCarried) {
  for (const double toward : {1.0, 0.9, 0.5}) {
    for (const double carried : {-2.0, -0.5, 0.0, 0.7, 2.2}) {
      for (const double distance : {2.0, 5.0, 9.0}) {
        const auto kick = directed_kick({distance, toward, carried}, 0.4, kAngle);
        ASSERT_TRUE(kick) << toward << ' ' << carried << ' ' << distance;
        const double w = kick->v_kick_mps * kAngle.cosine * toward + carried;
        EXPECT_NEAR(w * kick->t_flight_s, distance, 1e-9);
        EXPECT_NEAR(height_at(distance, w, kick->v_kick_mps * kAngle.sine), 0.4, 1e-9);
      }
    }
  }
}

TEST(DirectedKick, IsNoneWhereNoSpeedReachesTheHeight) {
  EXPECT_FALSE(directed_kick({0.5, 1.0, 0.0}, 0.5, kAngle));      // above the straight line
  EXPECT_FALSE(directed_kick({5.0, 0.0, 0.0}, 0.5, kAngle));      // along the goal line
  EXPECT_FALSE(directed_kick({5.0, -0.5, 0.0}, 0.5, kAngle));     // away from it
  EXPECT_FALSE(directed_kick({5.0, 1.0, 200.0}, -0.05, kAngle));  // the robot alone is too fast
  EXPECT_FALSE(directed_kick({NAN, 1.0, 0.0}, 0.5, kAngle));
}

}  // namespace
}  // namespace trivela::kicking
