#include "nodes/shot_observer/shot_observer_node.hpp"

#include <chrono>
#include <cmath>
#include <fstream>

#include "config/kicker_state.hpp"
#include "tests/nodes/node_fixture.hpp"
#include "tests/robot/flown_shot.hpp"
#include "tests/support/folder.hpp"

namespace trivela::nodes {
namespace {

using bus::Executor;

class ShotObserverNodeTest : public NodeTest {
 protected:
  void start() {
    node.emplace(context);
    running.emplace(Executor::kListener, stop, std::vector<bus::Node*>{&node->node()});
    camera.expect_reader();
    receipt.expect_reader();
    play(true, 0);
  }
  void play(bool playing, std::int64_t t_ns) {
    msg::Referee word{};
    word.t_ns = t_ns;
    word.playing = playing;
    referee(word);
  }
  void kicked(std::int64_t kick_id, const robot::FlownShot& shot, bool accepted = true) {
    msg::KickReceipt out{};
    out.kick_id = kick_id;
    out.accepted = accepted;
    out.refusal = accepted ? msg::REFUSAL_NONE : msg::REFUSAL_CHARGING;
    out.release_t_ns = accepted ? shot.release_t_ns : 0;
    out.power = accepted ? 25.0 : 0.0;
    receipt(out);
  }
  void show(const robot::FlownShot::Frame& seen) {
    msg::FlightFrame out{};
    out.t_exposure_ns = seen.t_ns;
    out.t_ns = seen.t_ns + 40'000'000;
    out.ball_seen = seen.ball_m.has_value();
    out.ball_x_m = seen.ball_m ? seen.ball_m->x() : std::nan("");
    out.ball_y_m = seen.ball_m ? seen.ball_m->y() : std::nan("");
    out.ball_z_m = seen.ball_m ? seen.ball_m->z() : std::nan("");
    camera(out);
  }
  void show(const robot::FlownShot& shot) {
    for (const auto& frame : shot.frames) show(frame);
  }

