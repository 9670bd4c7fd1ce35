#include "robot/observer/flight_fit.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "kicking/constants.hpp"

namespace trivela::robot {
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
    }
  }
}

TEST(FlightFit, NeedsTwoInstants) {
  EXPECT_FALSE(fit_flight({}, kGravity_mps2));
  EXPECT_FALSE(fit_flight(sightings(1), kGravity_mps2));
  const Sighting once = sightings(1)[0];
  EXPECT_FALSE(fit_flight(std::vector<Sighting>{once, once, once}, kGravity_mps2));
}

TEST(FlightFit, FramesMayBeMissing) {
  auto seen = sightings(12);
  seen.erase(seen.begin() + 3, seen.begin() + 7);
  EXPECT_LT((fit_flight(seen, kGravity_mps2)->at(0.7) - parabola(0.7)).norm(), 1e-9);
}

}  // namespace
}  // namespace trivela::robot
