#include "robot/belief/world_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

using kicking::Pose;
using kicking::Twist;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kBallOffset_m = 0.27;

// A robot with perfect sensors; its odometry frame is F turned and shifted.
struct Play {
  config::WorldState settings{};
  WorldModel model{settings, kBallOffset_m};
  std::int64_t t_ns = 1'000'000'000;
  Pose truth{2.0, 3.0, 0.5};
  Pose odometry{};
  Twist twist{};
  std::optional<msg::Referee> referee = [] {
    msg::Referee word{};
    word.robot_id = 1;
    word.seq = 1;
    word.half = 2;
    word.playing = true;
    word.possession_id = 7;
    return word;
  }();
  std::optional<Eigen::Vector2d> ball_in_robot_m = Eigen::Vector2d{0.0, kBallOffset_m};
  std::optional<Eigen::Vector2d> opponent_in_robot_m;
  std::optional<Eigen::Vector2d> keeper_m;  // in F
  std::optional<msg::KickerStatus> kicker;
  bool localises = true;
  bool sees = true;

  msg::VisionFrame frame() const {
    msg::VisionFrame out{};
    out.t_ns = out.t_exposure_ns = t_ns;
    out.pose_seen = localises;
    out.x_m = localises ? truth.x_m : kNaN;
    out.y_m = localises ? truth.y_m : kNaN;
    out.heading_rad = localises ? truth.heading_rad : kNaN;
    out.ball_seen = ball_in_robot_m.has_value();
    out.ball_x_m = ball_in_robot_m ? ball_in_robot_m->x() : kNaN;
    out.ball_y_m = ball_in_robot_m ? ball_in_robot_m->y() : kNaN;
    out.opponent_seen = opponent_in_robot_m.has_value();
    out.opponent_x_m = opponent_in_robot_m ? opponent_in_robot_m->x() : kNaN;
    out.opponent_y_m = opponent_in_robot_m ? opponent_in_robot_m->y() : kNaN;
    out.keeper_seen = keeper_m.has_value();
    if (keeper_m) {
      const Eigen::Vector2d seen = kicking::to_robot(truth, *keeper_m);
      out.keeper_x_m = seen.x();
      out.keeper_y_m = seen.y();
    }
    return out;
  }

  msg::Odometry wheels() const {
    msg::Odometry out{};
    out.t_ns = t_ns;
    out.vx_mps = twist.vx_mps;
    out.vy_mps = twist.vy_mps;
    out.omega_radps = twist.omega_radps;
    out.x_m = odometry.x_m;
    out.y_m = odometry.y_m;
    out.heading_rad = odometry.heading_rad;
    out.var_position_m2 = 1e-12 * static_cast<double>(t_ns);
    out.var_heading_rad2 = 1e-14 * static_cast<double>(t_ns);
    return out;
  }

  msg::WorldState cycle(int cycles = 1) {
    msg::WorldState world{};
    for (int i = 0; i < cycles; ++i) {
      t_ns += kCycle_ns;
      truth = kicking::advance(truth, twist, 0.02);
      odometry = kicking::advance(odometry, twist, 0.02);
      const auto picture = frame();
      world =
          model.update(wheels(), sees ? &picture : nullptr, referee ? &*referee : nullptr, kicker ? &*kicker : nullptr);
    }
    return world;
  }
};

TEST(WorldModel, ARobotThatHasNotLocalisedItselfDoesNotPlay) {
  Play play;
  play.localises = false;
  EXPECT_FALSE(play.cycle(20).playing);
  play.localises = true;
  const auto world = play.cycle();
  EXPECT_TRUE(world.playing);
  EXPECT_NEAR(world.x_m, 2.0, 1e-9);
  EXPECT_NEAR(world.y_m, 3.0, 1e-9);
  EXPECT_NEAR(world.heading_rad, 0.5, 1e-9);
}

TEST(WorldModel, PassesTheRefereesWordOnAndStandsWithoutOne) {
  Play play;
  auto world = play.cycle(3);
  EXPECT_TRUE(world.playing);
  EXPECT_EQ(world.half, 2);
  EXPECT_EQ(world.t_ns, play.t_ns);
  play.referee->playing = false;
  EXPECT_FALSE(play.cycle().playing);
  play.referee.reset();
  world = play.cycle();
  EXPECT_FALSE(world.playing);
  EXPECT_EQ(world.half, 0);
}

TEST(WorldModel, CountsItsOwnPossessionsWhateverTheRefereeNumbers) {
  Play play;
  EXPECT_EQ(play.cycle(20).possession_id, 1u) << "not the referee's 7";
  play.referee->possession_id = 8;
  EXPECT_EQ(play.cycle(50).possession_id, 1u) << "as long as it has the ball";
  play.referee->playing = false;
  EXPECT_EQ(play.cycle().possession_id, 2u);
  play.referee->playing = true;
  EXPECT_EQ(play.cycle(10).possession_id, 2u);
  play.ball_in_robot_m = Eigen::Vector2d{0.0, 3.0};
  EXPECT_EQ(play.cycle(50).possession_id, 2u);
  play.ball_in_robot_m = Eigen::Vector2d{0.0, kBallOffset_m};
  EXPECT_EQ(play.cycle(20).possession_id, 3u);
}

