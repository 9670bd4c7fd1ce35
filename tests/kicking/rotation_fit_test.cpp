#include "kicking/fit/deflection_fit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "kicking/geometry/angle.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::kicking {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(RotationFit, FindsTheDelaysOfTheVectors) {
  std::map<std::pair<double, double>, std::vector<RotationRow>> by_model;  // delay, V_h
  for (const auto& row : tests::rows("beta_model.csv")) {
    by_model[{row.number("tau_s"), row.number("Vh_mps")}].push_back(
        {radians(row.number("omega_deg_s")), row.number("b_at_8m"), 8.0, row.number("Vh_mps")});
  }
  ASSERT_GE(by_model.size(), 3u);
  for (const auto& [model, rows] : by_model) {
    const RotationFit fit = fit_rotation(rows, RotationLever{.ball_offset_m = 0.27});
    EXPECT_NEAR(fit.delay->slope.value, model.first, 1e-6);
    // tau + r / V_h, but for the bend of the atan.
    EXPECT_NEAR(fit.line.slope.value, model.first + 0.27 / model.second, 2e-4);
  }
}

TEST(RotationFit, IsTheSameForBothSensesOfTurning) {
  const std::vector<RotationRow> left{{0.5, 0.4}, {1.0, 1.0}, {2.0, 1.9}};
  std::vector<RotationRow> right = left;
  for (RotationRow& row : right) row.omega_radps = -row.omega_radps;
  EXPECT_DOUBLE_EQ(fit_rotation(right).line.slope.value, fit_rotation(left).line.slope.value);
  EXPECT_DOUBLE_EQ(fit_rotation(right).beta_rad[1], -fit_rotation(left).beta_rad[1]);
}

TEST(RotationFit, TakesTheHalfCycleOffTheDelay) {
  std::vector<RotationRow> rows;
  for (const double omega : {-2.0, -1.0, 1.0, 2.5}) {
    const double beta = std::abs(omega) * (0.07 + 0.01) + std::atan(std::abs(omega) * 0.27 / 7.0);
    rows.push_back({omega, 5.0 * std::tan(beta), 5.0, 7.0});
  }
  const RotationFit fit = fit_rotation(rows, RotationLever{.ball_offset_m = 0.27, .cycle_s = 0.02});
  EXPECT_NEAR(fit.delay->slope.value, 0.07, 1e-12);
  EXPECT_NEAR(fit.delay->rms, 0.0, 1e-12);
  EXPECT_GT(fit.line.slope.value, 0.115);
}

TEST(RotationFit, HasAStandardErrorFromItsResiduals) {
  const RotationFit fit = fit_rotation(
      std::vector<RotationRow>{{1.0, 8.0 * std::tan(0.11), 8.0, {}}, {1.0, 8.0 * std::tan(0.13), 8.0, {}}});
  EXPECT_NEAR(fit.line.slope.value, 0.12, 1e-12);
  EXPECT_NEAR(fit.line.slope.se, 0.01, 1e-12);  // s = sqrt(2) 0.01, sum(omega^2) = 2
}

TEST(RotationFit, HasNoDelayWithoutTheBallsSpeed) {
  EXPECT_FALSE(fit_rotation(std::vector<RotationRow>{{1, 1}, {2, 2}}, RotationLever{}).delay);
}

TEST(RotationFit, RefusesWhatSaysNothing) {
  const auto fit = [](std::vector<RotationRow> rows) { return [rows] { fit_rotation(rows); }; };
  EXPECT_THAT(fit({{1, 1}}), ThrowsMessage<std::invalid_argument>("rotation: 1 row, need at least 2"));
  EXPECT_THAT(fit({{0, 1}, {0, 1}}), ThrowsMessage<std::invalid_argument>(HasSubstr("all speeds are 0")));
  EXPECT_THAT(fit({{1, 1, -8}, {1, 1}}), ThrowsMessage<std::invalid_argument>(HasSubstr("row 1: distance")));
  EXPECT_THAT(fit({{1, 1}, {1, std::numeric_limits<double>::quiet_NaN()}}),
              ThrowsMessage<std::invalid_argument>(HasSubstr("row 2 has a value that is not finite")));
}

}  // namespace
}  // namespace trivela::kicking
