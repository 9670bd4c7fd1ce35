#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/ballistics/flight.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/lob/fit/effective_fit.hpp"
#include "kicking/lob/fit/true_fit.hpp"
#include "kicking/random/draws.hpp"
#include "tests/kicking/reference_laws.hpp"

namespace trivela::kicking::lob {
namespace {

constexpr double kLaunch_z_m = 0.11;

/// Centres of a flight launched at (0, kLaunch_z_m), t = 0, every `period_s` from first_s until it is down again.
std::vector<BallCentre> flight(double speed, double angle_rad, double drag_coefficient, double period_s = 0.025,
                               double first_s = 0.01, double lift_coefficient = 0.0) {
  std::vector<double> times;
  for (double t = first_s; t < 2.5; t += period_s) times.push_back(t);
  std::vector<Eigen::Vector4d> states;
  fly_at_times({0.0, kLaunch_z_m, speed * std::cos(angle_rad), speed * std::sin(angle_rad)},
               drag_per_m({}, {.drag_coefficient = drag_coefficient}), times, states,
               drag_per_m({}, {.drag_coefficient = 1.0}) * lift_coefficient);
  std::vector<BallCentre> centres;
  for (std::size_t i = 0; i < times.size() && states[i][1] > kLaunch_z_m; ++i)
    centres.push_back({nanoseconds(times[i]), states[i][0], states[i][1], 10, 1.0});
  return centres;
}

void add_noise(std::vector<BallCentre>& centres, double sd_m, std::uint32_t trial) {
  const kicking::Draws draws{5, trial};
  for (std::uint32_t i = 0; i < centres.size(); ++i) {
    const auto noise = draws.normals(kicking::Role::kLaserNoise, i);
    centres[i].x_m += sd_m * noise[0];
    centres[i].z_m += sd_m * noise[1];
  }
}

TEST(DragPath, AgreesWithTheIntegrationOfTheBallistics) {
  for (const double cd : {0.0, 0.25, 0.5}) {
    const double k = drag_per_m({}, {.drag_coefficient = cd});
    const DragFlight expected = fly_with_drag(8.39, radians(36.78), k);
    std::vector<Eigen::Vector4d> states;
    const std::vector<double> times{0.3, expected.t_flight_s};
    fly_at_times({0.0, 0.0, 8.39 * std::cos(radians(36.78)), 8.39 * std::sin(radians(36.78))}, k, times, states);
    EXPECT_NEAR(states[1][0], expected.range_m, 1e-6);
    EXPECT_NEAR(states[1][1], 0.0, 1e-6);
  }
}

TEST(DragPath, GoesBackInTime) {
  std::vector<Eigen::Vector4d> there, back;
  const Eigen::Vector4d start(1.0, 0.5, 6.0, 4.0);
  fly_at_times(start, 0.013, std::vector{-0.3, -0.1, 0.2}, there);
  fly_at_times(there[0], 0.013, std::vector{0.3}, back);
  EXPECT_LT((back[0] - start).norm(), 1e-6);
}

TEST(Parabola, RecoversApexRangeAngleAndSpeedOfADragFreeFlight) {
  for (const double speed : {4.0, 6.0, 8.0, 11.0}) {
    for (const double angle_deg : {20.0, 36.78, 50.0, 65.0}) {
      const auto fit = fit_parabola(flight(speed, radians(angle_deg), 0.0), kLaunch_z_m);
      ASSERT_TRUE(fit);
      const EffectiveFit& values = fit->values;
      EXPECT_NEAR(degrees(values.exit_angle_rad.value), angle_deg, 1e-4);
      EXPECT_NEAR(values.exit_speed_mps.value, speed, 1e-5);
      EXPECT_NEAR(fit->launch_x_m, 0.0, 1e-5);
      const LobExit exit = exit_from_lob(values.height_m.value, values.distance_m.value);
      EXPECT_NEAR(exit.angle_rad, values.exit_angle_rad.value, 1e-9) << "the paper's formula";
      EXPECT_NEAR(exit.speed_mps, values.exit_speed_mps.value, 1e-9);
    }
  }
}

TEST(Parabola, OfAFlightWithDragHasItsHeightAndDistance) {
  const DragFlight truth = fly_with_drag(8.39, radians(36.78), drag_per_m({}, {}));
  const auto fit = fit_parabola(flight(8.39, radians(36.78), 0.25), kLaunch_z_m);
  EXPECT_NEAR(fit->values.height_m.value, truth.apex_m, 0.005);
  EXPECT_NEAR(fit->values.distance_m.value, truth.range_m, 0.02);
}

TEST(Parabola, IsNoneWithoutAnArchOverTheLaunch) {
  std::vector<BallCentre> line, bowl, low;
  for (int i = 0; i < 10; ++i) {
    const double x = 0.1 * i;
    line.push_back({i, x, 0.5 + 0.3 * x, 5, 1.0});
    bowl.push_back({i, x, 0.5 + x * x, 5, 1.0});
    low.push_back({i, x, 0.1 - (x - 0.5) * (x - 0.5), 5, 1.0});
  }
  EXPECT_FALSE(fit_parabola(bowl, kLaunch_z_m));
  EXPECT_FALSE(fit_parabola(low, kLaunch_z_m));
  EXPECT_FALSE(fit_parabola(std::span(bowl).first(3), kLaunch_z_m));
  EXPECT_FALSE(fit_flight(flight(8.0, radians(40), 0.25), 5.0, {})) << "never that high";
}

TEST(TrueFit, RecoversExitAndDragOverASweep) {
  for (const double speed : {5.0, 7.0, 9.0, 11.0}) {
    for (const double angle_deg : {25.0, 36.78, 50.0, 65.0}) {
      for (const double cd : {0.0, 0.15, 0.25, 0.47}) {
        SCOPED_TRACE(testing::Message() << speed << " m/s, " << angle_deg << " deg, Cd " << cd);
        const auto fit = fit_flight(flight(speed, radians(angle_deg), cd), kLaunch_z_m, {});
        ASSERT_TRUE(fit);
        const TrueFit values = fit->values();
        EXPECT_NEAR(values.exit_speed_mps.value, speed, 1e-5);
        EXPECT_NEAR(degrees(values.exit_angle_rad.value), angle_deg, 1e-4);
        EXPECT_NEAR(values.drag_coefficient.value, cd, 1e-5);
        EXPECT_NEAR(fit->launch_x_m(), 0.0, 1e-5);
        EXPECT_NEAR(static_cast<double>(values.launch_t_ns), 0.0, 1e4);
      }
    }
  }
}

TEST(TrueFit, NeedsNoLaunchInSight) {
  auto centres = flight(8.39, radians(36.78), 0.25);
  centres.erase(centres.begin(), centres.begin() + 10);
  const TrueFit values = fit_flight(centres, kLaunch_z_m, {})->values();
  EXPECT_NEAR(values.exit_speed_mps.value, 8.39, 1e-5);
  EXPECT_NEAR(static_cast<double>(values.launch_t_ns), 0.0, 1e4);
}

TEST(TrueFit, ShrugsOffOutliers) {
  auto centres = flight(8.39, radians(36.78), 0.25);
  add_noise(centres, 0.003, 1);
  const TrueFit clean = fit_flight(centres, kLaunch_z_m, {})->values();
  centres[5].z_m += 0.09;
  centres[20].x_m -= 0.08;
  centres[33].z_m -= 0.07;
  const TrueFit dirty = fit_flight(centres, kLaunch_z_m, {})->values();
  EXPECT_NEAR(dirty.exit_speed_mps.value, clean.exit_speed_mps.value, 0.01);
  EXPECT_NEAR(degrees(dirty.exit_angle_rad.value), degrees(clean.exit_angle_rad.value), 0.05);
}

/// Standard errors are honest if (estimate - truth) / se has mean 0 and spread 1 over many trials.
template <typename Estimator>
void expect_honest(int trials, double cd, const std::vector<double>& truth, const Estimator& estimator) {
  std::vector<double> sum(truth.size()), squares(truth.size());
  for (std::uint32_t trial = 0; std::cmp_less(trial, trials); ++trial) {
    auto centres = flight(8.39, radians(36.78), cd);
    add_noise(centres, 0.003, trial);
    const std::vector<Estimate> estimates = estimator(centres);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const double z = (estimates[i].value - truth[i]) / estimates[i].se;
      sum[i] += z;
      squares[i] += z * z;
    }
  }
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double mean = sum[i] / trials;
    EXPECT_NEAR(mean, 0.0, 0.2) << i;
    EXPECT_NEAR(std::sqrt(squares[i] / trials - mean * mean), 1.0, 0.12) << i;
  }
}

