// The nodes as programs: what their users and `trivela match` rely on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <poll.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include "bus/domain/process.hpp"
#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "log/read/reader.hpp"
#include "tests/bus/test_domain.hpp"
#include "tests/nodes/notify_socket.hpp"
#include "tests/nodes/spawned.hpp"
#include "tests/support/folder.hpp"

namespace trivela::nodes {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::chrono::seconds kPlenty{30};

class NodeProgramTest : public testing::Test {
 protected:
  NodeProgramTest() { write_config(""); }

  std::filesystem::path write_config(const std::string& more) {
    std::ofstream{folder / "node.toml"} << "[domain]\ndomain_id = 17\ntag = \"" << tag << "\"\n"
                                        << "[recorder]\nlog = \"" << (folder / "out.db").string() << "\"\n"
                                        << "[run]\nrobot = \"" TRIVELA_SOURCE_DIR "/config/robots/cambada_1.toml\"\n"
                                        << "scenario = \"" TRIVELA_SOURCE_DIR "/config/scenarios/default.toml\"\n"
                                        << more;
    return folder / "node.toml";
  }
  static std::string program(const std::string& name) { return TRIVELA_BINARY_DIR "/trivela-" + name; }
  std::vector<std::string> arguments() const { return {"--config", (folder / "node.toml").string()}; }

  /// Starts a node, waits until it is in the domain, and expects SIGTERM to end it well.
  template <class T>
  void expect_clean_end(const std::string& name, int signal = SIGTERM) {
    SCOPED_TRACE(name);
    bus::Writer<T> writer{participant};
    Spawned node{program(name), arguments()};
    ASSERT_TRUE(writer.wait_for_readers(1, kPlenty)) << node.said();
    node.send(signal);
    EXPECT_EQ(node.exit_code(), 0) << node.said();
    EXPECT_THAT(node.said(), AllOf(HasSubstr("robot 1 (cambada_1) in domain 17"), HasSubstr("stopped")));
  }

