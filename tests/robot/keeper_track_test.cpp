#include "robot/belief/opponent_tracks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace trivela::robot {
namespace {

constexpr std::int64_t kFrame_ns = 40'000'000;

TEST(KeeperTrack, KnowsNothingOfAKeeperThatWasNeverSeen) {
  KeeperTrack track;
  EXPECT_FALSE(track.at(0));
  track.observe(1, std::nan(""), 0.2);
  track.observe(1, 0.3, 0.0);
  EXPECT_FALSE(track.at(2));
}

TEST(KeeperTrack, TheFirstPictureIsWeighedWithTheGoalsMiddle) {
  KeeperTrack track;
  track.observe(1, 0.4, 0.3);  // as uncertain as any keeper's place
  EXPECT_NEAR(track.at(1)->x_m, 0.2, 1e-12);
  EXPECT_NEAR(track.at(1)->sd_m, 0.3 / std::sqrt(2.0), 1e-12);
}

TEST(KeeperTrack, FindsAKeeperThatStandsAsWellAsItSays) {
  std::mt19937 random{1};
  std::normal_distribution<double> noise{0.0, 0.2};
  double chi_square = 0.0;
  for (int keeper = 0; keeper < 200; ++keeper) {
    KeeperTrack track;
    const double x_m = 0.3 * noise(random) / 0.2;
    std::int64_t t_ns = 0;
    for (int frame = 0; frame < 20; ++frame) track.observe(t_ns += kFrame_ns, x_m + noise(random), 0.2);
    const auto place = *track.at(t_ns);
    EXPECT_LT(place.sd_m, 0.1);
    chi_square += std::pow((place.x_m - x_m) / place.sd_m, 2) / 200.0;
  }
  EXPECT_LT(chi_square, 1.3) << "it moves less than the filter allows";
  EXPECT_GT(chi_square, 0.4);
}

TEST(KeeperTrack, GoesBackToTheMiddleWhereItIsNotSeen) {
  KeeperTrack track;
  track.observe(1, 0.6, 0.05);
  EXPECT_NEAR(track.at(1)->x_m, 0.58, 0.01);
  double last_sd_m = track.at(1)->sd_m;
  for (int s = 1; s < 60; s += 5) {
    const auto place = *track.at(s * std::int64_t{1'000'000'000});
    EXPECT_GE(place.sd_m, last_sd_m);
    last_sd_m = place.sd_m;
  }
  EXPECT_NEAR(last_sd_m, 0.3, 1e-4);
  EXPECT_NEAR(track.at(std::int64_t{60} * 1'000'000'000)->x_m, 0.0, 1e-4);
}

TEST(KeeperTrack, AnOlderPictureChangesNothing) {
  KeeperTrack track;
  track.observe(kFrame_ns, 0.2, 0.1);
  const double before = track.at(kFrame_ns)->x_m;
  track.observe(kFrame_ns, -0.5, 0.1);
  track.observe(0, -0.5, 0.1);
  EXPECT_EQ(track.at(kFrame_ns)->x_m, before);
}

TEST(KeeperTrack, APictureOfARobotThatDoesNotKnowItsPlaceChangesNothing) {
  KeeperTrack track;
  track.observe(1, 6.0, 0.2);
  EXPECT_FALSE(track.at(2));
  track.observe(kFrame_ns, 0.2, 0.1);
  const double before = track.at(kFrame_ns)->x_m;
  track.observe(2 * kFrame_ns, -6.0, 0.2);
  EXPECT_NEAR(track.at(2 * kFrame_ns)->x_m, before, 0.01);
}

}  // namespace
}  // namespace trivela::robot
