#include "kicking/alignment/alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/vector_rows.hpp"

namespace trivela::kicking {
namespace {

Alignment align_row(const tests::VectorRow& row) {
  AlignmentRule rule;
  rule.extension = row.text("rule") == "add" ? Extension::kAdd : Extension::kMax;
  return align({row.number("px"), row.number("py"), radians(row.number("orientation_deg"))},
               radians(row.number("alpha_deg")), radians(row.number("beta_deg")), row.number("omega_rad_s"),
               {row.number("tx"), row.number("ty")}, rule);
}

/// The other route: do the segments a + s (b - a) and c + t (e - c) meet? Cramer's rule.
bool segments_meet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                   const Eigen::Vector2d& e) {
  const Eigen::Vector2d ab = b - a;
  const Eigen::Vector2d ce = e - c;
  const Eigen::Vector2d ac = c - a;
  const double determinant = ab.x() * -ce.y() + ce.x() * ab.y();
  if (determinant == 0.0) return false;
  const double s = (ac.x() * -ce.y() + ce.x() * ac.y()) / determinant;
  const double t = (ab.x() * ac.y() - ac.x() * ab.y()) / determinant;
  return s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0;
}

TEST(Alignment, AgreesWithTheVectors) {
  for (const auto& row : tests::rows("alignment.csv")) {
    SCOPED_TRACE(row.text("name"));
    const Alignment alignment = align_row(row);
    EXPECT_EQ(alignment.aligned, row.flag("aligned"));
    EXPECT_NEAR(alignment.centre_distance_m, row.number("distance"), 1e-6);
    EXPECT_NEAR(alignment.left_m, row.number("left_len"), 1e-6);
    EXPECT_NEAR(alignment.right_m, row.number("right_len"), 1e-6);
    if (row.has("offset_right_m")) {
      ASSERT_TRUE(alignment.offset_right_m);
      EXPECT_NEAR(*alignment.offset_right_m, row.number("offset_right_m"), 1e-6);
    } else {
      EXPECT_FALSE(alignment.offset_right_m);
    }
  }
}

TEST(Alignment, ClosedFormAndSegmentIntersectionAgree) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-6, 6);
  std::uniform_real_distribution<double> unit(-1, 1);
  int aligned = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector2d target(unit(random), 9.0);
    Pose robot{place(random), place(random), 0.0};
    const double alpha = 0.3 * unit(random);
    robot.heading_rad = bearing({robot.x_m, robot.y_m}, target) + alpha + (i % 4 ? 0.2 : 4.0) * unit(random);
    const double omega = 2.5 * unit(random);
    const AlignmentRule rule{.extension = i % 2 ? Extension::kMax : Extension::kAdd};
    const Alignment result = align(robot, alpha, 0.12 * omega, omega, target, rule);

    const Eigen::Vector2d start(robot.x_m, robot.y_m);
    const Eigen::Vector2d t = (target - start).normalized();
    const Eigen::Vector2d n(t.y(), -t.x());
    EXPECT_EQ(result.aligned, segments_meet(start, start + rule.reach_m * direction(robot.heading_rad - alpha),
                                            target - result.left_m * n, target + result.right_m * n));
    aligned += result.aligned;
  }
  EXPECT_GT(aligned, 300);
}

TEST(Alignment, MirrorsLeftAndRight) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const double x = 5 * any(random);
    const double heading = any(random);
    const double alpha = any(random);
    const double omega = 2 * any(random);
    const Alignment a = align({x, 2, heading}, alpha, 0.2, omega, {0.5, 9});
    const Alignment b = align({-x, 2, -heading}, -alpha, 0.2, -omega, {-0.5, 9});
    EXPECT_EQ(a.aligned, b.aligned);
    EXPECT_DOUBLE_EQ(a.left_m, b.right_m);
    EXPECT_DOUBLE_EQ(a.right_m, b.left_m);
    ASSERT_EQ(a.offset_right_m.has_value(), b.offset_right_m.has_value());
    if (a.offset_right_m) {
      EXPECT_NEAR(*a.offset_right_m, -*b.offset_right_m, 1e-6 * (1 + std::abs(*a.offset_right_m)));
    }
  }
}

TEST(Alignment, SignOfBetaDoesNotMatterAndItsExtensionIsBounded) {
  const Alignment plus = align({0, 3, 0}, 0, radians(20), 1, {0, 9});
  EXPECT_EQ(align({0, 3, 0}, 0, -radians(20), 1, {0, 9}).right_m, plus.right_m);
  for (const double beta_deg : {60.0, 89.999, 90.0, 120.0, 500.0}) {
    EXPECT_NEAR(align({0, 3, 0}, 0, radians(beta_deg), 1, {0, 9}).right_m, 6 * std::tan(radians(60)), 1e-9);
  }
}

TEST(Alignment, EndsOfTheSegmentBelongToIt) {
  EXPECT_TRUE(align({0, 3, -std::atan2(0.10, 6)}, 0, 0, 0, {0, 9}).aligned);
  EXPECT_TRUE(align({0, 3, std::atan2(0.10, 6)}, 0, 0, 0, {0, 9}).aligned);
  EXPECT_FALSE(align({0, 3, std::atan2(0.10001, 6)}, 0, 0, 0, {0, 9}).aligned);
}

TEST(Alignment, IsFalseBehindOnTheTargetAndBeyondReach) {
  const Alignment behind = align({0, 3, std::numbers::pi}, 0, 0, 0, {0, 9});
  EXPECT_FALSE(behind.aligned);
  EXPECT_FALSE(behind.offset_right_m);
  EXPECT_FALSE(align({0, 9, 0}, 0, 0, 0, {0, 9}).aligned);
  EXPECT_FALSE(align({0, -22, 0}, 0, 0, 0, {0, 9}).aligned);
  EXPECT_TRUE(align({0, -20, 0}, 0, 0, 0, {0, 9}).aligned);
}

TEST(Alignment, IsFalseForWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(align({nan, 3, 0}, 0, 0, 0, {0, 9}).aligned);
  EXPECT_FALSE(align({0, 3, nan}, 0, 0, 0, {0, 9}).aligned);
  EXPECT_FALSE(align({0, 3, 0}, nan, 0, 0, {0, 9}).aligned);
  EXPECT_FALSE(align({0, 3, 0.5}, 0, nan, 1, {0, 9}).aligned);
}

}  // namespace
}  // namespace trivela::kicking
