// A recorded robot decides again. A generator with late and crossing inputs is the witness: it alone knows what its
// nodes had in each cycle, and the log does not say it.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <map>
#include <random>

#include "experiment/replay/replay_match.hpp"
#include "log/write/writer.hpp"
#include "robot/recording/message_row.hpp"
#include "tests/support/folder.hpp"

namespace trivela::experiment {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kStart_ns = 1000 * 1'000'000'000LL;

/// Samples of a topic, each with the instant at which it reaches the nodes.
template <class T>
struct Arriving {
  std::multimap<std::int64_t, T> by_arrival;
  std::vector<T> recorded;

  void add(T sample, std::int64_t delay_ns) {
    sample.robot_id = 1;
    sample.seq = recorded.size() + 1;
    recorded.push_back(sample);
    // Samples of one writer come in their order.
    const std::int64_t last = by_arrival.empty() ? 0 : by_arrival.rbegin()->first;
    by_arrival.emplace(std::max(last, sample.t_ns + delay_ns), sample);
  }
  const T* latest(std::int64_t now_ns) const {
    auto next = by_arrival.upper_bound(now_ns);
    return next == by_arrival.begin() ? nullptr : &std::prev(next)->second;
  }
  /// Whether the latest by its instant is another one.
  bool crosses(std::int64_t now_ns, std::int64_t t_ns) const {
    const T* by_instant = nullptr;
    for (const T& sample : recorded)
      if (sample.t_ns <= t_ns) by_instant = &sample;
    const T* const there = latest(now_ns);
    return (there == nullptr) != (by_instant == nullptr) || (there != nullptr && there->seq != by_instant->seq);
  }
};

/// A robot that drives towards the goal with the ball, again and again, in real time.
class Generator {
 public:
  /// `crossing`: share of samples that come up to a cycle late; `stalled`: share of cycles that kick_decision comes to
  /// late.
  Generator(std::uint32_t seed, double crossing, double stalled) : random_(seed), crossing_(crossing) {
    setup_.settings.kick_decision.policy_by_half = {kicking::PolicyName::kPredictive};
    setup_.settings.kick_decision.shadows = true;
    constexpr int kCycles = 1500;
    for (int i = 0; i < 2 * kCycles; ++i) make_inputs(kStart_ns + i * 10 * kMillisecond, i);
    RobotLogic logic{setup_.settings, setup_.robot, 1, 7};
    for (int i = 0; i < kCycles; ++i) cycle(logic, kStart_ns + i * 20 * kMillisecond + jitter(), draw() < stalled);
  }

  std::filesystem::path write(const tests::Folder& folder) const {
    const auto path = folder / "match.db";
    log::Writer log{path, session()};
    write(log, odometry_);
    write(log, frames_.recorded);
    write(log, referee_.recorded);
    write(log, kicker_.recorded);
    write(log, worlds_);
    write(log, decisions_);
    log.finalise();
    return path;
  }

  RobotSetup setup() const { return setup_; }
  std::int64_t crossings() const { return crossings_; }
  const std::vector<msg::KickDecision>& decisions() const { return decisions_; }
  std::int64_t fires() const { return std::ranges::count_if(decisions_, &msg::KickDecision::fire); }

 private:
  static log::Session session() {
    log::Session session;
    session.robot_id = 1;
    session.started_t_ns = kStart_ns;
    session.software_version = "a test";
    session.scenario = "drives";
    session.config_toml = "### settings\n";
    return session;
  }

  template <class T>
  static void write(log::Writer& log, const std::vector<T>& rows) {
    const auto table = log.table(robot::table_of<T>(), robot::columns_of<T>());
    for (const T& row : rows) log.push(table, robot::row_of(row));
  }

  double draw() { return std::uniform_real_distribution<double>{}(random_); }
  std::int64_t jitter() { return static_cast<std::int64_t>(2.0 * draw() * kMillisecond); }
  std::int64_t delay() {
    return draw() < crossing_ ? static_cast<std::int64_t>(20.0 * draw() * kMillisecond) : kMillisecond / 5;
  }