  tests::Folder folder;
  std::string tag = "program-test-" + std::to_string(getpid());
  bus::Participant participant{bus::loopback(17, tag)};
};

TEST_F(NodeProgramTest, SigtermEndsOdometry) { expect_clean_end<msg::DriveCommand>("odometry"); }
TEST_F(NodeProgramTest, SigtermEndsWorldState) { expect_clean_end<msg::Odometry>("world_state"); }
TEST_F(NodeProgramTest, SigtermEndsKickDecision) { expect_clean_end<msg::WorldState>("kick_decision"); }
TEST_F(NodeProgramTest, SigtermEndsTheKickerDriver) { expect_clean_end<msg::KickOrder>("kicker_driver"); }
TEST_F(NodeProgramTest, SigtermEndsTheShotObserver) { expect_clean_end<msg::FlightFrame>("shot_observer"); }
TEST_F(NodeProgramTest, SigtermEndsTheSimulator) { expect_clean_end<msg::DeviceDrive>("simulator"); }
TEST_F(NodeProgramTest, SigintDoesTheSame) { expect_clean_end<msg::Odometry>("world_state", SIGINT); }

TEST_F(NodeProgramTest, EveryKindOfNodeTellsItsSupervisorThatItLives) {
  for (const std::string name : {"odometry", "world_state", "kick_decision", "kicker_driver", "shot_observer",
                                 "kicker_drift", "recorder", "simulator"}) {
    SCOPED_TRACE(name);
    const std::string path = (folder / ("notify-" + name)).string();
    NotifySocket manager{path};
    setenv("NOTIFY_SOCKET", path.c_str(), 1);
    setenv("WATCHDOG_USEC", "400000", 1);
    Spawned node{program(name), arguments()};
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    EXPECT_EQ(manager.next(kPlenty), "READY=1");
    EXPECT_EQ(manager.next(kPlenty), "WATCHDOG=1");
    node.send(SIGTERM);
    EXPECT_EQ(node.exit_code(), 0) << node.said();
  }
}

TEST_F(NodeProgramTest, OfTwoDriversThatStartTogetherOneStays) {
  for (int i = 0; i < 8; ++i) {
    bus::Writer<msg::KickOrder> writer{participant};
    Spawned one{program("kicker_driver"), arguments()}, other{program("kicker_driver"), arguments()};
    std::array<pollfd, 2> ends{{{one.end(), POLLIN, 0}, {other.end(), POLLIN, 0}}};
    ASSERT_GT(poll(ends.data(), ends.size(), 30'000), 0) << "neither has ended";
    Spawned& ended = ends[0].revents != 0 ? one : other;
    Spawned& stays = ends[0].revents != 0 ? other : one;
    EXPECT_EQ(ended.exit_code(), 1);
    EXPECT_THAT(ended.said(), HasSubstr("another kicker_driver of robot 1"));
    ASSERT_TRUE(writer.wait_for_readers(1, kPlenty)) << stays.said();
    stays.send(SIGTERM);
    EXPECT_EQ(stays.exit_code(), 0) << stays.said();
  }
}

TEST_F(NodeProgramTest, SigtermEndsTheRecorderWithAFinalisedLog) {
  bus::Writer<msg::KickTruth> writer{participant};
  Spawned node{program("recorder"), arguments()};
  ASSERT_TRUE(writer.wait_for_readers(1, kPlenty)) << node.said();
  node.send(SIGTERM);
  EXPECT_EQ(node.exit_code(), 0) << node.said();
  EXPECT_THAT(node.said(), HasSubstr("recorded 0 rows"));
  const log::Reader log{folder / "out.db"};
  ASSERT_EQ(log.sessions().size(), 1u);
  EXPECT_TRUE(log.sessions()[0].closed_t_ns);
}

TEST_F(NodeProgramTest, OneThatTakesMoreMemoryThanItMayEndsByItself) {
  for (const std::string name : {"world_state", "recorder"}) {
    SCOPED_TRACE(name);
    Spawned node{program(name), {"--config", (folder / "node.toml").string(), "--set", "run.memory_limit_mb=8"}};
    EXPECT_EQ(node.exit_code(), 1);
    EXPECT_THAT(node.said(), HasSubstr("more than run.memory_limit_mb = 8: ends, to be started again"));
  }
  const log::Reader log{folder / "out.db"};
  ASSERT_EQ(log.sessions().size(), 1u);
  EXPECT_TRUE(log.sessions()[0].closed_t_ns) << "it ends as it does when told to";
}

TEST_F(NodeProgramTest, TheRecorderStartsWithARobotsOwnFileThatNamesNoWorld) {
  std::ofstream{folder / "robot.toml"} << "[domain]\ndomain_id = 17\ntag = \"" << tag << "\"\n[recorder]\nlog = \""
                                       << (folder / "out.db").string()
                                       << "\"\n[run]\nrobot_id = 3\n[hal]\nwheels = \"bus\"\n";
  bus::Writer<msg::KickTruth> writer{participant};
  Spawned node{program("recorder"), {"--config", (folder / "robot.toml").string()}};
  ASSERT_TRUE(writer.wait_for_readers(1, kPlenty)) << node.said();
  node.send(SIGTERM);
  EXPECT_EQ(node.exit_code(), 0) << node.said();
}

TEST_F(NodeProgramTest, OdometryOutlivesWheelSamplesThatAreNotNumbers) {
  bus::Writer<msg::DeviceWheels> wheels{participant};
  bus::Reader<msg::Odometry> odometry{participant};
  Spawned node{program("odometry"), arguments()};
  ASSERT_TRUE(wheels.wait_for_readers(1, kPlenty)) << node.said();
  ASSERT_TRUE(odometry.wait_for_writers(1, kPlenty));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  wheels.write({.robot_id = 1,
                .seq = 1,
                .t_ns = 20,
                .wheel_count = 3,
                .wheel_radps = {nan, 1, 1},
                .gyro_radps = nan,
                .emulated = false});
  ASSERT_TRUE(node.says("wheel sample of t 20 ns is unusable")) << node.said();
  wheels.write({.robot_id = 1,
                .seq = 2,
                .t_ns = 40,
                .wheel_count = 3,
                .wheel_radps = {1, 1, 1},
                .gyro_radps = nan,
                .emulated = false});
  ASSERT_TRUE(odometry.wait(kPlenty)) << node.said();
  std::int64_t t_ns = 0;
  odometry.take([&](const msg::Odometry& sample) { t_ns = sample.t_ns; });
  EXPECT_EQ(t_ns, 40);
  node.send(SIGTERM);
  EXPECT_EQ(node.exit_code(), 0);
}

TEST_F(NodeProgramTest, WhatRealTimeIsRefusedIsSaidAndTheNodeGoesOn) {
  std::vector<std::string> words{"--memlock=0", "--rtprio=0", program("world_state")};
  if (geteuid() == 0) words.insert(words.begin() + 2, {"setpriv", "--bounding-set", "-sys_nice,-ipc_lock"});
  for (const std::string& argument : arguments()) words.push_back(argument);
  words.insert(words.end(), {"--realtime", "10"});
  bus::Writer<msg::Odometry> writer{participant};
  Spawned node{"/usr/bin/prlimit", words};
  ASSERT_TRUE(writer.wait_for_readers(1, kPlenty)) << node.said();
  ASSERT_TRUE(node.says("robot 1 (cambada_1)")) << node.said();
  EXPECT_THAT(node.said(), HasSubstr("real-time scheduling was not permitted"));
#ifndef TRIVELA_SANITIZE  // the address sanitizer answers mlockall() itself, and says yes
  EXPECT_THAT(node.said(), HasSubstr("memory could not be locked"));
#endif
  node.send(SIGTERM);
  EXPECT_EQ(node.exit_code(), 0) << node.said();
}

TEST_F(NodeProgramTest, ANodeRunsOnTheProcessorThatItIsToldAndOnNoneThatIsNotThere) {
  const std::vector<int> processors = bus::processors_allowed();
  auto words = arguments();
  words.insert(words.end(), {"--processor", std::to_string(processors.back())});
  bus::Writer<msg::Odometry> writer{participant};
  Spawned node{program("world_state"), words};
  ASSERT_TRUE(writer.wait_for_readers(1, kPlenty)) << node.said();
  int threads = 0;
  for (const auto& task : std::filesystem::directory_iterator(fmt::format("/proc/{}/task", node.pid()))) {
    std::ifstream in{task.path() / "status"};
    const std::string status{std::istreambuf_iterator<char>{in}, {}};
    EXPECT_THAT(status, HasSubstr(fmt::format("Cpus_allowed_list:\t{}\n", processors.back())));
    ++threads;
  }
  EXPECT_GT(threads, 1);

  words.back() = "4095";
  Spawned nowhere{program("world_state"), words};
  EXPECT_EQ(nowhere.exit_code(), 1);
  EXPECT_THAT(nowhere.said(), HasSubstr(fmt::format("(processor 4095): this process may use {}", processors.front())));
  words.back() = "-1";
  EXPECT_EQ((Spawned{program("world_state"), words}.exit_code()), 2);
}

TEST_F(NodeProgramTest, ASecondOneOfAKindEndsWithOneSentence) {
  bus::Writer<msg::Odometry> writer{participant};
  Spawned first{program("world_state"), arguments()};
  ASSERT_TRUE(writer.wait_for_readers(1, kPlenty)) << first.said();
  Spawned second{program("world_state"), arguments()};
  EXPECT_EQ(second.exit_code(), 1);
  EXPECT_THAT(second.said(), HasSubstr("another world_state of robot 1 writes world_state in domain 17"));
  first.send(SIGTERM);
  EXPECT_EQ(first.exit_code(), 0) << first.said();
}

TEST_F(NodeProgramTest, ABadConfigurationNamesFileAndKey) {
  write_config("robot_idd = 1\n");
  Spawned unknown_key{program("odometry"), arguments()};
  EXPECT_EQ(unknown_key.exit_code(), 1);
  EXPECT_THAT(unknown_key.said(), AllOf(HasSubstr("odometry: "), HasSubstr("node.toml"), HasSubstr("robot_idd")));
  write_config("cycle_s = \"fast\"\n");
  Spawned wrong_type{program("kicker_driver"), arguments()};
  EXPECT_EQ(wrong_type.exit_code(), 1);
  EXPECT_THAT(wrong_type.said(), AllOf(HasSubstr("node.toml"), HasSubstr("cycle_s")));
  write_config("[hal]\nwheels = \"teleport\"\n");
  Spawned no_backend{program("odometry"), arguments()};
  EXPECT_EQ(no_backend.exit_code(), 1);
  EXPECT_THAT(no_backend.said(), HasSubstr("teleport"));
  Spawned no_file{program("odometry"), {"--config", (folder / "nowhere.toml").string()}};
  EXPECT_EQ(no_file.exit_code(), 1);
  EXPECT_THAT(no_file.said(), HasSubstr("nowhere.toml"));
}

TEST_F(NodeProgramTest, ASettingOnTheCommandLineIsCheckedToo) {
  auto with = arguments();
  with.insert(with.end(), {"--set", "run.robot_id=300"});
  Spawned node{program("odometry"), with};
  EXPECT_EQ(node.exit_code(), 1);
  EXPECT_THAT(node.said(), HasSubstr("robot_id"));
}

TEST_F(NodeProgramTest, BadUsageEndsWithTwoAndHelpWithZero) {
  for (const std::string name : {"odometry", "world_state", "kick_decision", "kicker_driver", "shot_observer",
                                 "kicker_drift", "recorder", "simulator"}) {
    SCOPED_TRACE(name);
    auto with = arguments();
    with.emplace_back("--no-such-flag");
    Spawned unknown{program(name), with};
    EXPECT_EQ(unknown.exit_code(), 2);
    EXPECT_THAT(unknown.said(), HasSubstr("--no-such-flag"));
    Spawned without{program(name), {}};
    EXPECT_EQ(without.exit_code(), 2);
    EXPECT_THAT(without.said(), HasSubstr("--config"));
    Spawned help{program(name), {"--help"}};
    EXPECT_EQ(help.exit_code(), 0);
    EXPECT_THAT(help.said(), HasSubstr("--config"));
  }
}

TEST_F(NodeProgramTest, ARecorderNeverWritesOverAMatchAndRecordsBesideIt) {
  std::ofstream{folder / "out.db"} << "something else";
  bus::Writer<msg::KickTruth> writer{participant};
  Spawned node{program("recorder"), arguments()};
  ASSERT_TRUE(writer.wait_for_readers(1, kPlenty)) << node.said();
  node.send(SIGTERM);
  EXPECT_EQ(node.exit_code(), 0) << node.said();
  EXPECT_THAT(node.said(), AllOf(HasSubstr("out.db exists already"), HasSubstr("recording to "), HasSubstr("out-r1-")));
  EXPECT_EQ(std::filesystem::file_size(folder / "out.db"), 14u);
}

TEST_F(NodeProgramTest, InLockstepARecorderRefusesAFileThatExists) {
  write_config("lockstep = true\n");
  std::ofstream{folder / "out.db"} << "something else";
  Spawned node{program("recorder"), arguments()};
  EXPECT_EQ(node.exit_code(), 1);
  EXPECT_THAT(node.said(), HasSubstr("out.db"));
}

}  // namespace
}  // namespace trivela::nodes
