#include "kicking/fit/deflection_fit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "kicking/geometry/angle.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::kicking {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<DeflectionRow> table1() {
  std::vector<DeflectionRow> rows;
  for (const auto& row : tests::rows("alpha_table1.csv")) {
    rows.push_back({.vx_mps = row.number("vx_mps"), .distance_m = row.number("d_m"), .b_m = row.number("b_m")});
  }
  return rows;
}

TEST(DeflectionFit, OfTable1IsThePapersLine) {
  const DeflectionFit fit = fit_deflection(table1());
  EXPECT_NEAR(degrees(fit.line.slope.value), 8.617644099, 1e-9);
  const double residuals_deg[] = {0.45482, 0.844678, -0.536044};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(degrees(fit.line.residuals[i]), residuals_deg[i], 1e-6);
  EXPECT_NEAR(degrees(fit.line.rms), 0.634, 5e-4);
  // s^2 = 3 rms^2 / 2 over sum(vx^2) = 5.25.
  EXPECT_NEAR(degrees(fit.line.slope.se), 0.634 * std::sqrt(1.5 / 5.25), 5e-4);
}

TEST(DeflectionFit, OfTable1HasThePhysicalTravelTime) {
  const DeflectionFit fit = fit_deflection(table1());
  EXPECT_NEAR(fit.travel.slope.value, 0.923809524, 1e-9);
  const double residuals_deg[] = {0.361459, 0.709326, -0.416265};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(degrees(fit.travel_residual_rad[i]), residuals_deg[i], 1e-6);
  EXPECT_NEAR(degrees(fit.travel_rms_rad), 0.519, 5e-4);
  EXPECT_FALSE(fit.lateral);
}

TEST(DeflectionFit, OfTable1ExplainsItByFullTransferAndTheDelayOfTheCode) {
  std::vector<DeflectionRow> rows = table1();
  for (DeflectionRow& row : rows) row.v_h_mps = 6.613;  // kicker.map at 6 m and 0.70 m
  const DeflectionFit fit = fit_deflection(rows, 0.08);
  EXPECT_NEAR(fit.lateral->slope.value, 0.93, 0.01);
}

TEST(DeflectionFit, FindsTheTransferThatMadeTheKicks) {
  for (const double k_x : {0.0, 0.5, 0.8, 1.0, 1.2}) {
    for (const double delay_s : {0.0, 0.06, 0.14}) {
      std::vector<DeflectionRow> rows;
      for (const double vx : {-2.0, -1.0, -0.5, 0.5, 1.0, 2.0}) {
        for (const double d : {3.0, 6.0, 10.0}) {
          const double v_h = 6.0 + 0.1 * d;
          rows.push_back({vx, d, k_x * vx * d / v_h + vx * delay_s, 0.27, v_h});
        }
      }
      const DeflectionFit fit = fit_deflection(rows, delay_s);
      EXPECT_NEAR(fit.lateral->slope.value, k_x, 1e-12);
      EXPECT_NEAR(fit.lateral->rms, 0.0, 1e-12);
      EXPECT_NEAR(fit.lateral->slope.se, 0.0, 1e-12);
    }
  }
}

TEST(DeflectionFit, SeesAlphaFromTheRobotsCentre) {
  const DeflectionFit fit = fit_deflection(std::vector<DeflectionRow>{{1, 5, 0.5, 0.3, {}}, {2, 5, 1, 0.3, {}}});
  EXPECT_NEAR(fit.alpha_rad[0], std::atan(0.5 / 5.3), 1e-15);
}

TEST(DeflectionFit, RefusesWhatSaysNothing) {
  const auto fit = [](std::vector<DeflectionRow> rows) { return [rows] { fit_deflection(rows); }; };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(fit({}), ThrowsMessage<std::invalid_argument>("deflection: 0 rows, need at least 2"));
  EXPECT_THAT(fit({{1, 6, 1}}), ThrowsMessage<std::invalid_argument>("deflection: 1 row, need at least 2"));
  EXPECT_THAT(fit({{0, 6, 1}, {0, 6, 1}}), ThrowsMessage<std::invalid_argument>(HasSubstr("all speeds are 0")));
  EXPECT_THAT(fit({{1, 6, 1}, {1, 0, 1}}), ThrowsMessage<std::invalid_argument>(HasSubstr("row 2: distance")));
  EXPECT_THAT(fit({{1, 6, nan}, {1, 6, 1}}), ThrowsMessage<std::invalid_argument>(HasSubstr("row 1 has a value")));
  EXPECT_THAT(fit({{nan, 6, 1}, {1, 6, 1}}), ThrowsMessage<std::invalid_argument>(HasSubstr("not finite")));
}

}  // namespace
}  // namespace trivela::kicking