TEST(WorldModel, AKickEndsAPossession) {
  Play play;
  play.kicker.emplace();
  EXPECT_EQ(play.cycle(20).possession_id, 1u);
  play.kicker->last_kick_id = 5;
  play.ball_in_robot_m = Eigen::Vector2d{0.0, 3.0};
  play.cycle(15);
  play.ball_in_robot_m = Eigen::Vector2d{0.0, kBallOffset_m};
  EXPECT_EQ(play.cycle(5).possession_id, 1u) << "refused";
  play.kicker->last_kick_id = 6;
  play.kicker->last_accepted = true;
  play.cycle();
  play.ball_in_robot_m = Eigen::Vector2d{0.0, 3.0};
  play.cycle(15);
  play.ball_in_robot_m = Eigen::Vector2d{0.0, kBallOffset_m};
  EXPECT_EQ(play.cycle(5).possession_id, 2u) << "a defender threw it back within 0.3 s";
}

TEST(WorldModel, ARefereeHeardWithoutTheBallCountsOnFromTheHalfsBeginning) {
  Play received, late;
  for (Play* const play : {&received, &late}) play->referee->half_time_s = 100.0;
  msg::Referee first = *received.referee;
  first.playing = false;
  first.half_time_s = kNaN;
  received.model.receive(first);
  EXPECT_EQ(received.cycle(20).possession_id, 1u);
  EXPECT_GT(late.cycle(20).possession_id, 1000u) << "a number that nobody has given";
}

TEST(WorldModel, AHeldBallMovesWithTheRobot) {
  Play play;
  play.twist = {0.3, 1.5, 1.0};
  auto world = play.cycle(100);
  ASSERT_TRUE(world.possession);
  ASSERT_TRUE(world.ball_known);
  const Eigen::Vector2d ball = kicking::to_field(play.truth, {0.0, kBallOffset_m});
  EXPECT_NEAR(world.ball_x_m, ball.x(), 1e-3);
  EXPECT_NEAR(world.ball_y_m, ball.y(), 1e-3);
  // Its velocity is that of the point of the robot where it lies.
  const Pose next = kicking::advance(play.truth, play.twist, 1e-6);
  const Eigen::Vector2d velocity = (kicking::to_field(next, {0.0, kBallOffset_m}) - ball) / 1e-6;
  EXPECT_NEAR(world.ball_vx_mps, velocity.x(), 1e-3);
  EXPECT_NEAR(world.ball_vy_mps, velocity.y(), 1e-3);
  // Out of sight for a few frames it still does.
  play.ball_in_robot_m.reset();
  world = play.cycle(3);
  ASSERT_TRUE(world.possession);
  const Eigen::Vector2d later = kicking::to_field(play.truth, {0.0, kBallOffset_m});
  EXPECT_NEAR(world.ball_x_m, later.x(), 1e-3);
  EXPECT_NEAR(world.ball_y_m, later.y(), 1e-3);
  EXPECT_NEAR(world.ball_age_s, 0.06, 1e-9);
}

TEST(WorldModel, AFreeBallStaysWhereItWasSeenWhileTheRobotDrivesOn) {
  Play play;
  play.ball_in_robot_m = Eigen::Vector2d{1.0, 2.0};
  play.cycle(5);
  const Eigen::Vector2d ball = kicking::to_field(play.truth, *play.ball_in_robot_m);
  play.ball_in_robot_m.reset();
  play.twist = {0.0, 2.0, 2.0};
  const auto world = play.cycle(10);
  EXPECT_FALSE(world.possession);
  ASSERT_TRUE(world.ball_known);
  EXPECT_NEAR(world.ball_x_m, ball.x(), 1e-3);
  EXPECT_NEAR(world.ball_y_m, ball.y(), 1e-3);
  EXPECT_TRUE(std::isnan(world.ball_vx_mps)) << "nobody measures it";
  EXPECT_FALSE(play.cycle(20).ball_known) << "after half a second it is unknown";
}

TEST(WorldModel, AnUnknownBallHasNoNumbers) {
  Play play;
  play.ball_in_robot_m.reset();
  play.opponent_in_robot_m = Eigen::Vector2d{0.0, 2.0};
  const auto world = play.cycle(3);
  EXPECT_FALSE(world.ball_known);
  for (const double number : {world.ball_x_m, world.ball_y_m, world.ball_vx_mps, world.ball_vy_mps, world.ball_age_s,
                              world.opponent_distance_m})
    EXPECT_TRUE(std::isnan(number));
}

