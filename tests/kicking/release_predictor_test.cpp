#include "kicking/alignment/release_predictor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kicking/ballistics/moving_kick.hpp"
#include "kicking/geometry/angle.hpp"
#include "tests/kicking/reference_laws.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::kicking {
namespace {

TEST(ReleasePredictor, AgreesWithTheVectors) {
  for (const auto& row : tests::rows("release_prediction.csv")) {
    SCOPED_TRACE(row.where());
    const double k = row.number("k");
    const KickAction kick{
        row.number("vk"), radians(row.number("theta_deg")), {k, k, k}, row.number("tau_s"), row.number("r_m")};
    const auto crossing =
        predict_crossing({row.number("px"), row.number("py"), row.number("orientation_rad")},
                         {row.number("vx"), row.number("vy"), row.number("omega")}, kick, row.number("goal_y"));
    ASSERT_EQ(crossing.has_value(), row.has("x_cross"));
    if (!crossing) continue;
    EXPECT_NEAR(crossing->x_m, row.number("x_cross"), 1e-6);
    EXPECT_NEAR(crossing->z_m, row.number("z_cross"), 1e-6);
    EXPECT_NEAR(crossing->t_flight_s, row.number("t_flight"), 1e-6);
    EXPECT_NEAR(crossing->release_m.x(), row.number("ball_x"), 1e-6);
    EXPECT_NEAR(crossing->release_m.y(), row.number("ball_y"), 1e-6);
    EXPECT_NEAR(crossing->release_heading_rad, row.number("orientation_release"), 1e-6);
  }
}

TEST(ReleasePredictor, OfARobotAtRestIsTheCrossingLaw) {
  for (double y = -1.0; y < 7.0; y += 0.5) {
    const double d = 9.0 - y - 0.27;
    const double v0 = crossing_speed({d, 0.59}, radians(36.78)).value();
    const auto crossing = predict_crossing({0, y, 0}, {}, {v0, radians(36.78), {}, 0.06, 0.27}, 9.0);
    EXPECT_NEAR(crossing->z_m, 0.70, 1e-9);
    EXPECT_NEAR(crossing->x_m, 0.0, 1e-12);
  }
}

TEST(ReleasePredictor, ConfirmsTheJointAim) {
  // The robot drives sideways and forward without turning; its heading leads the target by the aim's angle.
  const Twist twist{1.2, 0.8, 0.0};
  double heading = 0.0;
  Aim aim;
  for (int i = 0; i < 50; ++i) {  // the carry depends on the heading, which depends on the carry
    const Pose release = advance({1, 3, heading}, twist, 0.06);
    const Eigen::Vector2d ball = to_field(release, {0, 0.27});
    const Eigen::Vector2d line = Eigen::Vector2d(0, 9) - ball;
    const Eigen::Vector2d carry = rotate({twist.vx_mps, twist.vy_mps}, heading);
    const Eigen::Vector2d t = line.normalized();
    aim = aim_exact({line.norm(), 0.59}, radians(36.78), {carry.dot(t), carry.x() * t.y() - carry.y() * t.x()}).value();
    heading = bearing(ball, {0, 9}) + left_of_target_rad(aim);
  }
  const auto crossing = predict_crossing({1, 3, heading}, twist, {aim.v_kick_mps, radians(36.78), {}, 0.06, 0.27}, 9.0);
  EXPECT_NEAR(crossing->x_m, 0.0, 1e-6);
  EXPECT_NEAR(crossing->z_m, 0.70, 1e-6);
}

TEST(ReleasePredictor, WithoutTransferOnlyTheDelayMovesTheBall) {
  const Transfer none{0.0, 0.0, 0.0};
  const KickAction kick{8.0, radians(36.78), none, 0.1, 0.27};
  const auto moving = predict_crossing({0, 3, 0}, {1.0, 2.0, 0.0}, kick, 9.0);
  const auto standing = predict_crossing({0.1, 3.2, 0}, {}, kick, 9.0);
  EXPECT_NEAR(moving->x_m, standing->x_m, 1e-12);
  EXPECT_NEAR(moving->z_m, standing->z_m, 1e-12);
}

TEST(ReleasePredictor, IsNoneWhereTheBallNeverCrosses) {
  const KickAction kick{8.0, radians(36.78), {}, 0.06, 0.27};
  EXPECT_FALSE(predict_crossing({0, 3, std::numbers::pi}, {}, kick, 9.0));
  EXPECT_FALSE(predict_crossing({0, 10, 0}, {}, kick, 9.0));
  EXPECT_FALSE(predict_crossing({0, std::nan(""), 0}, {}, kick, 9.0));
  EXPECT_FALSE(predict_crossing({0, 3, 0}, {}, {0.0, 0.6, {}, 0.0, 0.27}, 9.0));
}

}  // namespace
}  // namespace trivela::kicking
