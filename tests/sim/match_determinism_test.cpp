#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "tests/sim/played_match.hpp"

namespace trivela::sim {
namespace {

bool same_bits(const std::optional<kicking::Pose>& a, const std::optional<kicking::Pose>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->x_m == b->x_m && a->y_m == b->y_m && a->heading_rad == b->heading_rad;
}

TEST(Match, TheSameSeedAndCommandsGiveTheSameBits) {
  const Record a = play({}, 42, 2, 0.15, fire_at_once(25)), b = play({}, 42, 2, 0.15, fire_at_once(25));
  ASSERT_EQ(a.sensors.size(), b.sensors.size());
  ASSERT_GT(a.kicks.size(), 3U);
  for (std::size_t i = 0; i < a.sensors.size(); ++i) {
    ASSERT_EQ(a.sensors[i].wheels.wheel_radps, b.sensors[i].wheels.wheel_radps);
    ASSERT_EQ(a.sensors[i].kicker.charge, b.sensors[i].kicker.charge);
    ASSERT_TRUE(same_bits(a.sensors[i].vision.pose, b.sensors[i].vision.pose));
  }
  ASSERT_EQ(a.kicks.size(), b.kicks.size());
  for (std::size_t i = 0; i < a.kicks.size(); ++i) {
    ASSERT_EQ(a.kicks[i].release_velocity_mps.x, b.kicks[i].release_velocity_mps.x);
    ASSERT_EQ(a.kicks[i].margin_m, b.kicks[i].margin_m);
  }
}

TEST(Match, AnotherSeedIsAnotherMatch) {
  EXPECT_NE((Match{Scenario{}, 1, 1, 1.0}.sense().wheels.wheel_radps[0]),
            (Match{Scenario{}, 2, 1, 1.0}.sense().wheels.wheel_radps[0]));
}

TEST(Match, EveryPolicyAndHalfMeetsTheSameOpportunities) {
  const Record still = play({}, 42, 2, 0.3, idle), kicking = play({}, 42, 1, 0.3, fire_at_once(30));
  std::map<std::uint32_t, PossessionTruth> first;
  for (const auto& p : kicking.possessions) first[p.possession_id] = p;
  int compared = 0;
  for (const auto& p : still.possessions) {
    const auto match = first.find(p.possession_id);
    if (match == first.end()) continue;
    EXPECT_EQ(p.start.x_m, match->second.start.x_m);
    EXPECT_EQ(p.start.heading_rad, match->second.start.heading_rad);
    ++compared;
  }
  EXPECT_GT(compared, 6);
  // The noise too: the first sample of each possession, before the policies differ.
  const auto noise = [](const Record& record, int half) {
    std::map<std::uint32_t, double> gyro;
    for (const auto& s : record.sensors) {
      if (s.referee.half == half) gyro.try_emplace(s.referee.possession_id, s.wheels.gyro_radps);
    }
    return gyro;
  };
  const auto a = noise(still, 1), b = noise(still, 2), c = noise(kicking, 1);
  for (std::uint32_t id = 1; id <= 5; ++id) {
    EXPECT_EQ(a.at(id), b.at(id));
    EXPECT_EQ(a.at(id), c.at(id));
  }
}

TEST(Match, AStepTakesLessThanTwentyMicroseconds) {
  Match match{alone(), 1, 1, 10.0};
  for (int i = 0; i < 100; ++i) match.step({});
  double best_s = 1.0;
  for (int i = 0; i < 50; ++i) {
    const auto start = std::chrono::steady_clock::now();
    match.step({.drive = {0.5, 0.5, 0.5}, .fire = {}});
    match.sense();
    best_s = std::min(best_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
#ifdef NDEBUG
  EXPECT_LT(best_s, 20e-6);
#else
  EXPECT_LT(best_s, 500e-6);  // without optimisation, perhaps under a sanitizer
#endif
}

}  // namespace
}  // namespace trivela::sim