TEST(WorldModel, MeasuresTheOpponentFromTheBall) {
  Play play;
  EXPECT_TRUE(std::isnan(play.cycle(3).opponent_distance_m));
  play.opponent_in_robot_m = Eigen::Vector2d{1.2, kBallOffset_m + 0.5};
  EXPECT_NEAR(play.cycle().opponent_distance_m, 1.3, 1e-9);
  // Not seen for a moment he is where he was; after half a second he is forgotten.
  play.opponent_in_robot_m.reset();
  EXPECT_NEAR(play.cycle(5).opponent_distance_m, 1.3, 1e-9);
  EXPECT_TRUE(std::isnan(play.cycle(25).opponent_distance_m));
}

TEST(WorldModel, WhereNobodyReadsThemNoOpponentIsTrackedButTheNearestsDistanceIsKnown) {
  Play tracked, untracked;
  untracked.model = WorldModel{untracked.settings, kBallOffset_m, false};
  tracked.opponent_in_robot_m = untracked.opponent_in_robot_m = Eigen::Vector2d{1.2, kBallOffset_m + 0.5};
  const msg::WorldState with = tracked.cycle(3), without = untracked.cycle(3);
  EXPECT_EQ(with.opponent_count, 1);
  EXPECT_EQ(without.opponent_count, 0);
  EXPECT_EQ(without.opponent_distance_m, with.opponent_distance_m);
}

TEST(WorldModel, FiltersTheTwistWithItsTimeConstant) {
  Play play;
  play.cycle(5);
  play.twist = {0.0, 1.0, 2.0};
  const auto world = play.cycle();
  const double gain = 1.0 - std::exp(-0.02 / play.settings.velocity_time_constant_s);
  EXPECT_NEAR(world.vy_mps, gain, 1e-12);
  EXPECT_NEAR(world.omega_radps, 2.0 * gain, 1e-12);
  EXPECT_NEAR(play.cycle(50).vy_mps, 1.0, 1e-9);
}

TEST(WorldModel, TakesAFrameOnceHoweverOftenItIsShown) {
  Play play;
  play.cycle(5);
  const double sd_m = play.cycle().sd_position_m;
  const auto frame = play.frame();
  for (int i = 0; i < 5; ++i) play.model.update(play.wheels(), &frame, &*play.referee);
  play.sees = false;
  EXPECT_GE(play.cycle().sd_position_m, sd_m) << "the same picture is no new knowledge";
}

TEST(WorldModel, ForgedOdometryLeavesNoTrace) {
  for (const double forged : {1e7, 1e300, -1e308, kNaN, HUGE_VAL}) {
    for (double msg::Odometry::*field :
         {&msg::Odometry::x_m, &msg::Odometry::heading_rad, &msg::Odometry::vy_mps, &msg::Odometry::var_position_m2}) {
      Play play;
      play.cycle(20);
      msg::Odometry odometry = play.wheels();
      odometry.t_ns += 1000;
      odometry.*field = forged;
      EXPECT_FALSE(play.model.update(odometry, nullptr, &*play.referee).playing);
      const auto world = play.cycle(20);
      EXPECT_TRUE(world.playing) << forged;
      EXPECT_NEAR(world.x_m, play.truth.x_m, 1e-3) << forged;
      EXPECT_NEAR(world.y_m, play.truth.y_m, 1e-3) << forged;
    }
  }
}

TEST(WorldModel, GoesOnWithoutAnyCamera) {
  Play play;
  play.cycle(5);
  play.sees = false;
  play.twist = {0.0, 1.0, 0.0};
  const auto world = play.cycle(30);
  EXPECT_TRUE(world.playing);
  EXPECT_NEAR(world.x_m, play.truth.x_m, 1e-9);
  EXPECT_NEAR(world.y_m, play.truth.y_m, 1e-9);
}

TEST(WorldModel, FollowsTheKeeperAlongItsLineWhileTheRobotDrivesAndTurns) {
  Play play;
  EXPECT_TRUE(std::isnan(play.cycle(5).keeper_x_m)) << "none was ever seen";
  play.keeper_m = Eigen::Vector2d{0.4, 9.0};
  play.twist = {0.3, 0.8, 1.0};
  msg::WorldState world = play.cycle(40);
  EXPECT_NEAR(world.keeper_x_m, 0.4, 0.05);
  EXPECT_GT(world.keeper_sd_m, 0.0);
  EXPECT_LT(world.keeper_sd_m, 0.15);
  play.keeper_m.reset();
  world = play.cycle(100);
  EXPECT_LT(world.keeper_x_m, 0.35) << "a keeper that nobody sees goes back to the middle";
  EXPECT_GT(world.keeper_sd_m, 0.15);
}

}  // namespace
}  // namespace trivela::robot
