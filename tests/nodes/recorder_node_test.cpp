#include "nodes/recorder/recorder_node.hpp"

#include <fmt/core.h>

#include <atomic>
#include <iterator>
#include <limits>
#include <thread>

#include "config/settings.hpp"
#include "log/read/reader.hpp"
#include "tests/nodes/node_fixture.hpp"
#include "tests/support/folder.hpp"

namespace trivela::nodes {
namespace {

using bus::Executor;
using log::Loss;
using log::Value;
using ::testing::HasSubstr;

class RecorderNodeTest : public NodeTest {
 protected:
  static log::WriterOptions quick() {
    log::WriterOptions options;
    options.group_commit_s = 0.01;
    options.warn = [](const std::string&) {};
    return options;
  }
  void start(Executor::Kind kind = Executor::kListener) {
    log.emplace(folder / "match.db", log::Session{}, quick());
    node.emplace(context, *log);
    running.emplace(kind, stop, std::vector<bus::Node*>{&node->node()});
  }
  /// Stops the recorder and opens its log.
  log::Reader read() {
    running.reset();
    log->finalise();
    return log::Reader{folder / "match.db"};
  }
  static std::int64_t count(const log::Reader& reader, const std::string& what) {
    std::int64_t n = 0;
    reader.query("SELECT count(*) FROM " + what,
                 [&](std::span<const Value> row) { n = std::get<std::int64_t>(row[0]); });
    return n;
  }
  static Loss loss(const log::Reader& reader, const std::string& stream) {
    for (const auto& each : reader.losses())
      if (each.stream == stream) return each;
    return {};
  }