  const robot::FlownShot in_goal = robot::fly(robot::aimed(0.3, 0.5), robot::airless());
  Received<msg::KickOutcome> outcome{participant};
  Says<msg::FlightFrame> camera{participant};
  Says<msg::KickReceipt> receipt{participant};
  Says<msg::Referee> referee{participant};
  std::optional<ShotObserverNode> node;
  std::optional<Running> running;
};

TEST_F(ShotObserverNodeTest, SaysWhatBecameOfAKick) {
  start();
  kicked(11, in_goal);
  show(in_goal);
  const auto said = outcome.nth(1);
  EXPECT_EQ(said.robot_id, 1);
  EXPECT_EQ(said.seq, 1u);
  EXPECT_EQ(said.kick_id, 11);
  EXPECT_EQ(said.outcome, msg::OUTCOME_ON_TARGET);
  EXPECT_GT(said.p_on_target, 0.95);
  EXPECT_LE(said.p_on_target + said.p_wide_left + said.p_wide_right + said.p_over + said.p_short + said.p_post +
                said.p_bar + said.p_blocked,
            1.0 + 1e-12);
  EXPECT_NEAR(said.residual_sd_m, 0.03, 0.01);
  EXPECT_FALSE(said.bounced);
  EXPECT_TRUE(said.on_target);
  EXPECT_NEAR(said.x_cross_m, 0.3, 5.0 * said.sd_cross_m);
  EXPECT_NEAR(said.z_cross_m, 0.5, 5.0 * said.sd_cross_m);
  EXPECT_GT(said.observations, 20u);
  EXPECT_GT(said.t_ns, in_goal.truth.t_ns);
  EXPECT_NEAR(said.exit_speed_mps, 7.6, 1.0);
  EXPECT_NEAR(said.exit_elevation_rad, 0.61, 0.1);
  EXPECT_NEAR(said.release_late_s, 0.0, 0.02);
  EXPECT_TRUE(log_lines->wait_for("kick 11: on_target"));
}

/// What the robot's own decision and the receipt say of the kick of `shot`.
class LearningObserverTest : public ShotObserverNodeTest {
 protected:
  void decided(std::int64_t kick_id, const robot::FlownShot& shot) {
    msg::KickDecision out{};
    out.fire = true;
    out.kick_id = kick_id;
    out.t_ns = shot.release_t_ns - 60'000'000;
    out.y_m = 4.0 - context.robot.model.ball_offset_m;
    decision(out);
  }
  Received<msg::KickerEstimate> estimate{participant};
  Says<msg::KickDecision> decision{participant};
  tests::Folder folder;
};

TEST_F(LearningObserverTest, SaysWhatAFlightShowsOfTheKicker) {
  start();
  decision.expect_reader();
  const auto first = estimate.nth(1);
  EXPECT_EQ(first.robot_id, 1);
  EXPECT_EQ(first.seq, 1u);
  EXPECT_EQ(first.kicks, 0u);
  EXPECT_FALSE(first.used) << "a shadow, unless the team switches it on";
  decided(11, in_goal);
  kicked(11, in_goal);
  show(in_goal);
  const auto learned = estimate.nth(2);
  EXPECT_EQ(learned.seq, 2u);
  EXPECT_EQ(learned.kick_id, 11);
  EXPECT_EQ(learned.kicks, 1u);
  EXPECT_LT(learned.speed_ln_se, first.speed_ln_se);
  // A witness of its own: the ball of `aimed(0.3, 0.5)` leaves with this speed, whatever the table says.
  const auto kick = robot::aimed(0.3, 0.5);
  EXPECT_NEAR(outcome.nth(1).flight_speed_mps, kick.velocity_mps.norm(), 0.15);
  EXPECT_NEAR(outcome.nth(1).flight_direction_rad, std::atan2(-kick.velocity_mps.x(), kick.velocity_mps.y()), 0.01);
  const double too_fast = kick.velocity_mps.norm() / context.robot.model.table.speed_for(25.0);
  EXPECT_EQ(learned.speed_ln > 0.0, too_fast > 1.0);
}

TEST_F(LearningObserverTest, OffItSaysNothingOfTheKicker) {
  context.settings.self_calibration.mode = config::SelfCalibrationMode::kOff;
  start();
  decision.expect_reader();
  decided(11, in_goal);
  kicked(11, in_goal);
  show(in_goal);
  EXPECT_EQ(outcome.nth(1).kick_id, 11);
  EXPECT_TRUE(estimate.now().empty());
}

TEST_F(LearningObserverTest, LeavesAStateForTheNextMatch) {
  const std::string file = context.settings.self_calibration.state_file = (folder / "kicker.toml").string();
  start();
  decision.expect_reader();
  decided(11, in_goal);
  kicked(11, in_goal);
  show(in_goal);
  const auto learned = estimate.nth(2);
  stop.request();
  running.reset();
  const auto state = config::load_kicker_state(file, context.robot, 1, 1.0, std::chrono::system_clock::now());
  ASSERT_TRUE(state);
  EXPECT_NEAR(state->mean[kicking::kSpeedPart], learned.speed_ln, 1e-12);
}

TEST_F(LearningObserverTest, BeginsWithTheStateOfAnEarlierMatch) {
  const std::string file = context.settings.self_calibration.state_file = (folder / "kicker.toml").string();
  kicking::KickerEstimate earlier;
  earlier.mean[kicking::kSpeedPart] = 0.08;
  earlier.se.setConstant(0.01);
  config::save_kicker_state(file, earlier, context.robot, 1, std::chrono::system_clock::now());
  start();
  const auto first = estimate.nth(1);
  EXPECT_EQ(first.kicks, 0u);
  EXPECT_NEAR(first.speed_ln, 0.08, 1e-12);
  EXPECT_GT(first.speed_ln_se, 0.01) << "a kicker changes from day to day";
}

TEST_F(LearningObserverTest, AStateOfAnotherRobotIsRefusedAndTheMatchGoesOn) {
  context.settings.self_calibration.state_file = (folder / "kicker.toml").string();
  std::ofstream(folder / "kicker.toml") << "robot = \"somebody\"\nrobot_id = 4\n";
  start();
  EXPECT_EQ(estimate.nth(1).speed_ln, 0.0);
  EXPECT_TRUE(log_lines->wait_for("self-calibration begins with the robot's file"));
  EXPECT_TRUE(log_lines->wait_for("kicker.toml is now "));
  std::ifstream aside(folder / "kicker.toml.refused");
  std::string line;
  ASSERT_TRUE(std::getline(aside, line)) << "no estimate of this robot is written over another one's";
  EXPECT_EQ(line, "robot = \"somebody\"");
}

TEST_F(ShotObserverNodeTest, AMissIsNotOnTarget) {
  start();
  const auto wide = robot::fly(robot::aimed(-2.0, 0.5), robot::airless());
  kicked(12, wide);
  show(wide);
  EXPECT_EQ(outcome.nth(1).outcome, msg::OUTCOME_WIDE_LEFT);
  EXPECT_FALSE(outcome.nth(1).on_target);
}

TEST_F(ShotObserverNodeTest, ARefusedOrderHasNoOutcome) {
  start();
  kicked(1, in_goal, false);
  show(in_goal);
  EXPECT_TRUE(outcome.now().empty());
}

TEST_F(ShotObserverNodeTest, AShotWithoutNumbersIsToldWithNaN) {
  start();
  auto unseen = in_goal;
  for (auto& frame : unseen.frames) frame.ball_m.reset();
  kicked(3, unseen);
  show(unseen);
  const auto said = outcome.nth(1);
  EXPECT_EQ(said.outcome, msg::OUTCOME_UNKNOWN);
  for (const double number :
       {said.x_cross_m, said.z_cross_m, said.sd_cross_m, said.exit_speed_mps, said.exit_elevation_rad, said.p_on_target,
        said.p_blocked, said.residual_sd_m, said.release_late_s})
    EXPECT_TRUE(std::isnan(number));
}

TEST_F(ShotObserverNodeTest, TheRefereesStopSettlesAnOpenShot) {
  start();
  kicked(4, in_goal);
  const std::int64_t stop_t_ns = in_goal.release_t_ns + 400'000'000;
  for (const auto& frame : in_goal.frames) {
    if (frame.t_ns > stop_t_ns && outcome.now().empty()) play(false, stop_t_ns);
    show(frame);
  }
  const auto said = outcome.nth(1);
  EXPECT_EQ(said.kick_id, 4);
  EXPECT_EQ(said.outcome, msg::OUTCOME_UNKNOWN) << "it flew freely: nothing was seen that stopped it";
  EXPECT_EQ(outcome.now().size(), 1u);
}

// The camera shows the past: frames exposed before the stop still belong to the shot.
TEST_F(ShotObserverNodeTest, FramesThatAreOlderThanTheStopStillCount) {
  start();
  kicked(5, in_goal);
  bool stopped = false;
  for (const auto& frame : in_goal.frames) {
    if (!stopped && frame.t_ns > in_goal.truth.t_ns - 50'000'000) play(false, in_goal.truth.t_ns + 100'000'000);
    stopped = stopped || frame.t_ns > in_goal.truth.t_ns - 50'000'000;
    show(frame);
  }
  EXPECT_EQ(outcome.nth(1).outcome, msg::OUTCOME_ON_TARGET);
}

}  // namespace
}  // namespace trivela::nodes
