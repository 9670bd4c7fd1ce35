#include "robot/belief/opponent_tracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {
namespace {

constexpr std::int64_t kPicture_ns = 20'000'000;
constexpr double kPictureSd_m = 0.14;

struct Walker {
  Eigen::Vector2d from_m, velocity_mps;
  Eigen::Vector2d at(std::int64_t t_ns) const { return from_m + kicking::seconds(t_ns) * velocity_mps; }
};

/// The track that is nearest to a place.
const OpponentTrack& nearest(const OpponentTracks& tracks, const Eigen::Vector2d& place_m) {
  return *std::ranges::min_element(tracks.tracks(), {},
                                   [&](const OpponentTrack& track) { return (track.position_m - place_m).norm(); });
}

TEST(OpponentTracks, FollowFiveThroughDropOutsAndKnowHowWell) {
  std::mt19937_64 random{7};
  std::normal_distribution<double> noise{0.0, kPictureSd_m};
  std::bernoulli_distribution seen{0.7};
  const Walker walkers[] = {
      {{0, 0}, {1, 0}}, {{3, 1}, {-1, 0.5}}, {{-2, 4}, {0, -1.5}}, {{5, 5}, {0, 0}}, {{-4, 0}, {0.5, 1}}};
  OpponentTracks tracks;
  double squares = 0.0, squares_v = 0.0;
  int counted = 0;
  for (std::int64_t t_ns = 0; t_ns < 150 * kPicture_ns; t_ns += kPicture_ns) {
    std::vector<Eigen::Vector2d> picture;
    for (const Walker& walker : walkers)
      if (seen(random)) picture.push_back(walker.at(t_ns) + Eigen::Vector2d{noise(random), noise(random)});
    std::ranges::shuffle(picture, random);
    tracks.observe(t_ns, picture, kPictureSd_m);
    if (t_ns < 50 * kPicture_ns) continue;
    ASSERT_EQ(tracks.tracks().size(), 5u);
    for (const Walker& walker : walkers) {
      const OpponentTrack& track = nearest(tracks, walker.at(t_ns));
      squares += (track.position_m - walker.at(t_ns)).squaredNorm() / track.var_m2;
      squares_v += (track.velocity_mps - walker.velocity_mps).squaredNorm() / track.var_m2ps2;
      ++counted;
    }
  }
  EXPECT_LT(squares / counted, 2.0) << "steady walkers: the filter allows for more";
  EXPECT_GT(squares / counted, 0.2);
  EXPECT_LT(squares_v / counted, 2.0);
}

TEST(OpponentTracks, OneThatIsNotSeenGoesOnGetsUncertainAndIsDropped) {
  OpponentTracks tracks;
  const Walker walker{{0, 0}, {2, 0}};
  std::int64_t t_ns = 0;
  for (; t_ns < 50 * kPicture_ns; t_ns += kPicture_ns) {
    const Eigen::Vector2d seen = walker.at(t_ns);
    tracks.observe(t_ns, {&seen, 1}, kPictureSd_m);
  }
  const OpponentTrack before = tracks.tracks().front();
  for (int i = 0; i < 25; ++i, t_ns += kPicture_ns) tracks.observe(t_ns, {}, kPictureSd_m);
  ASSERT_EQ(tracks.tracks().size(), 1u);
  const OpponentTrack& later = tracks.tracks().front();
  EXPECT_NEAR(later.position_m.x(), walker.at(t_ns - kPicture_ns).x(), 0.2);
  EXPECT_GT(later.var_m2, 4.0 * before.var_m2);
  for (int i = 0; i < 30; ++i, t_ns += kPicture_ns) tracks.observe(t_ns, {}, kPictureSd_m);
  EXPECT_TRUE(tracks.tracks().empty());
}

TEST(OpponentTracks, WhatIsNotFiniteOrTooManyCountsForNothing) {
  OpponentTracks tracks;
  std::vector<Eigen::Vector2d> picture{{std::nan(""), 1.0}, {1.0, HUGE_VAL}};
  tracks.observe(0, picture, kPictureSd_m);
  EXPECT_TRUE(tracks.tracks().empty());
  picture.clear();
  for (int i = 0; i < 9; ++i) picture.emplace_back(2.0 * i, 0.0);
  tracks.observe(kPicture_ns, picture, kPictureSd_m);
  EXPECT_EQ(tracks.tracks().size(), kicking::kMostBodies);
  tracks.observe(2 * kPicture_ns, picture, 0.0);
  EXPECT_EQ(tracks.tracks().size(), kicking::kMostBodies);
}

}  // namespace
}  // namespace trivela::robot
