#include "pages/lob/replay_scene.hpp"

#include <gtest/gtest.h>

namespace trivela::pages {
namespace {

constexpr std::int64_t kPeriod_ns = 25'000'000;

Player player_of(int scans) {
  std::vector<std::int64_t> t_ns;
  for (int i = 0; i < scans; ++i) t_ns.push_back(1'000'000'007 + i * kPeriod_ns);
  return Player{t_ns};
}

TEST(Player, StandsStillUntilItPlays) {
  Player player = player_of(10);
  player.advance(1.0);
  EXPECT_EQ(player.position(), 0u);
}

TEST(Player, GoesOnAScanInItsPeriodAtEverySpeed) {
  for (const double speed : {0.1, 1.0, 10.0}) {
    Player player = player_of(10);
    player.set_speed(speed);
    player.play();
    player.advance(0.024 / speed);
    EXPECT_EQ(player.position(), 0u) << speed;
    player.advance(0.002 / speed);
    EXPECT_EQ(player.position(), 1u) << speed;
    player.advance(0.100 / speed);
    EXPECT_EQ(player.position(), 5u) << speed;
  }
}

TEST(Player, PlaysBackwardsThroughTheSameScans) {
  Player player = player_of(10);
  player.seek(5);
  player.set_speed(-1.0);
  player.play();
  for (std::size_t expected = 4; expected > 0; --expected) {
    player.advance(0.025);
    EXPECT_EQ(player.position(), expected);
    EXPECT_TRUE(player.playing());
  }
  player.advance(0.025);
  EXPECT_EQ(player.position(), 0u);
  EXPECT_FALSE(player.playing());
}

TEST(Player, StopsAtTheEndAndBeginsAnew) {
  Player player = player_of(10);
  player.set_speed(1000.0);
  player.play();
  player.advance(1.0);
  EXPECT_EQ(player.position(), 9u);
  EXPECT_FALSE(player.playing());
  player.play();
  EXPECT_EQ(player.position(), 0u);
  EXPECT_TRUE(player.playing());
  player.set_speed(-1.0);
  player.play();
  EXPECT_EQ(player.position(), 9u) << "backwards from the beginning";
}

TEST(Player, SeekingStaysWithinTheRecord) {
  Player player = player_of(10);
  player.seek(7);
  EXPECT_EQ(player.position(), 7u);
  player.seek(-3);
  EXPECT_EQ(player.position(), 0u);
  player.seek(1'000'000);
  EXPECT_EQ(player.position(), 9u);
}

TEST(Player, ARecordOfOneScanEndsWhereItBegins) {
  Player player = player_of(1);
  player.play();
  player.advance(0.1);
  EXPECT_EQ(player.position(), 0u);
  EXPECT_FALSE(player.playing());
}

}  // namespace
}  // namespace trivela::pages
