#include "nodes/odometry/odometry_node.hpp"

#include <cmath>
#include <limits>

#include "tests/instants.hpp"
#include "tests/nodes/node_fixture.hpp"
#include "tests/robot/wheel_speeds.hpp"

namespace trivela::nodes {
namespace {

using bus::Executor;
using kicking::Twist;

class OdometryNodeTest : public NodeTest {
 protected:
  OdometryNodeTest() { clock_ns = 0; }

  hal::WheelSample sample(const Twist& twist) {
    hal::WheelSample out{
        .t_ns = t_ns += kCycle_ns, .wheel_count = 3, .wheel_radps = {}, .gyro_radps = twist.omega_radps};
    const auto speeds = robot::wheel_speeds_radps(context.robot.base, twist);
    std::copy(speeds.begin(), speeds.end(), out.wheel_radps.begin());
    return out;
  }

  std::int64_t t_ns = 0;
};

TEST_F(OdometryNodeTest, TurnsWheelSamplesIntoOdometry) {
  Received<msg::Odometry> odometry{participant};
  OdometryNode node{context, fake_wheels()};
  const Running running{Executor::kListener, stop, {&node.node()}};
  for (int i = 0; i < 3; ++i) wheels->put(sample({0.0, 1.0, 0.5}));
  odometry.first(3);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& out = odometry.now()[i];
    EXPECT_EQ(out.robot_id, 1);
    EXPECT_EQ(out.seq, i + 1);
    EXPECT_EQ(out.t_ns, static_cast<std::int64_t>(i + 1) * kCycle_ns);
    EXPECT_NEAR(out.vy_mps, 1.0, 1e-9);
    EXPECT_NEAR(out.omega_radps, 0.5, 1e-9);
    EXPECT_NEAR(out.heading_rad, 0.01 * static_cast<double>(i), 1e-9);
    EXPECT_EQ(out.wheel_1_radps, robot::wheel_speeds_radps(context.robot.base, {0.0, 1.0, 0.5})[1]);
    EXPECT_TRUE(std::isnan(out.wheel_3_radps)) << "there is no fourth wheel";
    EXPECT_EQ(out.gyro_radps, 0.5);
  }
}

TEST_F(OdometryNodeTest, SaysOnceWhatIsEmulated) {
  Received<msg::DeviceEmulated> emulated{participant};
  Received<msg::Odometry> odometry{participant};
  OdometryNode node{context, fake_wheels()};
  const Running running{Executor::kListener, stop, {&node.node()}};
  wheels->put(sample({}));
  odometry.first(1);
  EXPECT_TRUE(emulated.now().empty());
  hal::WheelSample said = sample({});
  said.gyro_emulated = true;
  wheels->put(said);
  said.t_ns = t_ns += kCycle_ns;
  said.emulated = true;
  wheels->put(said);
  wheels->put(sample({}));
  odometry.first(4);
  ASSERT_EQ(emulated.first(2).size(), 2u);
  EXPECT_EQ(emulated.nth(1).part, msg::PART_GYRO);
  EXPECT_EQ(emulated.nth(2).part, msg::PART_WHEELS);
  EXPECT_EQ(emulated.nth(2).robot_id, 1);
  EXPECT_EQ(emulated.nth(2).seq, 2u);
}

TEST_F(OdometryNodeTest, PassesDriveCommandsOnAndThoseOfItsRobotOnly) {
  for (const auto kind : {Executor::kListener, Executor::kWaitset}) {
    bus::Stop own_stop;
    NodeContext own{context.settings, context.robot, participant, context.logger, own_stop};
    own.steady_ns = context.steady_ns;
    const auto far_side = std::make_shared<WheelsFarSide>();
    Says<msg::DriveCommand> other{participant, 2}, drive{participant};
    OdometryNode node{own, std::make_unique<FakeWheels>(far_side)};
    const Running running{kind, own_stop, {&node.node()}};
    other.expect_reader();
    drive.expect_reader();
    msg::DriveCommand command{};
    command.vx_mps = 9.0;
    other(command);
    command.t_ns = 77;
    command.vx_mps = 0.1;
    command.vy_mps = 0.2;
    command.omega_radps = 0.3;
    drive(command);
    const auto driven = far_side->commands(1);
    ASSERT_EQ(driven.size(), 1u);
    EXPECT_EQ(driven[0].twist.vx_mps, 0.1);
    EXPECT_EQ(driven[0].twist.vy_mps, 0.2);
    EXPECT_EQ(driven[0].twist.omega_radps, 0.3);
    EXPECT_EQ(driven[0].t_ns, 77);
  }
}

TEST_F(OdometryNodeTest, BrokenWheelSamplesAreReportedAndDoNotKillIt) {
  Received<msg::Odometry> odometry{participant};
  OdometryNode node{context, fake_wheels()};
  const Running running{Executor::kListener, stop, {&node.node()}};
  wheels->put(sample({0.0, 1.0, 0.0}));
  auto broken = sample({0.0, 1.0, 0.0});
  broken.wheel_radps[1] = std::numeric_limits<double>::quiet_NaN();
  wheels->put(broken);
  auto poor = sample({0.0, 1.0, 0.0});
  poor.wheel_count = 2;
  wheels->put(poor);
  auto old = sample({0.0, 1.0, 0.0});
  old.t_ns = 1;
  wheels->put(old);
  auto deaf = sample({0.0, 1.0, 0.0});
  deaf.gyro_radps = std::numeric_limits<double>::quiet_NaN();
  wheels->put(deaf);
  const auto good = odometry.nth(2);
  EXPECT_EQ(good.seq, 2u) << "what was never sent leaves no gap";
  EXPECT_EQ(good.t_ns, deaf.t_ns) << "without a gyro the wheels do";
  EXPECT_NEAR(good.y_m, 0.08, 1e-9);
  EXPECT_TRUE(log_lines->wait_for("wheel sample of t 40000000 ns is unusable"));
}

TEST_F(OdometryNodeTest, ABaseThatNobodyDrivesAnyMoreStopsWhetherOrNotItsWheelsSpeak) {
  Received<msg::Odometry> odometry{participant};
  Says<msg::DriveCommand> drive{participant};
  OdometryNode node{context, fake_wheels()};
  const Running running{Executor::kListener, stop, {&node.node()}};
  drive.expect_reader();
  msg::DriveCommand command{};
  command.vy_mps = 1.0;
  drive(command);
  ASSERT_EQ(wheels->commands(1).size(), 1u);
  clock_ns = 200'000'000;
  wheels->put(sample({0.0, 1.0, 0.0}));
  odometry.first(1);
  EXPECT_EQ(wheels->commanded(), 1u) << "for drive_timeout_s it may go on";
  clock_ns = 200'000'001;  // and no sample comes
  auto driven = wheels->commands(2);
  ASSERT_EQ(driven.size(), 2u);
  EXPECT_EQ(driven[1].twist.vy_mps, 0.0);
  EXPECT_TRUE(log_lines->wait_for("the base stops"));
  command.t_ns = clock_ns;
  drive(command);
  driven = wheels->commands(3);
  ASSERT_EQ(driven.size(), 3u);
  EXPECT_EQ(driven[2].twist.vy_mps, 1.0) << "driven again";
}

TEST_F(OdometryNodeTest, ACommandThatWaitedIsNotDriven) {
  clock_ns = 1'000'000'000;
  Says<msg::DriveCommand> drive{participant};
  OdometryNode node{context, fake_wheels()};
  const Running running{Executor::kListener, stop, {&node.node()}};
  drive.expect_reader();
  for (const std::int64_t said_ns : {std::int64_t{799'999'999}, std::int64_t{0}, std::int64_t{1'000'000'000}}) {
    msg::DriveCommand command{};
    command.t_ns = said_ns;
    command.vy_mps = 1.0;
    drive(command);
  }
  const auto driven = wheels->commands(1);
  ASSERT_EQ(driven.size(), 1u);
  EXPECT_EQ(driven[0].t_ns, 1'000'000'000);
}

TEST_F(OdometryNodeTest, InLockstepTheNextSampleWaitsForTheDriveCommand) {
  context.settings.run.lockstep = true;
  Received<msg::Odometry> odometry{participant};
  bus::Reader<msg::Odometry> recorder{participant};
  Received<msg::StepDone> done{participant};
  Says<msg::DriveCommand> drive{participant};
  OdometryNode node{context, fake_wheels()};
  const Running running{Executor::kWaitset, stop, {&node.node()}};
  drive.expect_reader();
  for (int i = 0; i < 3; ++i) wheels->put(sample({0.0, 1.0, 0.0}));
  for (std::size_t cycle = 1; cycle <= 3; ++cycle) {
    EXPECT_EQ(odometry.nth(cycle).t_ns, static_cast<std::int64_t>(cycle) * kCycle_ns);
    EXPECT_EQ(wheels->unread(), 3 - cycle);
    msg::DriveCommand command{};
    command.t_ns = static_cast<std::int64_t>(cycle) * kCycle_ns;
    drive(command);
    EXPECT_EQ(done.nth(cycle).t_ns, command.t_ns);
    EXPECT_EQ(done.nth(cycle).node, msg::STEP_ODOMETRY);
  }
}

}  // namespace
}  // namespace trivela::nodes
