#include "nodes/shot_observer/flight_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "kicking/constants.hpp"

namespace trivela::nodes {
namespace {

using Eigen::Vector3d;
using kicking::kGravity_mps2;

const Vector3d kFrom{0.5, 4.0, 0.11};
const Vector3d kVelocity{-0.7, 6.5, 4.8};

Vector3d parabola(double t_s, double gravity_mps2 = kGravity_mps2) {
  return kFrom + kVelocity * t_s - Vector3d{0.0, 0.0, gravity_mps2 * t_s * t_s / 2.0};
}

std::vector<Sighting> sightings(int n, double gravity_mps2 = kGravity_mps2, std::int64_t start_ns = 3'000'000'000) {
  std::vector<Sighting> seen;
  for (int i = 0; i < n; ++i) seen.push_back({start_ns + i * 20'000'000, parabola(i * 0.02, gravity_mps2)});
  return seen;
}

TEST(FlightFit, FindsAFlightWithoutNoiseExactly) {
  for (const double gravity : {kGravity_mps2, 0.0}) {
    for (const int n : {2, 3, 10, 40}) {
      const auto piece = fit_flight(sightings(n, gravity), gravity);
      ASSERT_TRUE(piece);
      EXPECT_LT((piece->velocity_mps - kVelocity).norm(), 1e-9);
      for (const double t_s : {-0.1, 0.0, 0.33, 1.0}) EXPECT_LT((piece->at(t_s) - parabola(t_s, gravity)).norm(), 1e-9);
      const auto t_cross_s = piece->time_at_y_s(9.0);
      ASSERT_TRUE(t_cross_s);
      EXPECT_NEAR(*t_cross_s, 5.0 / 6.5, 1e-9);
    }
  }
}

TEST(FlightFit, NeedsTwoInstants) {
  EXPECT_FALSE(fit_flight({}, kGravity_mps2));
  EXPECT_FALSE(fit_flight(sightings(1), kGravity_mps2));
  const Sighting once = sightings(1)[0];
  EXPECT_FALSE(fit_flight(std::vector<Sighting>{once, once, once}, kGravity_mps2));
}

TEST(FlightFit, ABallThatFliesAwayNeverReachesTheLine) {
  auto seen = sightings(5);
  for (auto& s : seen) s.ball_m.y() = 8.0 - s.ball_m.y();
  EXPECT_FALSE(fit_flight(seen, kGravity_mps2)->time_at_y_s(9.0));
}

TEST(FlightFit, FramesMayBeMissing) {
  auto seen = sightings(12);
  seen.erase(seen.begin() + 3, seen.begin() + 7);
  EXPECT_LT((fit_flight(seen, kGravity_mps2)->at(0.7) - parabola(0.7)).norm(), 1e-9);
}

TEST(FlightFit, SaysHowFarItMayBeOff) {
  constexpr int kRuns = 4000;
  constexpr double kSd_m = 0.03;
  std::mt19937_64 random{17};
  std::normal_distribution<double> noise{0.0, kSd_m};
  const auto clean = sightings(10);
  for (const double t_s : {0.09, 0.25, 0.5}) {
    Vector3d squares = Vector3d::Zero();
    double stated_m = 0.0;
    for (int run = 0; run < kRuns; ++run) {
      auto seen = clean;
      for (auto& s : seen) s.ball_m += Vector3d{noise(random), noise(random), noise(random)};
      const auto piece = fit_flight(seen, kGravity_mps2);
      stated_m = piece->sd_m(t_s, kSd_m);
      squares += (piece->at(t_s) - parabola(t_s)).array().square().matrix();
    }
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(std::sqrt(squares[axis] / kRuns) / stated_m, 1.0, 0.05) << t_s;
  }
}

// Heights of a ball that bounces, one sighting a number; the last bounce decides.
std::vector<Sighting> heights(const std::vector<double>& z_m) {
  std::vector<Sighting> seen;
  for (const double z : z_m) seen.push_back({static_cast<std::int64_t>(seen.size()) * 20'000'000, {0.0, 0.0, z}});
  return seen;
}

TEST(LastBounce, IsTheLastLowMinimum) {
  const auto twice = heights({1.0, 0.6, 0.15, 0.5, 0.7, 0.5, 0.12, 0.3, 0.4});
  const auto after = after_last_bounce(twice, 0.25);
  ASSERT_EQ(after.size(), 2u);
  EXPECT_EQ(after.front().ball_m.z(), 0.3);
}

TEST(LastBounce, AMinimumHighInTheAirIsNoise) {
  const auto noisy = heights({1.0, 0.95, 0.97, 0.9, 0.92, 0.8});
  EXPECT_EQ(after_last_bounce(noisy, 0.25).size(), noisy.size());
}

TEST(LastBounce, AFlightWithoutOneIsWhole) {
  const auto rising = heights({0.1, 0.3, 0.5, 0.7});
  EXPECT_EQ(after_last_bounce(rising, 0.25).size(), 4u);
  EXPECT_EQ(after_last_bounce(heights({0.4}), 0.25).size(), 1u);
  EXPECT_TRUE(after_last_bounce({}, 0.25).empty());
}

}  // namespace
}  // namespace trivela::nodes
