#include "kicking/ballistics/flight.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace trivela::kicking {
namespace {

using Eigen::Vector3d;

const FlightState kStart{{0.5, 4.0, 0.11}, {-0.7, 6.5, 4.8}};

Vector3d later(const FlightState& start, double t_s, double gravity_mps2 = kGravity_mps2) {
  return start.position_m + start.velocity_mps * t_s - Vector3d{0.0, 0.0, gravity_mps2 * t_s * t_s / 2.0};
}

std::vector<Sighting> sightings(int n, double gravity_mps2 = kGravity_mps2, std::int64_t start_ns = 3'000'000'000) {
  std::vector<Sighting> seen;
  for (int i = 0; i < n; ++i) seen.push_back({start_ns + i * 20'000'000, later(kStart, i * 0.02, gravity_mps2)});
  return seen;
}

TEST(FlightFit, FindsAFlightWithoutNoiseExactly) {
  for (const double gravity : {kGravity_mps2, 0.0}) {
    for (const int n : {2, 3, 10, 40}) {
      const auto start = fit_flight(sightings(n, gravity), gravity);
      ASSERT_TRUE(start);
      EXPECT_LT((start->velocity_mps - kStart.velocity_mps).norm(), 1e-9);
      for (const double t_s : {-0.1, 0.0, 0.33, 1.0})
        EXPECT_LT((later(*start, t_s, gravity) - later(kStart, t_s, gravity)).norm(), 1e-9);
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
  EXPECT_LT((later(*fit_flight(seen, kGravity_mps2), 0.7) - later(kStart, 0.7)).norm(), 1e-9);
}

TEST(FlightFit, FollowsAClockOfItsOwn) {
  std::vector<Sighting> seen;
  for (int i = 0; i < 5; ++i) seen.push_back({i * 20'000'000, kStart.position_m + kStart.velocity_mps * (3.0 * i)});
  const auto line = fit_line(
      seen, [](const Sighting& s) { return 3.0 * static_cast<double>(s.t_ns) / 20e6; },
      [](const Sighting& s) { return s.ball_m; });
  ASSERT_TRUE(line);
  EXPECT_LT((line->position_m - kStart.position_m).norm(), 1e-9);
  EXPECT_LT((line->velocity_mps - kStart.velocity_mps).norm(), 1e-9);
}

TEST(Flight, InSpaceIsTheFlightInItsPlane) {
  const double drag = drag_per_m({}, {});
  FlightState ball = kStart;
  for (int i = 0; i < 50; ++i) fly(ball, 0.01, drag);
  const double along_mps = kStart.velocity_mps.head<2>().norm();
  std::vector<Eigen::Vector4d> states;
  fly_at_times({0.0, kStart.position_m.z(), along_mps, kStart.velocity_mps.z()}, drag, std::vector{0.5}, states);
  EXPECT_NEAR((ball.position_m - kStart.position_m).head<2>().norm(), states[0][0], 1e-8);
  EXPECT_NEAR(ball.position_m.z(), states[0][1], 1e-8);
  EXPECT_NEAR(ball.velocity_mps.z(), states[0][3], 1e-8);
}

}  // namespace
}  // namespace trivela::kicking
