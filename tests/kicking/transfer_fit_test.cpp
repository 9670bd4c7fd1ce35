#include "kicking/fit/transfer_fit.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kicking/alignment/release_predictor.hpp"
#include "kicking/ballistics/moving_kick.hpp"
#include "kicking/geometry/angle.hpp"
#include "tests/kicking/reference_laws.hpp"

namespace trivela::kicking {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const double kAngle = radians(36.78);

/// A kick of the exact law, by the forward predictor and not by the code under test.
TransferRow flown(double v, double v0, double distance_m, const Transfer& transfer, double delay_s) {
  const KickAction kick{v0, kAngle, transfer, delay_s, 0.0};
  const auto crossing = predict_crossing({0.0, 9.0 - distance_m, 0.0}, {0.0, v, 0.0}, kick, 9.0);
  return {v, v0, kAngle, distance_m, crossing->z_m};
}

TEST(TransferFit, FindsBothConstantsOfTheExactLaw) {
  for (const double forward : {0.5, 0.8, 1.0, 1.2}) {
    for (const double backward : {0.3, 0.5, 1.0}) {
      for (const double delay_s : {0.0, 0.06}) {
        std::vector<TransferRow> rows;
        for (const double v : {0.5, 1.0, 2.0, -0.5, -1.0, -1.5}) {
          rows.push_back(flown(v, 8.2, 5.73, {forward, backward, 1.0}, delay_s));
          rows.push_back(flown(v, 7.6, 4.5, {forward, backward, 1.0}, delay_s));
        }
        const TransferFit fit = fit_transfer(rows, delay_s);
        EXPECT_NEAR(fit.forward->exact.value, forward, 1e-6);
        EXPECT_NEAR(fit.backward->exact.value, backward, 1e-6);
        EXPECT_LT(fit.forward->rms, 1e-6);
        EXPECT_EQ(fit.forward->kicks, 6);
        EXPECT_THAT(fit.backward->rows, testing::ElementsAre(6, 7, 8, 9, 10, 11));
      }
    }
  }
}

TEST(TransferFit, FullTransferOfASlowRobotIsThePapersKOfGeometry) {
  std::vector<TransferRow> rows;
  for (const double v : {0.051, 0.06, -0.051, -0.06}) rows.push_back(flown(v, 8.256, 5.73, {}, 0.0));
  const TransferFit fit = fit_transfer(rows, 0.0);
  const double k = k_geometric({5.73, 0.59}, kAngle);
  EXPECT_NEAR(fit.forward->paper.value, k, 0.015);
  EXPECT_NEAR(fit.backward->paper.value, k, 0.015);
}

TEST(TransferFit, HasAStandardErrorThatScattersAsItSays) {
  const double slope_m =
      (flown(1.0, 8.2, 5.73, {1.01, 1, 1}, 0).z_cross_m - flown(1, 8.2, 5.73, {}, 0).z_cross_m) / 0.01;
  std::vector<TransferRow> rows{flown(1.0, 8.2, 5.73, {}, 0.0), flown(1.0, 8.2, 5.73, {}, 0.0)};
  rows[0].z_cross_m += 0.01;
  rows[1].z_cross_m -= 0.01;
  const TransferFit fit = fit_transfer(rows, 0.0);
  EXPECT_NEAR(fit.forward->exact.value, 1.0, 1e-3);
  EXPECT_NEAR(fit.forward->exact.se, 0.01 / std::abs(slope_m), 1e-3);
  EXPECT_NEAR(fit.forward->rms, 0.01, 1e-6);
}

TEST(TransferFit, TakesAnErrorOfTheTableFromTheKicksAtRest) {
  for (const double error : {0.95, 1.0, 1.04}) {
    std::vector<TransferRow> rows;
    for (const double v : {0.0, 1.0, -1.0, 0.0, 0.5, -0.5, 0.01})
      rows.push_back(flown(v, 8.2, 4.0, {0.9, 0.6, 1.0}, 0.06));
    for (TransferRow& row : rows) row.v0_mps *= error;
    const TransferFit fit = fit_transfer(rows, 0.06);
    EXPECT_NEAR(fit.standing_ratio->value, 1.0 / error, 2e-3) << "one of the three creeps forward";
    EXPECT_NEAR(fit.forward->exact.value, 0.9, 0.02);
    EXPECT_NEAR(fit.backward->exact.value, 0.6, 0.02);
    rows.erase(std::remove_if(rows.begin(), rows.end(), [](const auto& row) { return std::abs(row.vy_mps) < 0.05; }),
               rows.end());
    EXPECT_FALSE(fit_transfer(rows, 0.06).standing_ratio);
    const double blind = fit_transfer(rows, 0.06).forward->exact.value - 0.9;
    if (error == 1.0) {
      EXPECT_NEAR(blind, 0.0, 1e-6);
    } else {
      EXPECT_GT(std::abs(blind), 0.3) << "without them it is taken for transfer";
    }
  }
}

TEST(TransferFit, TheReferencesScatterIsInTheStandardErrors) {
  std::vector<TransferRow> rows;
  for (const double v : {0.0, 0.0, 1.0, 1.0, -1.0, -1.0}) rows.push_back(flown(v, 8.2, 4.0, {}, 0.0));
  EXPECT_NEAR(fit_transfer(rows, 0.0).forward->exact.se, 0.0, 1e-6);
  rows[0].v0_mps *= 1.01;
  rows[1].v0_mps *= 0.99;
  const TransferFit fit = fit_transfer(rows, 0.0);
  EXPECT_NEAR(fit.standing_ratio->se, 0.01, 1e-3);
  const double k_per_ratio = [&] {
    std::vector<TransferRow> faster(rows.begin() + 2, rows.end());
    for (TransferRow& row : faster) row.v0_mps *= 1.01;
    return (fit_transfer(faster, 0.0).forward->exact.value - 1.0) / 0.01;
  }();
  EXPECT_NEAR(fit.forward->exact.se, std::abs(k_per_ratio) * 0.01, 0.1 * std::abs(k_per_ratio) * 0.01);
}

TEST(TransferFit, KeepsToTheDirectionsThatWereDriven) {
  const std::vector<TransferRow> rows{flown(1.0, 8.2, 5.73, {}, 0.0), flown(1.5, 8.2, 5.73, {}, 0.0),
                                      flown(-1.0, 8.2, 5.73, {}, 0.0), flown(0.01, 8.2, 5.73, {}, 0.0)};
  const TransferFit fit = fit_transfer(rows, 0.0);
  EXPECT_EQ(fit.forward->kicks, 2);
  EXPECT_FALSE(fit.backward);
}

TEST(TransferFit, ADirectionThatFailsLeavesTheOtherOneStanding) {
  TransferRow near = flown(-1.0, 8.2, 0.5, {}, 0.0);
  near.z_cross_m = 0.5;  // 0.5 m * tan(36.78 degrees) = 0.374 m over the launch: no speed reaches it
  const std::vector<TransferRow> rows{flown(1.0, 8.2, 5.73, {}, 0.0), flown(1.5, 8.2, 5.73, {}, 0.0), near, near};
  const TransferFit fit = fit_transfer(rows, 0.0);
  EXPECT_NEAR(fit.forward->exact.value, 1.0, 1e-6);
  EXPECT_FALSE(fit.backward);
  EXPECT_THAT(fit.failed, testing::ElementsAre(HasSubstr("backward: ")));
}

TEST(TransferFit, RefusesWhatSaysNothing) {
  const auto fit = [](std::vector<TransferRow> rows, double delay_s = 0.0) {
    return [rows, delay_s] { fit_transfer(rows, delay_s); };
  };
  const TransferRow good = flown(1.0, 8.2, 5.73, {}, 0.0);
  const auto with = [&](double TransferRow::*column, double value) {
    TransferRow row = good;
    row.*column = value;
    return std::vector<TransferRow>{good, row};
  };
  EXPECT_THAT(fit({good}), ThrowsMessage<std::invalid_argument>(HasSubstr("need at least 2 kicks forward")));
  EXPECT_THAT(fit(with(&TransferRow::z_cross_m, std::numeric_limits<double>::quiet_NaN())),
              ThrowsMessage<std::invalid_argument>(HasSubstr("row 2: a value is not finite")));
  EXPECT_THAT(fit(with(&TransferRow::v0_mps, 0.0)), ThrowsMessage<std::invalid_argument>(HasSubstr("exit speed")));
  EXPECT_THAT(fit(with(&TransferRow::exit_angle_rad, 1.6)),
              ThrowsMessage<std::invalid_argument>(HasSubstr("between 0 and 90")));
  EXPECT_THAT(fit(with(&TransferRow::distance_m, 0.05), 0.06),
              ThrowsMessage<std::invalid_argument>(HasSubstr("before the goal line")));
  EXPECT_THAT(fit(with(&TransferRow::z_cross_m, 9.0)),
              ThrowsMessage<std::invalid_argument>(HasSubstr("no height depends on k")));
  TransferRow near = flown(1.0, 8.2, 0.5, {}, 0.0);
  near.z_cross_m = 0.5;  // 0.5 m * tan(36.78 degrees) = 0.374 m over the launch
  EXPECT_THAT(fit({near, near}), ThrowsMessage<std::invalid_argument>(HasSubstr("no speed reaches the height")));
}

}  // namespace
}  // namespace trivela::kicking
