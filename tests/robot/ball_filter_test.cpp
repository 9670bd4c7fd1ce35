#include "robot/belief/ball_filter.hpp"
#include "kicking/geometry/time.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace trivela::robot {
namespace {

using Seen = std::optional<Eigen::Vector2d>;

constexpr std::int64_t kFrame_ns = 20'000'000;
const Eigen::Vector2d kHandler{0.0, 0.27};

struct Frames {
  config::WorldState settings{};
  BallFilter filter{settings, kHandler.y()};
  std::int64_t t_ns = 1'000'000'000;

  void show(const Seen& ball, int frames = 1) {
    for (int i = 0; i < frames; ++i) filter.observe(t_ns += kFrame_ns, ball);
  }
};

TEST(BallFilter, KnowsNothingAtFirst) {
  Frames frames;
  EXPECT_FALSE(frames.filter.position_m());
  EXPECT_FALSE(frames.filter.possession());
  frames.show({}, 5);
  EXPECT_FALSE(frames.filter.position_m());
  EXPECT_FALSE(frames.filter.possession());
}

TEST(BallFilter, PossessionBeginsOnceTheHandlerSaysSoForTheDebounceTime) {
  Frames frames;
  frames.show(kHandler);  // the first that says so; 40 ms later it holds
  EXPECT_FALSE(frames.filter.possession());
  frames.show(kHandler);
  EXPECT_FALSE(frames.filter.possession());
  frames.show(kHandler);
  EXPECT_TRUE(frames.filter.possession());
}

TEST(BallFilter, PossessionEndsAfterTheDebounceTimeToo) {
  Frames frames;
  frames.show(kHandler, 5);
  const Eigen::Vector2d away{0.0, 1.5};
  frames.show(away, 2);
  EXPECT_TRUE(frames.filter.possession());
  frames.show(away);
  EXPECT_FALSE(frames.filter.possession());
}

TEST(BallFilter, ABallThatFlickersThroughTheHandlerIsNotHeld) {
  Frames frames;
  for (int i = 0; i < 20; ++i) {
    frames.show(kHandler, 2);
    frames.show(Eigen::Vector2d{0.0, 2.0});
    EXPECT_FALSE(frames.filter.possession());
  }
}

TEST(BallFilter, TheHandlerIsAsWideAndDeepAsTheSettingsSay) {
  const config::WorldState s{};
  const auto held_at = [](double x_m, double y_m) {
    Frames frames;
    frames.show(Eigen::Vector2d{x_m, y_m}, 5);
    return frames.filter.possession();
  };
  EXPECT_TRUE(held_at(s.handler_half_width_m - 0.001, kHandler.y()));
  EXPECT_FALSE(held_at(s.handler_half_width_m + 0.001, kHandler.y()));
  EXPECT_FALSE(held_at(-s.handler_half_width_m - 0.001, kHandler.y()));
  EXPECT_TRUE(held_at(0.0, kHandler.y() + s.handler_reach_m - 0.001));
  EXPECT_FALSE(held_at(0.0, kHandler.y() + s.handler_reach_m + 0.001));
  EXPECT_FALSE(held_at(0.0, kHandler.y() - s.handler_reach_m - 0.001));
}

TEST(BallFilter, ABallOutOfSightIsHeldForAWhileThenNotHeldThenUnknown) {
  Frames frames;
  frames.show(kHandler, 5);
  const std::int64_t seen = frames.filter.seen_t_ns();
  bool held_once = false, known_but_not_held = false;
  for (int i = 0; i < 40; ++i) {
    frames.show({});
    const double unseen_s = kicking::seconds(frames.t_ns - seen);
    EXPECT_EQ(frames.filter.possession(), unseen_s <= frames.settings.possession_forget_s) << unseen_s;
    EXPECT_EQ(frames.filter.position_m().has_value(), unseen_s <= frames.settings.ball_forget_s) << unseen_s;
    held_once = held_once || frames.filter.possession();
    known_but_not_held = known_but_not_held || (frames.filter.position_m() && !frames.filter.possession());
  }
  EXPECT_TRUE(held_once);
  EXPECT_TRUE(known_but_not_held);
  EXPECT_EQ(frames.filter.seen_t_ns(), seen);
}

TEST(BallFilter, ABallSeenAgainInTheHandlerMustBeDebouncedAgain) {
  Frames frames;
  frames.show(kHandler, 5);
  frames.show({}, 20);
  frames.show(kHandler, 2);
  EXPECT_FALSE(frames.filter.possession());
  frames.show(kHandler);
  EXPECT_TRUE(frames.filter.possession());
}

TEST(BallFilter, LowPassesSmallSteps) {
  Frames frames;
  frames.show(Eigen::Vector2d{0.0, 1.0}, 3);
  frames.show(Eigen::Vector2d{0.0, 1.4});
  const double gain = 1.0 - std::exp(-0.02 / frames.settings.ball_time_constant_s);
  EXPECT_NEAR(frames.filter.position_m()->y(), 1.0 + gain * 0.4, 1e-12);
  frames.show(Eigen::Vector2d{0.0, 1.4}, 50);
  EXPECT_NEAR(frames.filter.position_m()->y(), 1.4, 1e-6);
}

TEST(BallFilter, AJumpStartsAnew) {
  Frames frames;
  frames.show(Eigen::Vector2d{0.0, 1.0}, 3);
  frames.show(Eigen::Vector2d{0.0, 3.0});
  EXPECT_EQ(frames.filter.position_m()->y(), 3.0);
}

TEST(BallFilter, AveragesNoise) {
  Frames frames;
  std::mt19937_64 random{9};
  std::normal_distribution<double> noise{0.0, 0.03};
  double squares = 0.0;
  constexpr int kFrames = 4000;
  for (int i = 0; i < kFrames; ++i) {
    frames.show(Eigen::Vector2d{kHandler + Eigen::Vector2d{noise(random), noise(random)}});
    squares += (*frames.filter.position_m() - kHandler).squaredNorm() / 2.0;
  }
  // First-order low pass: variance times gain / (2 - gain).
  const double gain = 1.0 - std::exp(-0.02 / frames.settings.ball_time_constant_s);
  EXPECT_NEAR(squares / kFrames, 0.0009 * gain / (2.0 - gain), 0.0009 * 0.03);
  EXPECT_TRUE(frames.filter.possession());
}

TEST(BallFilter, APositionThatIsNotFiniteIsNoSighting) {
  Frames frames;
  frames.show(kHandler, 5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::int64_t seen = frames.filter.seen_t_ns();
  frames.show(Eigen::Vector2d{nan, 0.27});
  frames.show(Eigen::Vector2d{0.0, HUGE_VAL});
  EXPECT_EQ(frames.filter.seen_t_ns(), seen);
  EXPECT_TRUE(frames.filter.position_m()->allFinite());
}

}  // namespace
}  // namespace trivela::robot