  /// From 8 m before the goal to 2 m, in 6 s, a little to one side and to the other.
  kicking::Pose pose(std::int64_t t_ns) const {
    const double s = 1e-9 * static_cast<double>((t_ns - kStart_ns) % 6'000'000'000);
    return {0.3 * std::sin(1.7 * s), 1.0 + s, 0.08 * std::sin(2.3 * s + 0.5)};
  }

  void make_inputs(std::int64_t t_ns, int i) {
    if (i % 4 == 1) {
      msg::VisionFrame frame{};
      frame.t_ns = t_ns + jitter();
      frame.t_exposure_ns = frame.t_ns - 30 * kMillisecond;
      const kicking::Pose at = pose(frame.t_exposure_ns);
      frame.pose_seen = frame.ball_seen = true;
      frame.x_m = at.x_m + 0.05 * (draw() - 0.5);
      frame.y_m = at.y_m + 0.05 * (draw() - 0.5);
      frame.heading_rad = at.heading_rad + 0.02 * (draw() - 0.5);
      frame.ball_x_m = 0.01 * (draw() - 0.5);
      frame.ball_y_m = setup_.robot.model.ball_offset_m + 0.01 * (draw() - 0.5);
      frame.opponent_x_m = frame.opponent_y_m = msg::kNone;
      frames_.add(frame, delay());
    }
    if (i % 10 == 3) {
      msg::Referee word{};
      word.t_ns = t_ns;
      word.half = 1;
      word.playing = i / 300 % 5 != 4;
      word.half_time_s = 0.01 * i;
      referee_.add(word, delay());
    }
    if (i % 2 == 0) {
      msg::KickerStatus status{};
      status.t_ns = t_ns + jitter();
      status.charge = std::min(1.0, 0.01 * (i % 400));
      status.voltage_v = msg::kNone;
      status.armed = true;
      status.ready = status.charge > 0.95;
      kicker_.add(status, delay());
    }
  }

  void cycle(RobotLogic& logic, std::int64_t t_ns, bool stalled) {
    msg::Odometry odometry{};
    odometry.robot_id = 1;
    odometry.seq = odometry_.size() + 1;
    odometry.t_ns = t_ns;
    const kicking::Pose at = pose(t_ns), before = pose(t_ns - kMillisecond);
    odometry.x_m = at.x_m, odometry.y_m = at.y_m, odometry.heading_rad = at.heading_rad;
    odometry.vy_mps = 1.0;
    odometry.omega_radps = 1e3 * (at.heading_rad - before.heading_rad);
    odometry.wheel_3_radps = msg::kNone;
    odometry_.push_back(odometry);
    const std::int64_t believes_ns = t_ns + kMillisecond + jitter(), decides_ns = believes_ns + kMillisecond;
    const bool crosses = frames_.crosses(believes_ns, t_ns) || referee_.crosses(believes_ns, t_ns) ||
                         kicker_.crosses(believes_ns, t_ns) || kicker_.crosses(decides_ns, t_ns);
    if (crosses) ++crossings_;
    msg::WorldState world = logic.believe(
        odometry, {frames_.latest(believes_ns), referee_.latest(believes_ns), kicker_.latest(believes_ns)});
    world.seq = worlds_.size() + 1;
    worlds_.push_back(world);
    const LogicDecision decided =
        logic.decide(world, {kicker_.latest(decides_ns), referee_.latest(decides_ns), nullptr, nullptr, stalled, 0});
    if (world.possession) decisions_.push_back(decided.record);
  }

  std::mt19937 random_;
  double crossing_;
  RobotSetup setup_;
  std::vector<msg::Odometry> odometry_;
  Arriving<msg::VisionFrame> frames_;
  Arriving<msg::Referee> referee_;
  Arriving<msg::KickerStatus> kicker_;
  std::vector<msg::WorldState> worlds_;
  std::vector<msg::KickDecision> decisions_;
  std::int64_t crossings_ = 0;
};

ReplayCheck decide_log_again(const std::filesystem::path& path, const Generator& made, const tests::Folder& folder,
                             const std::optional<RobotSetup>& again = {}) {
  const log::Reader reader{path, log::Check::kSchema};
  log::Session session = reader.sessions().front();
  session.replays_uuid = std::exchange(session.uuid, "");
  session.config_toml = "### settings\n";
  log::Writer log{folder / "again.db", session};
  const auto check = replay_robot({reader, reader.sessions().front().session_id, 1}, made.setup(), again, log, 65536);
  log.finalise();
  return check;
}

ReplayCheck decide_again(const Generator& made, const tests::Folder& folder,
                         const std::optional<RobotSetup>& again = {}) {
  return decide_log_again(made.write(folder), made, folder, again);
}

/// What it says of a log that somebody has changed.
std::string refusal_of_changed(const std::string& change) {
  const tests::Folder folder;
  const Generator made{1, 0.0, 0.0};
  const auto path = made.write(folder);
  SQLite::Database{path.string(), SQLite::OPEN_READWRITE}.exec("PRAGMA ignore_check_constraints = ON; " + change);
  try {
    decide_log_again(path, made, folder);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

using Policies = std::vector<kicking::PolicyName>;

/// What it says where the cycles shall be decided by these.
std::string refusal_of(const Policies& by_half, const Policies& by_robot = {}, const Policies& random = {}) {
  const tests::Folder folder;
  const Generator made{1, 0.0, 0.0};
  RobotSetup other = made.setup();
  other.settings.kick_decision.policy_by_half = by_half;
  other.settings.kick_decision.policy_by_robot = by_robot;
  other.settings.kick_decision.random = random;
  try {
    decide_again(made, folder, other);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// How many rows of a table the replay has.
std::int64_t rows_in(const tests::Folder& folder, const std::string& table) {
  std::int64_t rows = 0;
  log::Reader{folder / "again.db"}.query("SELECT count(*) FROM " + table, [&](std::int64_t count) { rows = count; });
  return rows;
}

TEST(ReplayRobot, WithoutCrossingsEveryDecisionIsTheSame) {
  const tests::Folder folder;
  const Generator made{1, 0.0, 0.0};
  ASSERT_GT(made.fires(), 0);
  const ReplayCheck check = decide_again(made, folder);
  EXPECT_EQ(check.decisions, std::ssize(made.decisions()));
  EXPECT_EQ(check.decisions_exact, check.decisions);
  EXPECT_EQ(rows_in(folder, "kick_decisions"), check.decisions);
  EXPECT_EQ(rows_in(folder, "kick_orders"), made.fires());
}

TEST(ReplayRobot, FindsOutWhichInputsCrossed) {
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u, 5u}) {
    const tests::Folder folder;
    const Generator made{seed, 0.5, 0.0};
    const ReplayCheck check = decide_again(made, folder);
    EXPECT_EQ(check.beliefs_same, check.beliefs) << seed;
    EXPECT_EQ(check.decisions_exact, check.decisions) << seed;
    EXPECT_GT(check.crossed, 50) << seed;
    EXPECT_LE(check.crossed, made.crossings()) << seed;
    EXPECT_EQ(rows_in(folder, "kick_orders"), made.fires()) << seed;
  }
}

TEST(ReplayRobot, KnowsTheCyclesThatWereDecidedTooLate) {
  const tests::Folder folder;
  const Generator made{1, 0.2, 0.05};
  const ReplayCheck check = decide_again(made, folder);
  EXPECT_EQ(check.decisions_exact, check.decisions);
  EXPECT_GT(check.late, 10);
}

TEST(ReplayRobot, AnotherPolicyOrdersElsewhereAndTheCheckStaysThatOfTheLog) {
  const tests::Folder folder;
  const Generator made{1, 0.5, 0.0};
  RobotSetup moving = made.setup();
  moving.settings.kick_decision.policy_by_half = {kicking::PolicyName::kMoving};
  const ReplayCheck check = decide_again(made, folder, moving);
  EXPECT_EQ(check.decisions_exact, check.decisions);
  std::int64_t of_moving = 0;
  log::Reader{folder / "again.db"}.query("SELECT count(*) FROM kick_decisions WHERE policy = 'moving'",
                                         [&](std::int64_t count) { of_moving = count; });
  EXPECT_EQ(of_moving, rows_in(folder, "kick_decisions"));
  EXPECT_GT(of_moving, 0);
}

TEST(ReplayRobot, RefusesABaseThatTheSamplesAreNotOf) {
  const tests::Folder folder;
  const Generator made{1, 0.0, 0.0};
  RobotSetup four = made.setup();
  four.robot.base.wheel_angles_rad = {0.5, 2.5, 3.7, 5.6};
  try {
    decide_again(made, folder, four);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("none of its 1500 wheel samples goes with the robot's file: it has 4 wheels"));
  }
}

TEST(ReplayRobot, RefusesAPolicyThatNeedsTheTruth) {
  using enum kicking::PolicyName;
  const std::string why = "the policy oracle needs the simulator's true state, which no recorded stream has";
  EXPECT_EQ(refusal_of({kOracle}), why);
  EXPECT_EQ(refusal_of({kMoving, kOracle}), why) << "in the second half";
  EXPECT_EQ(refusal_of({kMoving}, {kOracle}), why);
  EXPECT_EQ(refusal_of({kMoving}, {}, {kMoving, kOracle}), why) << "drawn";
  EXPECT_EQ(refusal_of({kMoving}, {kMoving, kOracle}), "") << "another robot's";
}

TEST(ReplayRobot, NamesTheColumnOfALogThatHoldsWhatItCannotRead) {
  EXPECT_THAT(refusal_of_changed("UPDATE kick_decisions SET reason = 'by_whim' WHERE seq = 3"),
              AllOf(HasSubstr("match.db"), HasSubstr("reason"), HasSubstr("a label of its enum")));
  EXPECT_THAT(refusal_of_changed("UPDATE referee SET half = 99999999999 WHERE seq = 2"),
              AllOf(HasSubstr("match.db"), HasSubstr("half"), HasSubstr("a whole number of its range")));
}

TEST(ReplayRobot, OfALogWithoutTheRobotsRowsDecidesNothing) {
  const tests::Folder folder;
  const Generator made{1, 0.0, 0.0};
  const log::Reader reader{made.write(folder)};
  log::Session session = reader.sessions().front();
  session.replays_uuid = std::exchange(session.uuid, "");
  log::Writer log{folder / "again.db", session};
  const auto check = replay_robot({reader, reader.sessions().front().session_id, 2}, made.setup(), {}, log, 65536);
  EXPECT_EQ(check.cycles, 0);
  log.finalise();
  EXPECT_EQ(rows_in(folder, "kick_decisions"), 0);
}

TEST(Distance, CountsWhatDiffersButNumbersOfRows) {
  msg::KickDecision one{}, other{};
  one.power = other.power = msg::kNone;
  other.seq = 5, other.kick_id = 9;
  EXPECT_EQ(distance(one, other), 0.0);
  other.fire = true;
  other.distance_m = 0.25;
  EXPECT_EQ(distance(one, other), 1.25);
  other.power = 20.0;
  EXPECT_EQ(distance(one, other), 2.25) << "a number and none differ by 1";
}

}  // namespace
}  // namespace trivela::experiment
