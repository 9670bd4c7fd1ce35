#include "kicking/alignment/alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "kicking/model/robot_model.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::kicking {
namespace {

/// Least-squares slope through the origin of y over x: sum(x y) / sum(x x).
double slope_through_origin(const std::vector<std::pair<double, double>>& points) {
  double xy = 0.0;
  double xx = 0.0;
  for (const auto& [x, y] : points) {
    xy += x * y;
    xx += x * x;
  }
  return xy / xx;
}

TEST(Alpha, LineOfTable1ComesFromItsRows) {
  std::vector<std::pair<double, double>> alphas;
  std::vector<std::pair<double, double>> displacements;  // b = (v / d) T d: tan(alpha) over vx / d
  for (const auto& row : tests::rows("alpha_table1.csv")) {
    SCOPED_TRACE(row.where());
    const double v = row.number("vx_mps");
    const double d = row.number("d_m");
    const double alpha = std::atan(row.number("b_m") / d);
    EXPECT_NEAR(degrees(alpha), row.number("alpha_deg"), 1e-6);
    EXPECT_NEAR(degrees(alpha_atan_rad(v, d, row.number("b_over_vx_s"))), row.number("alpha_deg"), 1e-6);
    alphas.emplace_back(v, alpha);
    displacements.emplace_back(v, row.number("b_m"));
  }
  EXPECT_NEAR(slope_through_origin(alphas), RobotModel{}.alpha_slope_rad_per_mps, 1e-8);
  EXPECT_NEAR(slope_through_origin(displacements), 0.923809524, 1e-9);
}

TEST(Alpha, LinesResidualsAreThoseOfTable1) {
  const double slope = RobotModel{}.alpha_slope_rad_per_mps;
  const double residuals_deg[] = {0.45482, 0.844678, -0.536044};
  int i = 0;
  for (const auto& row : tests::rows("alpha_table1.csv")) {
    EXPECT_NEAR(row.number("alpha_deg") - degrees(alpha_paper_rad(row.number("vx_mps"), slope)), residuals_deg[i++],
                2e-6);
  }
}

TEST(Alpha, PhysicalModelAgreesWithTheVectors) {
  for (const auto& row : tests::rows("alpha_model.csv")) {
    const double k = row.number("k");
    const double alpha =
        alpha_physical_rad(row.number("vk_mps"), radians(row.number("theta_deg")), {k, k, k},
                           {row.number("vx_mps"), row.number("vy_mps"), row.number("omega_rad_s")}, row.number("r_m"));
    EXPECT_NEAR(degrees(alpha), row.number("alpha_deg_right_positive"), 1e-6) << row.where();
  }
}

TEST(Alpha, IsOddInTheLateralVelocity) {
  for (const double vx : {0.0, 0.5, 2.0}) {
    EXPECT_DOUBLE_EQ(alpha_paper_rad(-vx, 0.15), -alpha_paper_rad(vx, 0.15));
    EXPECT_DOUBLE_EQ(alpha_physical_rad(8, 0.6, {}, {-vx, 1, -2}, 0.27),
                     -alpha_physical_rad(8, 0.6, {}, {vx, 1, 2}, 0.27));
  }
}

TEST(Beta, PhysicalModelAgreesWithTheVectors) {
  for (const auto& row : tests::rows("beta_model.csv")) {
    SCOPED_TRACE(row.where());
    const double beta = beta_physical_rad(radians(row.number("omega_deg_s")), row.number("tau_s"), row.number("r_m"),
                                          row.number("Vh_mps"));
    EXPECT_NEAR(degrees(beta), row.number("beta_deg"), 1e-6);
    EXPECT_NEAR(8.0 * std::tan(beta), row.number("b_at_8m"), 1e-6);
  }
}

TEST(Beta, SuggestedSlopeLiesBetweenTheDelaysOfTheModel) {
  const double slope = RobotModel{}.beta_slope_s;
  for (const double omega : {-2.0, 0.0, 0.5, 2.5}) {
    const double paper = std::abs(beta_paper_rad(omega, slope));
    EXPECT_GE(paper, std::abs(beta_physical_rad(omega, 0.05, 0.27, 7.54)));
    EXPECT_LE(paper, std::abs(beta_physical_rad(omega, 0.14, 0.27, 7.54)));
  }
}

}  // namespace
}  // namespace trivela::kicking
