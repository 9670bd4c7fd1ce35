#include "nodes/world_state/world_state_node.hpp"

#include <cmath>
#include <limits>

#include "tests/instants.hpp"
#include "tests/nodes/node_fixture.hpp"

namespace trivela::nodes {
namespace {

using bus::Executor;

class WorldStateNodeTest : public NodeTest {
 protected:
  WorldStateNodeTest() { clock_ns = 0; }

  static msg::Odometry odometry(std::int64_t cycle) {
    msg::Odometry out{};
    out.t_ns = cycle * kCycle_ns;
    return out;
  }
  static msg::VisionFrame vision(std::int64_t cycle) {
    msg::VisionFrame out{};
    out.t_ns = out.t_exposure_ns = cycle * kCycle_ns;
    out.pose_seen = out.ball_seen = true;
    out.x_m = 1.0;
    out.y_m = 2.0;
    out.heading_rad = 0.5;
    out.ball_y_m = 0.27;
    return out;
  }
  static msg::Referee referee() {
    msg::Referee out{};
    out.half = 1;
    out.playing = true;
    out.possession_id = 3;
    return out;
  }

  Received<msg::WorldState> world{participant};
  Says<msg::Odometry> wheels_say{participant};
  Says<msg::VisionFrame> camera_says{participant};
  Says<msg::Referee> referee_permission{participant};
};

TEST_F(WorldStateNodeTest, AForgedFutureInRealTimeSilencesNoPictureThatFollows) {
  const bus::Participant own_participant{bus::fresh_domain(), bus::RealTime{}};
  bus::Stop own_stop;
  NodeContext own{context.settings, context.robot, own_participant, context.logger, own_stop};
  Received<msg::WorldState> received{own_participant};
  Says<msg::Odometry> wheels_tell{own_participant};
  Says<msg::VisionFrame> camera_tells{own_participant};
  WorldStateNode node{own};
  const Running running{Executor::kListener, own_stop, {&node.node()}};
  wheels_tell.expect_reader();
  auto forged = vision(1);
  forged.t_exposure_ns = std::numeric_limits<std::int64_t>::max() / 2;
  forged.x_m = 100.0;
  camera_tells(forged);
  wheels_tell(odometry(1));
  EXPECT_NE(received.nth(1).x_m, 100.0);
  auto far_odometry = odometry(1);
  far_odometry.t_ns = std::numeric_limits<std::int64_t>::max() / 2;
  wheels_tell(far_odometry);  // no answer
  camera_tells(vision(2));
  wheels_tell(odometry(2));
  EXPECT_EQ(received.nth(2).t_ns, 2 * kCycle_ns);
  EXPECT_NEAR(received.nth(2).x_m, 1.0, 1e-9);
}

TEST_F(WorldStateNodeTest, JoinsOdometryVisionAndReferee) {
  for (const auto kind : {Executor::kListener, Executor::kWaitset}) {
    bus::Stop own_stop;
    const bus::Participant own_participant{bus::fresh_domain()};
    NodeContext own{context.settings, context.robot, own_participant, context.logger, own_stop};
    own.steady_ns = context.steady_ns;
    Received<msg::WorldState> received{own_participant};
    Says<msg::Odometry> wheels_tell{own_participant};
    Says<msg::VisionFrame> camera_tells{own_participant};
    Says<msg::Referee> referee_tells{own_participant};
    WorldStateNode node{own};
    const Running running{kind, own_stop, {&node.node()}};
    wheels_tell.expect_reader();
    referee_tells(referee());
    for (std::int64_t cycle = 1; cycle <= 5; ++cycle) {
      camera_tells(vision(cycle));
      wheels_tell(odometry(cycle));
      received.first(static_cast<std::size_t>(cycle));
    }
    const auto last = received.nth(5);
    EXPECT_EQ(last.robot_id, 1);
    EXPECT_EQ(last.seq, 5u);
    EXPECT_EQ(last.t_ns, 5 * kCycle_ns);
    EXPECT_TRUE(last.playing);
    EXPECT_EQ(last.half, 1);
    EXPECT_EQ(last.possession_id, 1u) << "its own count, not the referee's";
    EXPECT_NEAR(last.x_m, 1.0, 1e-9);
    EXPECT_NEAR(last.heading_rad, 0.5, 1e-9);
    EXPECT_TRUE(last.possession);
    EXPECT_NEAR(last.ball_x_m, 1.0 - 0.27 * std::sin(0.5), 1e-9);
  }
}

TEST_F(WorldStateNodeTest, WarnsOnceOfARobotThatPlaysBeyondTheFieldOfItsSettings) {
  WorldStateNode node{context};
  const Running running{Executor::kListener, stop, {&node.node()}};
  wheels_say.expect_reader();
  referee_permission(referee());
  for (std::int64_t second = 1; second <= 6; ++second) {
    auto frame = vision(50 * second);
    frame.y_m = -10.5;  // of the 18 x 12 m field
    frame.ball_seen = false;
    camera_says(frame);
    wheels_say(odometry(50 * second));
    world.first(static_cast<std::size_t>(second));
    EXPECT_EQ(log_lines->count("the robot has been outside the field of 18.0 x 12.0 m"), second < 3 ? 0u : 1u)
        << second;
  }
}

TEST_F(WorldStateNodeTest, WarnsOnceOfAGoalThatIsGivenForABallBesideTheGoalOfItsSettings) {
  WorldStateNode node{context};
  const Running running{Executor::kListener, stop, {&node.node()}};
  wheels_say.expect_reader();
  std::int64_t cycle = 0;
  const auto cycle_with = [&](double ball_y_m, std::uint8_t goals) {
    msg::Referee word = referee();
    word.goals_own = goals;
    word.playing = goals == 0;
    referee_permission(word);
    auto frame = vision(++cycle);
    frame.x_m = 3.0;  // of a goal 2 m wide at y = 9 m
    frame.y_m = 8.5;
    frame.heading_rad = 0.0;
    frame.ball_y_m = ball_y_m;
    camera_says(frame);
    wheels_say(odometry(cycle));
    world.first(static_cast<std::size_t>(cycle));
  };
  for (const double ball_y_m : {0.27, 0.3, 0.4, 0.6, 0.8}) cycle_with(ball_y_m, 0);
  EXPECT_EQ(log_lines->count("the referee gave a goal"), 0u);
  for (int i = 0; i < 3; ++i) cycle_with(0.8, 1);
  EXPECT_EQ(log_lines->count("the referee gave a goal, and the ball crossed the goal line at x = 3.0 m, outside the "
                             "goal of 2.0 m"),
            1u);
}

TEST_F(WorldStateNodeTest, WarnsOnceOfPlayThatNeverComesNearTheLinesOfItsSettings) {
  ASSERT_FALSE(context.settings.run.lockstep);
  WorldStateNode node{context};
  const Running running{Executor::kListener, stop, {&node.node()}};
  wheels_say.expect_reader();
  referee_permission(referee());
  constexpr std::int64_t kCyclesAMinute = 3000;
  for (std::int64_t minute = 0; minute <= 12; ++minute) {
    camera_says(vision(1 + kCyclesAMinute * minute));
    wheels_say(odometry(1 + kCyclesAMinute * minute));
    world.first(static_cast<std::size_t>(minute + 1));
    EXPECT_EQ(log_lines->count("in 10 min of play neither robot nor ball came farther than"), minute < 10 ? 0u : 1u)
        << minute;
  }
}

TEST_F(WorldStateNodeTest, WithoutCameraAndRefereeNobodyPlays) {
  WorldStateNode node{context};
  const Running running{Executor::kListener, stop, {&node.node()}};
  wheels_say.expect_reader();
  wheels_say(odometry(1));
  EXPECT_FALSE(world.nth(1).playing);
  EXPECT_FALSE(world.nth(1).ball_known);
}

TEST_F(WorldStateNodeTest, NobodyPlaysByTheWordOfARefereeWhoIsSilentOrGone) {
  std::optional<Says<msg::Referee>> another{std::in_place, participant};
  WorldStateNode node{context};
  const Running running{Executor::kListener, stop, {&node.node()}};
  wheels_say.expect_reader();
  referee_permission(referee());
  std::size_t cycle = 0;
  const auto playing_at = [&](std::int64_t now_ns) {
    clock_ns = now_ns;
    camera_says(vision(static_cast<std::int64_t>(++cycle)));
    wheels_say(odometry(static_cast<std::int64_t>(cycle)));
    return world.nth(cycle).playing;
  };
  EXPECT_TRUE(playing_at(1'000'000'000));
  EXPECT_FALSE(playing_at(1'000'000'001)) << "run.referee_timeout_s";
  EXPECT_TRUE(log_lines->wait_for("the referee is silent, its last command is of 1.00 s ago"));
  auto word = referee();
  word.t_ns = 5'000'000'000;
  referee_permission(word);
  EXPECT_TRUE(playing_at(5'000'000'000));
  EXPECT_TRUE(log_lines->wait_for("the referee is received again"));
  word.playing = false;
  referee_permission(word);
  EXPECT_FALSE(playing_at(5'000'000'000));
}

TEST_F(WorldStateNodeTest, ABallIsHeldNoLongerThanTheCameraSpeaks) {
  WorldStateNode node{context};
  const Running running{Executor::kListener, stop, {&node.node()}};
  wheels_say.expect_reader();
  referee_permission(referee());
  for (std::int64_t cycle = 1; cycle <= 5; ++cycle) {
    camera_says(vision(cycle));
    wheels_say(odometry(cycle));
    world.first(static_cast<std::size_t>(cycle));
  }
  EXPECT_TRUE(world.nth(5).possession);
  // possession_forget_s 0.15: 7.5 cycles; ball_forget_s 0.5: 25 cycles.
  wheels_say(odometry(12));
  EXPECT_TRUE(world.nth(6).possession);
  wheels_say(odometry(13));
  EXPECT_FALSE(world.nth(7).possession);
  EXPECT_TRUE(world.nth(7).ball_known);
  wheels_say(odometry(31));
  EXPECT_FALSE(world.nth(8).ball_known);
}

TEST_F(WorldStateNodeTest, AnotherRobotsSensorsAreNotItsOwn) {
  Says<msg::Odometry> other_wheels{participant, 2};
  Says<msg::VisionFrame> other_camera{participant, 2};
  WorldStateNode node{context};
  const Running running{Executor::kListener, stop, {&node.node()}};
  wheels_say.expect_reader();
  other_wheels.expect_reader();
  referee_permission(referee());
  other_camera(vision(1));
  other_wheels(odometry(1));
  wheels_say(odometry(2));
  EXPECT_EQ(world.nth(1).t_ns, 2 * kCycle_ns);
  EXPECT_FALSE(world.nth(1).playing) << "the other robot is localised, this one is not";
}

TEST_F(WorldStateNodeTest, OdometryThatIsNotFiniteStopsThePlayForThatCycleOnly) {
  WorldStateNode node{context};
  const Running running{Executor::kListener, stop, {&node.node()}};
  wheels_say.expect_reader();
  referee_permission(referee());
  camera_says(vision(1));
  wheels_say(odometry(1));
  EXPECT_TRUE(world.nth(1).playing);
  std::size_t n = 1;
  for (double msg::Odometry::*field : {&msg::Odometry::vy_mps, &msg::Odometry::x_m, &msg::Odometry::var_position_m2}) {
    auto broken = odometry(static_cast<std::int64_t>(++n));
    broken.*field = std::numeric_limits<double>::quiet_NaN();
    wheels_say(broken);
    EXPECT_FALSE(world.nth(n).playing);
    wheels_say(odometry(static_cast<std::int64_t>(++n)));
    const auto good = world.nth(n);
    EXPECT_TRUE(good.playing);
    EXPECT_TRUE(std::isfinite(good.vy_mps + good.x_m + good.sd_position_m));
  }
}

}  // namespace
}  // namespace trivela::nodes
