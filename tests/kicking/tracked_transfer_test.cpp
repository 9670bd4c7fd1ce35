#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "kicking/fit/tracked_fits.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::kicking {
namespace {

constexpr double kC = 1.38;
constexpr double kV0_mps = 8.2;
const double kTheta = radians(36.78);

/// A kick over ground: along = c up + k v. The robot believes `believed_mps` of its v.
TransferRow kicked(double v_mps, double believed_mps, double up_mps, double k, double noise_mps = 0.0) {
  return {.vy_mps = believed_mps,
          .v0_mps = kV0_mps,
          .exit_angle_rad = kTheta,
          .distance_m = 5.73,
          .track = TrackedLaunch{.along_mps = kC * up_mps + k * v_mps + noise_mps, .up_mps = up_mps}};
}

TEST(TrackedTransfer, FindsTheConstantsInTheSpeedsOfTheDragFreeLaw) {
  std::vector<TransferRow> rows;
  for (const double up : {4.9, 5.1, 5.0}) {
    rows.push_back(kicked(0.0, 0.0, up, 0.0));
    rows.push_back(kicked(1.5, 1.5, up, 1.0));
    rows.push_back(kicked(-0.75, -0.75, up, 0.6));
  }
  const TransferFit fit = fit_transfer(rows, 0.06);
  const double effective = kV0_mps * std::cos(kTheta) / (kC * 5.0);
  EXPECT_NEAR(fit.standing_ratio->value, effective, 1e-9);
  EXPECT_NEAR(fit.forward->exact.value, effective, 1e-9);
  EXPECT_NEAR(fit.backward->exact.value, 0.6 * effective, 1e-9);
  EXPECT_EQ(fit.forward->kicks, 3);
  EXPECT_NEAR(fit.forward->rms, 0.0, 1e-9);
}

// 400 calibrations of 24 kicks: unbiased although the robot's belief of its speed has an error of 0.1 m/s, and the
// standard error covers.
TEST(TrackedTransfer, CoversWithErrorsInWhatTheRobotBelieves) {
  std::mt19937_64 random{7};
  std::normal_distribution<double> normal;
  const double effective = kV0_mps * std::cos(kTheta) / (kC * 5.0);
  int covered = 0;
  double sum = 0.0;
  constexpr int kCalibrations = 400;
  for (int i = 0; i < kCalibrations; ++i) {
    std::vector<TransferRow> rows;
    for (const double v : {0.0, 0.0, 0.5, 1.0}) {
      for (int kick = 0; kick < 12; ++kick) {
        const double up = 5.0 * (1.0 + 0.02 * normal(random));
        const double belief = v == 0.0 ? 0.0 : v + 0.05 * normal(random);
        rows.push_back(kicked(v, belief, up, 1.0, 0.05 * normal(random)));
      }
    }
    const TransferFit fit = fit_transfer(rows, 0.06);
    sum += fit.forward->exact.value;
    covered += std::abs(fit.forward->exact.value - effective) < 1.96 * fit.forward->exact.se ? 1 : 0;
  }
  EXPECT_NEAR(sum / kCalibrations, effective, 0.004) << "three standard errors of the mean";
  EXPECT_GE(covered, 0.92 * kCalibrations);
  EXPECT_LE(covered, 0.99 * kCalibrations);
}

TEST(TrackedTransfer, NeedsKicksAtRest) {
  const std::vector<TransferRow> rows{kicked(1.0, 1.0, 5.0, 1.0), kicked(1.0, 1.0, 5.1, 1.0)};
  EXPECT_THAT([&] { fit_transfer(rows, 0.06); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("at rest")));
}

TEST(TrackedTrials, GiveKicksThatTheLaserLostTheSpeedOfTheOthers) {
  const auto speed = [](double up) { return up * (1.7 - 0.001 * up * up); };
  std::vector<TrackedTrial> kicks;
  double sideways = 0.0;
  for (const double up : {3.5, 4.0, 5.0, 6.0, 6.5}) {
    sideways = 0.02 - sideways;  // of a ball beside its plane the laser reads too much
    const double beside = sideways * sideways;
    kicks.push_back({.power = up,
                     .up_mps = up,
                     .sideways_rad = sideways,
                     .lob = Trial{up, 0.64 + 3.0 * beside, speed(up) + 5.0 * up * beside}});
    kicks.push_back({.power = up, .up_mps = 1.01 * up, .sideways_rad = 0.05});
  }
  const TrackedTrials tracked = tracked_trials(kicks);
  EXPECT_NEAR(tracked.exit_angle_rad.value, 0.64, 1e-9);
  ASSERT_EQ(tracked.trials.size(), 10u);
  for (std::size_t i = 0; i < tracked.trials.size(); ++i) {
    EXPECT_NEAR(tracked.trials[i].exit_speed_mps, speed(kicks[i].up_mps), 1e-9);
    EXPECT_EQ(std::isnan(tracked.trials[i].exit_angle_rad), i % 2 == 1);
  }
  const TableFit fit = fit_table(tracked.trials);
  EXPECT_EQ(fit.exit_angles, 5u);
  EXPECT_NEAR(fit.exit_angle_rad.value, 0.64, 1e-9);
  EXPECT_TRUE(std::isnan(fit.exit_angle_sd_rad)) << "one angle a set-point";
  EXPECT_GT(fit.exit_speed_sd_ratio, 0.0);
}

}  // namespace
}  // namespace trivela::kicking
