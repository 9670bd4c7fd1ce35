// Whose commands an odometry node gives its wheels.
#include <optional>
#include <vector>

#include "nodes/odometry/odometry_node.hpp"
#include "tests/nodes/node_fixture.hpp"

namespace trivela::nodes {
namespace {

using bus::Executor;

/// An odometry node in a mode, with what it hears and what it says.
class WhoDrivesTest : public NodeTest {
 protected:
  WhoDrivesTest() { clock_ns = 0; }

  void start(config::DriveMode mode) {
    context.settings.kick_decision.drive = mode;
    node.emplace(context, fake_wheels());
    running.emplace(Executor::kListener, stop, std::vector<bus::Node*>{&node->node()});
    drive.expect_reader();
    team.expect_reader();
    world.expect_reader();
  }

  /// What the robot believes from now on; kick_decision asks for 1 m/s, the team for 2 m/s.
  void believe(bool playing, bool possession) {
    msg::WorldState state{};
    state.t_ns = clock_ns;
    state.playing = playing;
    state.possession = possession;
    world(state);
  }
  void propose() {
    msg::DriveCommand command{};
    command.t_ns = clock_ns;
    command.vy_mps = 1.0;
    drive(command);
  }
  void team_says(std::int64_t said_ns) {
    msg::TeamDrive command{};
    command.t_ns = said_ns;
    command.vy_mps = 2.0;
    team(command);
  }

  /// The forward speeds that the wheels were told, once there are n.
  std::vector<double> speeds(std::size_t n) {
    std::vector<double> out;
    for (const auto& command : wheels->commands(n)) out.push_back(command.twist.vy_mps);
    return out;
  }
  void turn_wheels() {
    wheels->put({.t_ns = t_ns += 20'000'000, .wheel_count = 3, .wheel_radps = {1.0, -1.0, 0.5}, .gyro_radps = {}});
  }
  /// Whose command the next odometry names.
  msg::DriveSource obeyed() {
    turn_wheels();
    return odometry.nth(++samples).obeyed;
  }

  Received<msg::Odometry> odometry{participant};
  Says<msg::DriveCommand> drive{participant};
  Says<msg::TeamDrive> team{participant};
  Says<msg::WorldState> world{participant};
  std::optional<OdometryNode> node;
  std::optional<Running> running;
  std::size_t samples = 0;
  std::int64_t t_ns = 0;
};

TEST_F(WhoDrivesTest, WithAdviceTheTeamAloneMovesTheRobot) {
  start(config::DriveMode::kAdvice);
  believe(true, true);
  propose();
  EXPECT_EQ(speeds(1), (std::vector{0.0})) << "each proposal is answered by standstill";
  EXPECT_EQ(obeyed(), msg::DRIVE_NOBODY);
  team_says(clock_ns);
  EXPECT_EQ(speeds(2), (std::vector{0.0, 2.0}));
  EXPECT_EQ(obeyed(), msg::DRIVE_TEAM);
  clock_ns += 200'000'001;
  propose();
  EXPECT_EQ(speeds(3), (std::vector{0.0, 2.0, 0.0})) << "of a silent team the robot stands, proposed or not";
  EXPECT_EQ(obeyed(), msg::DRIVE_NOBODY);
  EXPECT_TRUE(log_lines->wait_for("no drive command for 0.20 s: the base stops"));
}

TEST_F(WhoDrivesTest, WithTheBallInTheHandlerKickDecisionTakesOverFromTheTeamAndGivesBack) {
  start(config::DriveMode::kWithBall);
  believe(true, false);
  propose();
  team_says(clock_ns);
  EXPECT_EQ(speeds(2), (std::vector{0.0, 2.0}));
  EXPECT_EQ(obeyed(), msg::DRIVE_TEAM);
  believe(true, true);
  EXPECT_EQ(speeds(3).back(), 1.0) << "what it said last";
  EXPECT_EQ(obeyed(), msg::DRIVE_KICK_DECISION);
  team_says(clock_ns);
  believe(true, false);
  EXPECT_EQ(speeds(4), (std::vector{0.0, 2.0, 1.0, 2.0})) << "the team's word changed nothing meanwhile";
  EXPECT_EQ(obeyed(), msg::DRIVE_TEAM);
}

TEST_F(WhoDrivesTest, WhileTheGameStandsTheTeamPlacesItsRobotInEveryMode) {
  start(config::DriveMode::kAlways);
  believe(false, true);
  propose();
  EXPECT_EQ(speeds(1), (std::vector{1.0})) << "without a word of the team's";
  team_says(clock_ns);
  EXPECT_EQ(speeds(2), (std::vector{1.0, 2.0}));
  EXPECT_EQ(obeyed(), msg::DRIVE_TEAM);
  believe(true, true);
  propose();
  EXPECT_EQ(speeds(3).back(), 1.0) << "the game is on again";
  EXPECT_EQ(obeyed(), msg::DRIVE_KICK_DECISION);
}

TEST_F(WhoDrivesTest, ATeamsCommandThatWaitedIsNotObeyed) {
  start(config::DriveMode::kAdvice);
  clock_ns = 1'000'000'000;
  team_says(799'999'999);
  EXPECT_TRUE(log_lines->wait_for("team_drive of t 799999999 ns is 0.20 s old: not obeyed"));
  team_says(clock_ns);
  EXPECT_EQ(speeds(1), (std::vector{2.0}));
}

TEST_F(WhoDrivesTest, ATeamThatFallsSilentStopsTheBaseWhetherOrNotItsWheelsSpeak) {
  context.settings.odometry.team_drive_timeout_s = 0.5;
  start(config::DriveMode::kAdvice);
  team_says(clock_ns);
  clock_ns = 500'000'000;
  EXPECT_EQ(obeyed(), msg::DRIVE_TEAM);
  clock_ns = 500'000'001;
  EXPECT_EQ(speeds(2), (std::vector{2.0, 0.0}));
}

TEST_F(WhoDrivesTest, InLockstepTheBeliefOfTheCycleDecides) {
  context.settings.run.lockstep = true;
  context.settings.kick_decision.drive = config::DriveMode::kWithBall;
  bus::Reader<msg::Odometry> recorder{participant};
  Received<msg::StepDone> done{participant};
  node.emplace(context, fake_wheels());
  running.emplace(Executor::kWaitset, stop, std::vector<bus::Node*>{&node->node()});
  drive.expect_reader();
  world.expect_reader();
  for (std::size_t cycle = 1; cycle <= 3; ++cycle) {
    turn_wheels();
    EXPECT_EQ(odometry.nth(cycle).obeyed, cycle == 3 ? msg::DRIVE_KICK_DECISION : msg::DRIVE_NOBODY);
    clock_ns = t_ns;
    propose();  // which comes before the belief that it answers
    believe(true, cycle == 2);
    EXPECT_EQ(done.nth(cycle).t_ns, clock_ns);
    const auto told = wheels->commands(cycle);
    ASSERT_EQ(told.size(), cycle) << "the simulator waits for a command of its cycle";
    EXPECT_EQ(told.back().t_ns, clock_ns);
    EXPECT_EQ(told.back().twist.vy_mps, cycle == 2 ? 1.0 : 0.0);
  }
}

}  // namespace
}  // namespace trivela::nodes
