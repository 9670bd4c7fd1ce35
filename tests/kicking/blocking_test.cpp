// Opponents in a ball's way.
#include "kicking/outcome/opponents.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kicking/random/draws.hpp"
#include "tests/kicking/play.hpp"

namespace trivela::kicking {
namespace {

constexpr double kReach_m = 0.26 + 0.11;

KickPath flat_path(double speed_mps = 10.0) { return {.velocity_mps{0.0, speed_mps}}; }

TEST(Blocking, ABodyOnTheWayStopsAFlatBallAndOneBesideItDoesNot) {
  EXPECT_DOUBLE_EQ(p_in_the_way({0.0, 2.0}, 0.0, flat_path(), {}), 1.0);
  EXPECT_DOUBLE_EQ(p_in_the_way({0.3, 2.0}, 0.0, flat_path(), {}), 1.0);
  EXPECT_DOUBLE_EQ(p_in_the_way({kReach_m + 0.01, 2.0}, 0.0, flat_path(), {}), 0.0);
  EXPECT_DOUBLE_EQ(p_in_the_way({0.0, -1.0}, 0.0, flat_path(), {}), 0.0) << "behind";
  EXPECT_NEAR(p_in_the_way({kReach_m, 2.0}, 0.05, flat_path(), {}), 0.5, 1e-9) << "its edge on the way";
}

TEST(Blocking, ALobPassesOverABodyFromSomeDistanceOn) {
  // 36.78 degrees and 8 m/s: 0.8 m higher after 1.3 m, and down to there 3.7 m after that.
  const KickPath lob{.velocity_mps{0.0, 6.41}, .v_z_mps = 4.79};
  EXPECT_DOUBLE_EQ(p_in_the_way({0.0, 1.0}, 0.0, lob, {}), 1.0);
  EXPECT_DOUBLE_EQ(p_in_the_way({0.0, 2.5}, 0.0, lob, {}), 0.0);
  EXPECT_DOUBLE_EQ(p_in_the_way({0.0, 6.0}, 0.0, lob, {}), 1.0) << "it comes down";
  EXPECT_DOUBLE_EQ(p_in_the_way({0.0, 1.0}, 0.0, lob, {.height_m = 0.1}), 0.0);
}

TEST(Blocking, IsTheShareOfDrawnWaysThatMeetTheBody) {
  const Draws draws{1, 1};
  for (const double s_m : {0.6, 1.5, 3.0})
    for (double u_m = -0.8; u_m <= 0.8; u_m += 0.2) {
      const double sd_m = 0.1, sd_rad = 0.05;
      const KickPath path{.velocity_mps{6.0, 8.0}, .sd_rad = sd_rad};
      const Eigen::Vector2d along(0.6, 0.8), right(0.8, -0.6);
      int met = 0;
      constexpr int kDrawn = 20000;
      for (int i = 0; i < kDrawn; ++i) {
        const auto [x, y, turn, spare] = draws.normals(Role::kKeeper, static_cast<std::uint32_t>(i));
        const Eigen::Vector2d body = s_m * along + u_m * right + sd_m * Eigen::Vector2d{x, y};
        const double angle = sd_rad * turn;
        const Eigen::Vector2d way = std::cos(angle) * along + std::sin(angle) * right;
        met += std::abs(body.x() * way.y() - body.y() * way.x()) < kReach_m ? 1 : 0;
      }
      EXPECT_NEAR(p_in_the_way(s_m * along + u_m * right, sd_m, path, {}), static_cast<double>(met) / kDrawn, 0.02)
          << s_m << ' ' << u_m;
    }
}

TEST(Blocking, OfABallThatDoesNotMoveIsNothing) { EXPECT_EQ(p_in_the_way({0.0, 1.0}, 0.1, {}, {}), 0.0); }

PolicyInput with_opponent(const Eigen::Vector2d& from_ball_m) {
  PolicyInput input = tests::ready_at({0.0, 4.0, 0.0}, {});
  const double distance_m = from_ball_m.norm();
  input.opponent_distance_m = distance_m;
  input.opponent_closing_mps = 1.3;
  input.opponents[0] = {Eigen::Vector2d{0.0, 4.0 + RobotModel{}.ball_offset_m} + from_ball_m, 1.3, 0.1};
  input.opponent_count = 1;
  return input;
}

TEST(Blocking, TheLikelihoodOfAShotIsThatOfItsWay) {
  const auto p_of = [](const PolicyInput& input) {
    PolicyMemory memory;
    PolicyConfig config;
    config.predictive.opponent_places = true;
    return evaluate(PolicyName::kPredictive, config, {}, {}, input, memory).p_on_target.value_or(0.0);
  };
  const double ahead = p_of(with_opponent({0.0, 0.8})), beside = p_of(with_opponent({0.8, 0.0}));
  PolicyInput unknown = with_opponent({0.0, 0.8});
  unknown.opponent_count = 0;
  EXPECT_LT(ahead, 0.05);
  EXPECT_GT(beside, 0.8);
  EXPECT_GT(p_of(unknown), ahead);
  EXPECT_LT(p_of(unknown), beside) << "somewhere around the ball";
  EXPECT_GT(p_of(with_opponent({0.0, 2.5})), 0.8) << "the lob passes over it";
}

}  // namespace
}  // namespace trivela::kicking