  tests::Folder folder;
  std::optional<log::Writer> log;
  std::optional<RecorderNode> node;
  std::optional<Running> running;
};

template <class T>
T numbered(std::uint64_t seq, std::uint8_t robot_id = 1) {
  T out{};
  out.robot_id = robot_id;
  out.seq = seq;
  out.t_ns = static_cast<std::int64_t>(seq) * 20;
  if constexpr (requires { out.half; }) out.half = 1;
  return out;
}

template <class T>
void say(const bus::Participant& participant, const std::vector<T>& samples) {
  bus::Writer<T> writer{participant};
  ASSERT_TRUE(writer.wait_for_readers(1, kPlenty));
  for (const T& sample : samples) writer.write(sample);
}

template <class T>
void say_of_two_robots(const bus::Participant& participant) {
  say<T>(participant, {numbered<T>(1), numbered<T>(1, 2), numbered<T>(2), numbered<T>(2, 2), numbered<T>(3)});
}

TEST_F(RecorderNodeTest, RecordsEveryStreamOfEveryRobot) {
  start();
  say_of_two_robots<msg::Odometry>(participant);
  say_of_two_robots<msg::VisionFrame>(participant);
  say_of_two_robots<msg::FlightFrame>(participant);
  say_of_two_robots<msg::Referee>(participant);
  say_of_two_robots<msg::WorldState>(participant);
  say_of_two_robots<msg::DriveCommand>(participant);
  say_of_two_robots<msg::TeamDrive>(participant);
  say_of_two_robots<msg::KickerStatus>(participant);
  say_of_two_robots<msg::KickDecision>(participant);
  say_of_two_robots<msg::KickOrder>(participant);
  say_of_two_robots<msg::KickReceipt>(participant);
  say_of_two_robots<msg::KickOutcome>(participant);
  say_of_two_robots<msg::KickTruth>(participant);
  say_of_two_robots<msg::PossessionTruth>(participant);
  const auto reader = read();
  for (const std::string table : {"odometry", "vision_frames", "flight_frames", "referee", "world_states",
                                  "drive_commands", "team_drives", "kicker_status", "kick_decisions", "kick_orders",
                                  "kick_receipts", "kick_outcomes", "kick_truths", "possession_truths"}) {
    EXPECT_EQ(count(reader, table + " WHERE robot_id = 1"), 3) << table;
    EXPECT_EQ(count(reader, table + " WHERE robot_id = 2"), 2) << table;
    const auto counted = loss(reader, table);
    EXPECT_EQ(counted.received, 5) << table;
    EXPECT_EQ(counted.missing() + counted.out_of_order, 0) << table;
  }
}

// As its program runs it, where a stop finds samples that have arrived and are not taken yet.
TEST_F(RecorderNodeTest, RecordsInAThreadOfItsOwnWhateverArrivedBeforeTheStop) {
  start(Executor::kWaitset);
  std::vector<msg::KickDecision> decisions;
  for (std::uint64_t seq = 1; seq <= 2000; ++seq) decisions.push_back(numbered<msg::KickDecision>(seq));
  say(participant, decisions);
  const auto reader = read();
  EXPECT_EQ(count(reader, "kick_decisions"), 2000);
  EXPECT_EQ(loss(reader, "kick_decisions").missing(), 0);
}

TEST_F(RecorderNodeTest, CountsWhatNeverArrived) {
  start();
  say<msg::Referee>(participant, {numbered<msg::Referee>(1), numbered<msg::Referee>(2), numbered<msg::Referee>(6)});
  const auto reader = read();
  EXPECT_EQ(count(reader, "referee"), 3);
  EXPECT_EQ(loss(reader, "referee").gaps, 3);
  EXPECT_EQ(loss(reader, "referee").missing(), 3);
}

TEST_F(RecorderNodeTest, SaysBetweenWhichInstantsEventsNeverArrived) {
  start();
  say<msg::KickReceipt>(participant, {numbered<msg::KickReceipt>(1), numbered<msg::KickReceipt>(4)});
  const auto reader = read();
  EXPECT_EQ(loss(reader, "kick_receipts").gaps, 2);
  EXPECT_EQ(count(reader, "losses WHERE stream = 'kick_receipts' AND robot_id = 1 AND from_t_ns = 20 AND to_t_ns = 80"),
            1);
}

TEST_F(RecorderNodeTest, ANodeThatStartsAgainIsRecordedOn) {
  start();
  const std::vector<msg::Referee> words{numbered<msg::Referee>(1), numbered<msg::Referee>(2)};
  say(participant, words);
  say(participant, words);
  const auto reader = read();
  EXPECT_EQ(count(reader, "referee"), 4);
  EXPECT_EQ(loss(reader, "referee").missing() + loss(reader, "referee").out_of_order, 0);
  EXPECT_EQ(count(reader, "referee WHERE seq = 4 AND t_ns = 40"), 1);
}

TEST_F(RecorderNodeTest, RecordsTheShadowsBesideTheirDecision) {
  start();
  auto decision = numbered<msg::KickDecision>(1);
  decision.shadow_count = 2;
  decision.shadows[0].reason = msg::REASON_SETTLING;
  decision.shadows[0].offset_right_m = std::numeric_limits<double>::quiet_NaN();
  decision.shadows[0].power = decision.shadows[0].v_kick_mps = std::numeric_limits<double>::quiet_NaN();
  decision.shadows[1].policy = msg::POLICY_MOVING;
  decision.shadows[1].fire = true;
  say<msg::KickDecision>(participant, {decision, numbered<msg::KickDecision>(2)});
  const auto reader = read();
  EXPECT_EQ(count(reader, "shadow_decisions"), 2);
  EXPECT_EQ(count(reader,
                  "shadow_decisions WHERE seq = 1 AND shadow_index = 0 AND reason = 'settling' AND power IS "
                  "NULL AND policy = 'stopped'"),
            1);
  EXPECT_EQ(count(reader, "shadow_decisions WHERE shadow_index = 1 AND fire = 1 AND policy = 'moving'"), 1);
}

TEST_F(RecorderNodeTest, AShadowCountFromTheWireBeyondTheArrayIsNotBelieved) {
  start();
  auto decision = numbered<msg::KickDecision>(1);
  decision.shadow_count = 200;
  say<msg::KickDecision>(participant, {decision});
  const auto reader = read();
  EXPECT_EQ(count(reader, "kick_decisions"), 1);
  EXPECT_LE(count(reader, "shadow_decisions"), std::ssize(decision.shadows));
}

TEST_F(RecorderNodeTest, NaNWhereANumberMustBeIsCountedAndNotFatal) {
  start();
  auto broken = numbered<msg::DriveCommand>(1);
  broken.vx_mps = std::numeric_limits<double>::quiet_NaN();
  say<msg::DriveCommand>(participant, {broken, numbered<msg::DriveCommand>(2)});
  const auto reader = read();
  EXPECT_EQ(count(reader, "drive_commands"), 1);
  EXPECT_EQ(loss(reader, "drive_commands").nan_refused, 1);
}

TEST_F(RecorderNodeTest, InLockstepACycleIsOverWhenEveryStateStreamOfItIsRecorded) {
  context.settings.run.lockstep = true;
  Received<msg::StepDone> done{participant};
  start();
  const auto state = [&]<class T>(const T& sample) { say<T>(participant, {sample}); };
  state(numbered<msg::DriveCommand>(1));
  state(numbered<msg::Odometry>(1));
  state(numbered<msg::VisionFrame>(1));
  state(numbered<msg::FlightFrame>(1));
  state(numbered<msg::Referee>(1));
  state(numbered<msg::WorldState>(1));
  state(numbered<msg::KickerStatus>(1, 2));
  EXPECT_TRUE(done.now().empty()) << "one stream is missing; another robot's is none of it";
  state(numbered<msg::KickerStatus>(1));
  EXPECT_EQ(done.nth(1).node, msg::STEP_RECORDER);
  EXPECT_EQ(done.nth(1).t_ns, 20);
  EXPECT_EQ(log->stats().rows_missing, 0);
}

TEST_F(RecorderNodeTest, TheSessionSaysHowTheMatchWasPlayed) {
  context.settings = config::load_settings(TRIVELA_SOURCE_DIR "/config/default.toml");
  context.settings.kick_decision.policy_by_half = {kicking::PolicyName::kStopped, kicking::PolicyName::kMoving};
  context.settings.simulator.seed = 77;
  EXPECT_FALSE(session_of(context).simulated_clock) << "in real time a simulator's samples are of the steady clock";
  context.settings.run.lockstep = true;
  const auto session = session_of(context);
  EXPECT_TRUE(session.simulated_clock);
  EXPECT_EQ(session.started_t_ns, 0);
  EXPECT_EQ(simulation_of(context.settings).seed, 77);
  EXPECT_EQ(simulation_of(context.settings).scenario, "default");
  EXPECT_FALSE(session.software_version.empty());
  EXPECT_THAT(session.config_toml, HasSubstr("seed = 77"));
  EXPECT_THAT(session.config_toml, HasSubstr("cambada_1"));
  EXPECT_THAT(session.idl, HasSubstr("struct KickDecision"));
  EXPECT_THAT(session.idl, HasSubstr("struct Odometry"));
  ASSERT_EQ(session.policies.size(), 2u);
  EXPECT_EQ(session.policies[0].policy, "stopped");
  EXPECT_EQ(session.policies[1].policy, "moving");
}

/// Recorders of a robot behind a bridge, of which nobody knows yet what it is.
class SimulatedSession : public RecorderNodeTest {
 protected:
  SimulatedSession() {
    context.settings.simulator.seed = 77;
    context.settings.run.scenario = "config/scenarios/default.toml";
  }
  /// Whether the log was written to n times before long.
  bool written(std::int64_t n) {
    const auto deadline = std::chrono::steady_clock::now() + kPlenty;
    while (log->stats().commits < n && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    return log->stats().commits >= n;
  }
};

TEST_F(SimulatedSession, IsOneThatAWriterOfTruthWasThereFor) {
  start();
  { const bus::Writer<msg::KickTruth> truth{participant}; }  // gone at once, and it said nothing
  ASSERT_TRUE(written(1));
  const auto session = read().sessions().at(0);
  EXPECT_TRUE(session.simulated);
  EXPECT_EQ(session.seed, 77);
  EXPECT_EQ(session.scenario, "default");
  EXPECT_EQ(log->stats().rows_written, 0);
}

TEST_F(SimulatedSession, IsOneInWhichADeviceWasEmulatedAndNoWorldIsNamed) {
  Says<msg::DeviceEmulated> emulated{participant};
  msg::DeviceEmulated word{};
  word.part = msg::PART_KICKER;
  emulated(word);  // before the recorder is there
  start();
  ASSERT_TRUE(written(1));
  const auto session = read().sessions().at(0);
  EXPECT_TRUE(session.simulated);
  EXPECT_FALSE(session.seed);
  EXPECT_EQ(session.scenario, "");
}

TEST_F(SimulatedSession, IsNoneForTheBridgesTopicsAlone) {
  start();
  Says<msg::DeviceWheels> wheels_word{participant};
  wheels_word({});
  say_of_two_robots<msg::Odometry>(participant);
  say_of_two_robots<msg::KickerStatus>(participant);
  const auto reader = read();
  EXPECT_EQ(loss(reader, "odometry").received, 5);
  EXPECT_FALSE(reader.sessions().at(0).simulated || reader.sessions().at(0).seed);
}

TEST_F(SimulatedSession, SaysTheWorldAlsoWhereADeviceWasEmulatedFirst) {
  start();
  Says<msg::DeviceEmulated> emulated{participant};
  emulated.expect_reader();
  emulated({});
  ASSERT_TRUE(written(1));
  const bus::Writer<msg::PossessionTruth> truth{participant};
  ASSERT_TRUE(written(2));
  const auto session = read().sessions().at(0);
  EXPECT_TRUE(session.simulated);
  EXPECT_EQ(session.seed, 77);
}

msg::Odometry odometry_of(std::int64_t t_ns) {
  msg::Odometry sample{};
  sample.t_ns = t_ns;
  return sample;
}

/// The rows of silences, as "stream robot from to".
std::vector<std::string> silences(const log::Reader& reader) {
  std::vector<std::string> rows;
  reader.query(
      "SELECT stream, robot_id, from_t_ns, to_t_ns FROM losses WHERE robot_id > 0 ORDER BY from_t_ns",
      [&](const std::string& stream, int robot_id, std::int64_t from_t_ns, std::optional<std::int64_t> to_t_ns) {
        rows.push_back(
            fmt::format("{} {} {} {}", stream, robot_id, from_t_ns, to_t_ns ? std::to_string(*to_t_ns) : "-"));
      });
  return rows;
}

TEST_F(RecorderNodeTest, ASilenceIsARowWhileItLastsAndHasItsEndThen) {
  start(Executor::kWaitset);
  Says<msg::Odometry> odometry{participant, 3};
  odometry.expect_reader();
  constexpr std::int64_t kMs = 1'000'000;
  odometry(odometry_of(1020 * kMs));
  EXPECT_TRUE(log_lines->wait_for("no odometry of robot 3 for"));
  log->flush();  // as a killed recorder leaves it
  EXPECT_THAT(silences(log::Reader{folder / "match.db"}), testing::ElementsAre("odometry 3 1020000000 -"));
  odometry(odometry_of(2260 * kMs));
  EXPECT_TRUE(log_lines->wait_for("odometry of robot 3 back after 1.24 s"));
  EXPECT_THAT(silences(read()), testing::Contains("odometry 3 1020000000 2260000000"));
}

TEST_F(RecorderNodeTest, AWordToACoilThatNoDriverAnswersForIsNoted) {
  std::atomic<std::int64_t> now_ns{1'000'000'000};
  context.steady_ns = [&now_ns] { return now_ns.load(); };
  log.emplace(folder / "match.db", log::Session{}, quick());
  auto state = std::make_shared<RecordingState>();
  state->log = folder / "match.db";
  node.emplace(context, *log, state);
  running.emplace(Executor::kWaitset, stop, std::vector<bus::Node*>{&node->node()});
  const auto fire = [](std::int64_t kick_id) {
    auto sample = numbered<msg::DeviceFire>(static_cast<std::uint64_t>(kick_id));
    sample.kick_id = kick_id;
    sample.power = 20.0;
    return sample;
  };
  Says<msg::DeviceFire> coil{participant};
  Says<msg::KickReceipt> driver{participant};
  coil.expect_reader();
  driver.expect_reader();
  auto receipt = numbered<msg::KickReceipt>(1);
  receipt.kick_id = 1;
  receipt.accepted = true;
  driver(receipt);
  while (log->flush(), count(log::Reader{folder / "match.db"}, "kick_receipts") == 0) std::this_thread::yield();
  coil(fire(1));
  coil(fire(2));
  while (log_lines->count("ordered the coil (device/fire) to kick 2 with power 20") == 0) {
    now_ns += robot::FireWatch::kTimeout_ns;
    std::this_thread::yield();
  }
  const auto reader = read();
  EXPECT_EQ(count(reader, "notes WHERE who = 'recorder' AND text LIKE '%no kicker_driver answers for it%'"), 1);
  EXPECT_EQ(count(reader, "notes"), 1);
}

TEST(FireWatch, AFloodOfWordsIsToldEachTenSecondsAndFillsNoMemory) {
  robot::FireWatch watch;
  std::size_t told = 0, words = 0;
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  for (std::int64_t t_ns = 0; t_ns < 60 * kSecond_ns; t_ns += kSecond_ns / 100) {
    auto fire = numbered<msg::DeviceFire>(static_cast<std::uint64_t>(t_ns) + 1);
    fire.kick_id = t_ns + 1;
    watch.fired(fire, t_ns);
    const std::size_t count = watch.unanswered(t_ns).size();
    told += count > 0 ? 1 : 0;
    words += count;
  }
  EXPECT_EQ(told, 6u) << "after 5, 15, 25 ... s";
  EXPECT_GT(words, 6u);
  EXPECT_LE(words, 6 * 256u);
}

TEST_F(RecorderNodeTest, ANodeThatJoinsTheBusAnewKnowsWhatWasSilent) {
  log.emplace(folder / "match.db", log::Session{}, quick());
  const auto state = std::make_shared<RecordingState>();
  Says<msg::Odometry> odometry{participant};
  {
    RecorderNode first{context, *log, state};
    bus::Stop first_stop;
    const Running first_run{Executor::kWaitset, first_stop, {&first.node()}};
    odometry(odometry_of(1'000'000'000));
    EXPECT_TRUE(log_lines->wait_for("no odometry of robot 1 for"));
  }
  node.emplace(context, *log, state);
  running.emplace(Executor::kWaitset, stop, std::vector<bus::Node*>{&node->node()});
  odometry(odometry_of(2'240'000'000));
  EXPECT_TRUE(log_lines->wait_for("odometry of robot 1 back after 1.24 s"));
  EXPECT_THAT(silences(read()), testing::Contains("odometry 1 1000000000 2240000000"));
}

TEST_F(RecorderNodeTest, RowsGoOnWhereANodeJoinsTheBusAnewAfterAWriterWasStartedAnew) {
  log.emplace(folder / "match.db", log::Session{}, quick());
  const auto state = std::make_shared<RecordingState>();
  std::optional<Says<msg::Odometry>> odometry{std::in_place, participant};
  const auto recorded = [&](std::size_t rows) {
    const auto deadline = std::chrono::steady_clock::now() + kPlenty;
    std::int64_t n = 0;
    while (n < static_cast<std::int64_t>(rows) && std::chrono::steady_clock::now() < deadline) {
      log->flush();
      n = count(log::Reader{folder / "match.db"}, "odometry");
    }
    return n;
  };
  std::int64_t t_ns = 1'000'000'000;
  {
    RecorderNode first{context, *log, state};
    bus::Stop first_stop;
    const Running first_run{Executor::kWaitset, first_stop, {&first.node()}};
    for (std::size_t n = 1; n <= 5; ++n) {
      if (n == 4) odometry.emplace(participant);  // its numbers begin at 1 again
      odometry->expect_reader();
      (*odometry)(odometry_of(t_ns += 20'000'000));
      EXPECT_EQ(recorded(n), static_cast<std::int64_t>(n));
    }
  }
  node.emplace(context, *log, state);
  running.emplace(Executor::kWaitset, stop, std::vector<bus::Node*>{&node->node()});
  (*odometry)(odometry_of(t_ns += 20'000'000));
  EXPECT_EQ(recorded(6), 6) << "and the last sample before it, which a late joiner is given, is no row again";
  const auto reader = read();
  EXPECT_EQ(count(reader, "odometry"), 6);
  EXPECT_EQ(loss(reader, "odometry").missing(), 0);
}

TEST_F(RecorderNodeTest, WhatMerelyCameLateIsNoSilence) {
  start(Executor::kWaitset);
  Says<msg::Odometry> odometry{participant};
  odometry.expect_reader();
  odometry(odometry_of(1'000'000'000));
  EXPECT_TRUE(log_lines->wait_for("no odometry of robot 1 for"));
  odometry(odometry_of(1'020'000'000));
  EXPECT_TRUE(log_lines->wait_for("odometry of robot 1 back after 0.02 s"));
  EXPECT_THAT(silences(read()), testing::Not(testing::Contains(HasSubstr(" 1000000000 "))));
}

TEST_F(RecorderNodeTest, InLockstepNobodyIsSilent) {
  context.settings.run.lockstep = true;
  start(Executor::kWaitset);
  Says<msg::Odometry> odometry{participant};
  odometry.expect_reader();
  odometry(odometry_of(0));
  odometry(odometry_of(1'000'000'000));
  EXPECT_THAT(silences(read()), testing::IsEmpty());
}

}  // namespace
}  // namespace trivela::nodes