TEST(TrueFit, StandardErrorsAreThoseOfRepetition) {
  expect_honest(400, 0.25, {8.39, radians(36.78), 0.25}, [](const auto& centres) {
    const TrueFit fit = fit_flight(centres, kLaunch_z_m, {})->values();
    return std::vector{fit.exit_speed_mps, fit.exit_angle_rad, fit.drag_coefficient};
  });
}

TEST(EffectiveValues, OfOneMeanAnglePutTheBallNearItsTarget) {
  // Effective values by section 1 of the ballistics from true lobs; the exact law then asks the table for a speed.
  const double angle = radians(36.78), k = drag_per_m({}, {}), above_m = 0.59;
  std::vector<double> true_mps, effective_mps;
  double mean = 0.0;
  int lobs = 0;
  for (double speed = 5.0; speed <= 13.0; speed += 0.5) {
    const DragFlight lob = fly_with_drag(speed, angle, k);
    const LobExit exit = exit_from_lob(lob.apex_m, lob.range_m);
    true_mps.push_back(speed);
    effective_mps.push_back(exit.speed_mps);
    if (speed < 6.0 || speed > 10.0) continue;
    mean += exit.angle_rad;
    ++lobs;
  }
  mean /= lobs;
  for (double distance_m = 3.0; distance_m <= 10.0; distance_m += 1.0) {
    const double wanted =
        distance_m / std::cos(mean) * std::sqrt(kGravity_mps2 / 2.0 / (distance_m * std::tan(mean) - above_m));
    std::size_t i = 1;
    while (effective_mps[i] < wanted) ++i;
    const double part = (wanted - effective_mps[i - 1]) / (effective_mps[i] - effective_mps[i - 1]);
    const double speed = std::lerp(true_mps[i - 1], true_mps[i], part);
    std::vector<double> times;
    for (double t = 0.0; t < 3.0; t += 1e-3) times.push_back(t);
    std::vector<Eigen::Vector4d> states;
    fly_at_times({0.0, 0.0, speed * std::cos(angle), speed * std::sin(angle)}, k, times, states);
    const auto there = std::find_if(states.begin(), states.end(), [&](const auto& s) { return s[0] >= distance_m; });
    ASSERT_NE(there, states.end());
    EXPECT_NEAR((*there)[1], above_m, distance_m < 8.5 ? 0.05 : 0.09) << distance_m;
  }
}

