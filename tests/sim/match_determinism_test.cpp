#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "kicking/geometry/time.hpp"
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
    ASSERT_EQ(a.kicks[i].release_velocity_mps.x(), b.kicks[i].release_velocity_mps.x());
    ASSERT_EQ(a.kicks[i].margin_m, b.kicks[i].margin_m);
  }
}

TEST(Match, AnotherSeedIsAnotherMatch) {
  EXPECT_NE((Match{Scenario{}, 1, 1, 1.0}.sense().wheels.wheel_radps[0]),
            (Match{Scenario{}, 2, 1, 1.0}.sense().wheels.wheel_radps[0]));
}

/// Starts of a half's possessions, and the first sample of each, before what is done in it matters: noise too.
struct Met {
  std::map<std::uint32_t, std::pair<double, double>> start;  // x, heading
  std::map<std::uint32_t, double> gyro;

  Met(const Record& record, int half) {
    for (const auto& p : record.possessions) {
      if (p.half == half) start[p.possession_id] = {p.start.x_m, p.start.heading_rad};
    }
    for (const auto& s : record.sensors) {
      if (s.referee.half == half) gyro.try_emplace(s.referee.possession_id, s.wheels.gyro_radps);
    }
  }
};

int in_common(const Met& a, const Met& b) {
  int same = 0;
  for (const auto& [id, start] : a.start) {
    const auto other = b.start.find(id);
    same += other != b.start.end() && other->second == start && a.gyro.at(id) == b.gyro.at(id) ? 1 : 0;
  }
  return same;
}

TEST(Match, EveryPolicyMeetsTheSameOpportunities) {
  const Record still = play({}, 42, 1, 0.3, idle), kicking = play({}, 42, 1, 0.3, fire_at_once(30));
  const Met a{still, 1}, b{kicking, 1};
  EXPECT_GT(a.start.size(), 3u);
  EXPECT_EQ(in_common(a, b), static_cast<int>(std::min(a.start.size(), b.start.size())));
}

TEST(Match, EachHalfHasOpportunitiesOfItsOwn) {
  const Record record = play({}, 42, 3, 0.3, idle);
  const Met first{record, 1}, second{record, 2}, third{record, 3};
  EXPECT_EQ(in_common(first, second) + in_common(first, third) + in_common(second, third), 0);
  EXPECT_EQ(in_common(first, Met{play({}, 42, 1, 0.3, idle), 1}), static_cast<int>(first.start.size()))
      << "the first half is that of a match of one";
}

TEST(Match, PairedHalvesHaveThoseOfTheFirst) {
  const Record record = play({}, 42, 2, 0.3, idle, true);
  const Met first{record, 1}, second{record, 2};
  EXPECT_GT(first.start.size(), 3u);
  EXPECT_EQ(in_common(first, second), static_cast<int>(std::min(first.start.size(), second.start.size())));
}

TEST(Match, SamplesAreTheSameBitsWhateverElseIsLookedFor) {
  Match all{Scenario{}, 42, 1, 0.3}, some{Scenario{}, 42, 1, 0.3};
  const Policy policy = fire_at_once(25);
  const Policy same = fire_at_once(25);
  for (int cycle = 0; !all.done(); ++cycle) {
    // Each in turns, with pauses longer than any filter: what was not asked for does not matter later.
    const SensorChoice choice{cycle % 3 == 0, cycle % 5 == 0, cycle % 70 > 50};
    const Sensors full = all.sense(), part = some.sense(choice);
    ASSERT_EQ(part.t_ns, full.t_ns);
    ASSERT_EQ(part.kicker.charge, full.kicker.charge);
    ASSERT_EQ(part.referee.possession_id, full.referee.possession_id);
    if (choice.wheels) {
      ASSERT_EQ(part.wheels.wheel_radps, full.wheels.wheel_radps);
      ASSERT_EQ(part.wheels.gyro_radps, full.wheels.gyro_radps);
    } else {
      ASSERT_EQ(part.wheels.wheel_count, 0);
    }
    ASSERT_TRUE(same_bits(part.vision.pose, choice.vision ? full.vision.pose : std::nullopt));
    ASSERT_EQ(part.flight.ball.has_value(), choice.flight && full.flight.ball);
    if (part.flight.ball) {
      ASSERT_EQ(part.flight.ball->z_m, full.flight.ball->z_m);
    }
    all.step(policy(full));
    some.step(same(part));
  }
  EXPECT_TRUE(some.done());
}

TEST(Match, TheTrueStateIsWhatNoiselessSensorsShow) {
  Scenario s = alone();
  s.odometry = {0, 0, 0, 0};
  s.opponent.distance_median_m = 2.0;
  Match match{s, 4, 1, 0.1};
  while (!match.sense().referee.playing) match.step({});
  const TrueState start = match.true_state();
  EXPECT_TRUE(start.ball_held);
  EXPECT_EQ(start.charge, 1.0);
  EXPECT_NEAR(start.opponent_distance_m, 2.0, 1e-12);
  const double free_s = (2.0 - s.opponent.dispute_distance_m) / start.opponent_closing_mps;
  const std::int64_t t_ns = match.sense().t_ns;
  EXPECT_NEAR(kicking::seconds(start.dispute_t_ns - t_ns), free_s, 1e-8);
  std::vector<PossessionTruth> ends;
  while (ends.empty()) ends = match.step({.drive = {0.0, 0.0, 1.0}, .fire = {}}).possessions;
  EXPECT_EQ(ends[0].ending, PossessionEnd::kDisputed);
  EXPECT_EQ(ends[0].t_ns, start.dispute_t_ns);
  EXPECT_NEAR(match.true_state().twist.omega_radps, match.sense().wheels.gyro_radps, 1e-12);
}

}  // namespace
}  // namespace trivela::sim
