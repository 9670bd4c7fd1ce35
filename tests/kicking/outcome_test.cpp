#include "kicking/outcome/outcome.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kicking/ballistics/moving_kick.hpp"
#include "kicking/geometry/angle.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::kicking {
namespace {

TEST(Outcome, FollowsTheFrameFromInsideToOutside) {
  const Goal goal;
  EXPECT_EQ(classify(0.0, 0.7, goal), Outcome::kOnTarget);
  EXPECT_EQ(classify(0.889, 0.889, goal), Outcome::kOnTarget);
  EXPECT_EQ(classify(0.0, 0.11, goal), Outcome::kOnTarget);  // rolls in
  EXPECT_EQ(classify(0.891, 0.3, goal), Outcome::kPost);
  EXPECT_EQ(classify(-1.234, 0.3, goal), Outcome::kPost);
  EXPECT_EQ(classify(-1.236, 0.3, goal), Outcome::kWideLeft);
  EXPECT_EQ(classify(1.236, 5.0, goal), Outcome::kWideRight);
  EXPECT_EQ(classify(0.0, 0.891, goal), Outcome::kBar);
  EXPECT_EQ(classify(0.5, 1.234, goal), Outcome::kBar);
  EXPECT_EQ(classify(0.5, 1.236, goal), Outcome::kOver);
  EXPECT_EQ(classify(1.0, 1.5, goal), Outcome::kOver);
  EXPECT_EQ(classify(1.0, 1.0, goal), Outcome::kPost);
  EXPECT_EQ(classify(std::nan(""), 0.5, goal), Outcome::kUnknown);
  EXPECT_EQ(classify(0.0, INFINITY, goal), Outcome::kUnknown);
}

TEST(Outcome, FollowsTheSizeOfGoalAndBall) {
  EXPECT_EQ(classify(1.05, 0.5, {.half_width_m = 1.2}), Outcome::kOnTarget);
  EXPECT_EQ(classify(0.95, 0.5, {}, {.radius_m = 0.03}), Outcome::kOnTarget);
}

TEST(Outcome, HasTheWordsOfTheLog) {
  EXPECT_STREQ(name(Outcome::kOnTarget), "on_target");
  EXPECT_STREQ(name(Outcome::kWideLeft), "wide_left");
  EXPECT_STREQ(name(Outcome::kUnknown), "unknown");
}

TEST(PInside, AgreesWithTheVectors) {
  for (const auto& row : tests::rows("p_inside.csv")) {
    SCOPED_TRACE(row.where());
    // The printed speed is rounded; the law that made it gives it in full.
    const double angle = radians(36.78);
    const double d = row.number("d_m");
    const double u = row.number("u_mps");
    const double v_kick = moving_kick_exact({d, row.number("z_target_m") - 0.11}, angle, u).value();
    EXPECT_NEAR(v_kick, row.number("vk_mps"), 1e-6);
    const KickAtLine kick{v_kick, angle, u, d};
    const KickSpread spread{row.number("sigma_v_rel"), radians(row.number("sigma_theta_deg")),
                            row.number("sigma_u_mps"), row.number("sigma_y_m")};
    const HeightSensitivity height = height_sensitivity(kick);
    EXPECT_NEAR(height.z_m, row.number("z_mean"), 1e-6);
    EXPECT_NEAR(height.dz_dv_s, row.number("dz_dV"), 1e-6);
    EXPECT_NEAR(height.dz_dtheta_m_per_rad, row.number("dz_dtheta"), 1e-6);
    EXPECT_NEAR(height.dz_du_s, row.number("dz_du"), 1e-6);
    const InsideProbability p = p_inside(kick, spread, row.number("y_mean_m"), {});
    EXPECT_NEAR(p.sd_z_m, row.number("sigma_z"), 1e-6);
    EXPECT_NEAR(p.p_below_bar, row.number("p_z"), 1e-6);
    EXPECT_NEAR(p.p_between_posts, row.number("p_y"), 1e-6);
    EXPECT_NEAR(p.p_inside, row.number("p_inside"), 1e-6);
    EXPECT_NEAR(p.p_inside, row.number("mc"), 0.013);
  }
}

TEST(PInside, SensitivitiesAreTheDerivatives) {
  const KickAtLine kick{8.0, radians(36.78), 1.0, 6.0};
  const HeightSensitivity height = height_sensitivity(kick);
  const auto slope = [&](double KickAtLine::*member) {
    KickAtLine more = kick;
    KickAtLine less = kick;
    more.*member += 1e-6;
    less.*member -= 1e-6;
    return (height_sensitivity(more).z_m - height_sensitivity(less).z_m) / 2e-6;
  };
  EXPECT_NEAR(height.dz_dv_s, slope(&KickAtLine::v_kick_mps), 1e-7);
  EXPECT_NEAR(height.dz_dtheta_m_per_rad, slope(&KickAtLine::exit_angle_rad), 1e-7);
  EXPECT_NEAR(height.dz_du_s, slope(&KickAtLine::u_mps), 1e-7);
}

TEST(PInside, WithoutSpreadIsYesOrNo) {
  const KickAtLine low{7.5, radians(36.78), 0.0, 5.73};
  EXPECT_EQ(p_inside(low, {}, 0.5, {}).p_inside, 1.0);
  EXPECT_EQ(p_inside(low, {}, 0.95, {}).p_inside, 0.0);
  EXPECT_EQ(p_inside({9.5, radians(36.78), 0.0, 5.73}, {}, 0.0, {}).p_inside, 0.0);
}

}  // namespace
}  // namespace trivela::kicking