/// A flight with Magnus lift; the scanner's noise is 3 mm.
std::vector<BallCentre> lifted(double lift_coefficient, std::uint32_t trial) {
  auto centres = flight(8.39, radians(36.78), 0.25, 0.025, 0.01, lift_coefficient);
  add_noise(centres, 0.003, trial);
  return centres;
}

TEST(TrueFit, OfALiftedFlightSaysSoAndIsWideEnough) {
  for (const double lift : {-0.2, -0.1, 0.1, 0.2}) {
    int misfits = 0, held = 0;
    for (std::uint32_t trial = 0; trial < 50; ++trial) {
      const TrueFit fit = fit_flight(lifted(lift, trial), kLaunch_z_m, {})->values();
      misfits += fit.misfits() ? 1 : 0;
      held += std::abs(fit.exit_angle_rad.value - radians(36.78)) <= 2.0 * fit.exit_angle_rad.se ? 1 : 0;
      EXPECT_NEAR(fit.lift_coefficient, lift, 0.07) << lift;
    }
    EXPECT_EQ(misfits, 50) << lift;
    EXPECT_EQ(held, 50) << "C_L " << lift << ": the angle within two standard errors";
  }
}

TEST(TrueFit, OfAFlightWithoutLiftRarelyMisfits) {
  int misfits = 0;
  for (std::uint32_t trial = 0; trial < 300; ++trial)
    misfits += fit_flight(lifted(0.0, trial), kLaunch_z_m, {})->values().misfits() ? 1 : 0;
  EXPECT_LE(misfits, 4);
}

TEST(Parabola, OfALiftedFlightGoesWhereTheBallGoes) {
  // What the policies use of a lob: where its parabola is on the way down. It holds lift as it holds drag.
  for (const double lift : {-0.2, 0.0, 0.2}) {
    const auto centres = flight(8.39, radians(36.78), 0.25, 0.025, 0.01, lift);
    const EffectiveFit fit = fit_parabola(centres, kLaunch_z_m)->values;
    const double s = std::tan(fit.exit_angle_rad.value), d = fit.distance_m.value;
    for (const BallCentre& centre : centres) {
      if (centre.x_m < 0.5 * d) continue;
      EXPECT_NEAR(kLaunch_z_m + s * centre.x_m * (1.0 - centre.x_m / d), centre.z_m, 0.06) << lift;
    }
  }
}

TEST(Parabola, StandardErrorsAreThoseOfRepetition) {
  const double speed = 8.39, angle = radians(36.78), height = std::pow(speed * std::sin(angle), 2) / 2 / kGravity_mps2;
  expect_honest(4000, 0.0, {speed, angle, height, 4.0 * height / std::tan(angle)}, [](const auto& centres) {
    const EffectiveFit fit = fit_parabola(centres, kLaunch_z_m)->values;
    return std::vector{fit.exit_speed_mps, fit.exit_angle_rad, fit.height_m, fit.distance_m};
  });
}

}  // namespace
}  // namespace trivela::kicking::lob
