#include "kicking/ballistics/moving_kick.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kicking/geometry/angle.hpp"
#include "tests/kicking/reference_laws.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::kicking {
namespace {

TEST(MovingKick, BothLawsAgreeWithTheVectors) {
  for (const auto& row : tests::rows("moving_kick.csv")) {
    SCOPED_TRACE(row.where());
    const double angle = radians(row.number("theta_deg"));
    const FlightPoint point{row.number("d_m"), row.number("h_rel_m")};
    const double u = row.number("k_transfer") * row.number("v_front_mps");
    const auto v0 = crossing_speed(point, angle);
    ASSERT_TRUE(v0);
    EXPECT_NEAR(moving_kick_exact(point, angle, u).value(), row.number("vk_exact"), 1e-6);
    const double paper = moving_kick_paper(*v0, u, angle);
    EXPECT_NEAR(paper, row.number("vk_paper"), 1e-6);
    EXPECT_NEAR(height_at(point.distance_m, paper * std::cos(angle) + u, paper * std::sin(angle)),
                row.number("height_crossed_with_paper"), 1e-6);
  }
}

TEST(MovingKick, WithoutMotionIsTheStandingKick) {
  const FlightPoint point{5.73, 0.59};
  const double angle = radians(36.78);
  const double v0 = *crossing_speed(point, angle);
  EXPECT_NEAR(*moving_kick_exact(point, angle, 0.0), v0, 1e-12);
  EXPECT_EQ(moving_kick_paper(v0, 0.0, angle), v0);
  EXPECT_NEAR(aim_exact(point, angle, {})->v_kick_mps, v0, 1e-12);
}

TEST(MovingKick, ExactLawSendsTheBallThroughThePoint) {
  for (double d = 1.5; d < 12; d += 0.7) {
    for (double h = 0.0; h < 0.8; h += 0.2) {
      for (double u = -3.0; u <= 4.0; u += 0.25) {
        const double angle = radians(36.78);
        const auto v = moving_kick_exact({d, h}, angle, u);
        ASSERT_TRUE(v);
        EXPECT_GT(*v, 0.0);
        EXPECT_GT(*v * std::cos(angle) + u, 0.0);
        EXPECT_NEAR(height_at(d, *v * std::cos(angle) + u, *v * std::sin(angle)), h, 1e-9);
      }
    }
  }
}

TEST(MovingKick, IsNoneOutOfTheAnglesReach) {
  EXPECT_FALSE(moving_kick_exact({1.0, 1.0}, radians(45), 1.0));
  EXPECT_FALSE(moving_kick_exact({-1.0, 0.0}, radians(45), 1.0));
  EXPECT_FALSE(moving_kick_exact({5.0, std::nan("")}, radians(45), 1.0));
}

TEST(KGeometric, AgreesWithTheVectors) {
  for (const auto& row : tests::rows("k_geometric.csv")) {
    EXPECT_NEAR(k_geometric({row.number("d_m"), row.number("h_rel_m")}, radians(row.number("theta_deg"))),
                row.number("k_geom"), 1e-6)
        << row.where();
  }
}

TEST(KGeometric, IsTheSlopeOfTheExactLaw) {
  const FlightPoint point{5.73, 0.59};
  const double angle = radians(36.78);
  const double slope = (*moving_kick_exact(point, angle, 1e-4) - *moving_kick_exact(point, angle, -1e-4)) / 2e-4;
  EXPECT_NEAR(k_geometric(point, angle), -slope / std::cos(angle), 1e-7);
}

TEST(AimExact, AgreesWithTheVectors) {
  for (const auto& row : tests::rows("aim_exact.csv")) {
    SCOPED_TRACE(row.where());
    const auto aim = aim_exact({row.number("d_m"), row.number("h_rel_m")}, radians(row.number("theta_deg")),
                               {row.number("w_along_mps"), row.number("w_right_mps")});
    ASSERT_TRUE(aim);
    EXPECT_NEAR(aim->v_kick_mps, row.number("vk_mps"), 1e-6);
    EXPECT_NEAR(degrees(left_of_target_rad(*aim)), row.number("heading_left_of_target_deg"), 1e-6);
    EXPECT_NEAR(aim->t_flight_s, row.number("flight_time_s"), 1e-6);
  }
}

TEST(AimExact, HitsThePointAndMirrors) {
  const double angle = radians(36.78);
  for (double d = 2.0; d < 11; d += 1.1) {
    for (double along = -2.0; along <= 2.5; along += 0.5) {
      for (double right = 0.0; right <= 2.5; right += 0.5) {
        const auto aim = aim_exact({d, 0.59}, angle, {along, right});
        ASSERT_TRUE(aim);
        const double v_h = aim->v_kick_mps * std::cos(angle);
        EXPECT_NEAR(v_h * std::sin(left_of_target_rad(*aim)), right, 1e-9);
        const double towards = v_h * std::cos(left_of_target_rad(*aim)) + along;
        EXPECT_NEAR(height_at(d, towards, aim->v_kick_mps * std::sin(angle)), 0.59, 1e-9);
        const auto mirrored = aim_exact({d, 0.59}, angle, {along, -right});
        EXPECT_NEAR(mirrored->v_kick_mps, aim->v_kick_mps, 1e-12);
        EXPECT_NEAR(left_of_target_rad(*mirrored), -left_of_target_rad(*aim), 1e-12);
        if (right == 0.0) {
          EXPECT_NEAR(aim->v_kick_mps, *moving_kick_exact({d, 0.59}, angle, along), 1e-9);
        }
      }
    }
  }
}

TEST(AimExact, IsNoneOutOfReachOrBackwards) {
  EXPECT_FALSE(aim_exact({0.5, 0.59}, radians(36.78), {}));
  EXPECT_FALSE(aim_exact({3.0, 0.0}, radians(36.78), {50.0, 0.0}));  // the ball would have to be held back
  EXPECT_FALSE(aim_exact({std::nan(""), 0.0}, radians(36.78), {}));
}

}  // namespace
}  // namespace trivela::kicking
