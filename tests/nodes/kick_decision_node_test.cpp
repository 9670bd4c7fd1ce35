#include "nodes/kick_decision/kick_decision_node.hpp"

#include <atomic>
#include <cmath>
#include <ctime>
#include <limits>
#include <set>

#include "kicking/kick_id.hpp"
#include "robot/decision/decision_message.hpp"
#include "tests/instants.hpp"
#include "tests/nodes/node_fixture.hpp"

namespace trivela::nodes {
namespace {

using bus::Executor;

/// A node that decides, its inputs and what it says; the kicker is ready unless told otherwise.
class KickDecisionNodeTest : public NodeTest {
 protected:
  void start() {
    node.emplace(context);
    running.emplace(Executor::kListener, stop, std::vector<bus::Node*>{&node->node()});
    world_says.expect_reader();
  }

  /// Robot 6 m before the goal at rest, the ball in the handler, facing the goal but for the error.
  msg::WorldState world(double heading_error_rad = 0.0) const {
    msg::WorldState out{};
    out.t_ns = t_ns;
    out.half = 1;
    out.playing = out.possession = out.ball_known = true;
    out.possession_id = 1;
    out.y_m = 3.0;
    out.heading_rad = heading_error_rad;
    out.opponent_distance_m = std::numeric_limits<double>::quiet_NaN();
    return out;
  }

  msg::DriveCommand cycle(msg::WorldState state, bool ready = true, std::int64_t status_age_ns = 0) {
    msg::KickerStatus status{};
    state.t_ns = t_ns;
    clock_ns = t_ns + world_age_ns;
    status.t_ns = t_ns - status_age_ns;
    status.ready = ready;
    status.charge = 0.97;
    kicker_says(status);
    world_says(state);
    t_ns += kCycle_ns;
    return drive.nth(++cycles);
  }

  std::int64_t t_ns = 1'000'000'000;
  std::int64_t world_age_ns = 0;
  std::size_t cycles = 0;
  Received<msg::KickDecision> decision{participant};
  Received<msg::KickOrder> order{participant};
  Received<msg::DriveCommand> drive{participant};
  Says<msg::WorldState> world_says{participant};
  Says<msg::KickerStatus> kicker_says{participant};
  std::optional<KickDecisionNode> node;
  std::optional<Running> running;
};

TEST_F(KickDecisionNodeTest, SaysWithItsFirstOrderThatNobodyObservesKicks) {
  start();
  cycle(world());
  order.nth(1);
  EXPECT_TRUE(log_lines->wait_for("nobody writes kick_outcome: no shot_observer runs"));
}

/// Takes 30 ms by the test's clock.
struct Slow final : kicking::PolicyOf<kicking::PossessionMemory> {
  explicit Slow(std::atomic<std::int64_t>& clock) : PolicyOf("slow"), clock_ns(clock) {}
  kicking::PolicyOutput evaluate(const kicking::PolicyConfig&, const kicking::RobotModel&, const kicking::Goal&,
                                 const kicking::PolicyInput&, kicking::PossessionMemory&) const override {
    clock_ns += 30'000'000;
    return {};
  }
  std::atomic<std::int64_t>& clock_ns;
};

TEST_F(KickDecisionNodeTest, NamesOnceAPolicyThatTakesLongerThanACycle) {
  context.settings.kick_decision.policy_by_half = {kicking::register_policy(std::make_unique<Slow>(clock_ns))};
  start();
  cycle(world());
  cycle(world());
  EXPECT_TRUE(log_lines->wait_for("a decision of slow took 30 ms, and a cycle is 20 ms"));
  EXPECT_EQ(log_lines->count("a decision of"), 1u);
}

TEST_F(KickDecisionNodeTest, OrdersAKickWhenTheRobotIsAligned) {
  start();
  cycle(world());
  const auto sent = order.nth(1);
  EXPECT_EQ(sent.robot_id, 1);
  EXPECT_EQ(sent.seq, 1u);
  EXPECT_EQ(sent.t_ns, 1'000'000'000);
  EXPECT_EQ(sent.fire_t_ns, sent.t_ns);
  EXPECT_EQ(sent.valid_until_t_ns, sent.t_ns + 50'000'000);
  EXPECT_EQ(sent.kick_id, (std::int64_t{5} << 48) | (std::int64_t{1} << 40) | 1);
  // The power that the policy itself finds for this state.
  kicking::PolicyInput input;
  input.pose = {0.0, 3.0, 0.0};
  input.playing = input.possession = input.kicker_ready = true;
  input.possession_id = 1;
  kicking::PolicyMemory memory;
  const auto output = kicking::evaluate(kicking::PolicyName::kMoving, context.settings.policy, context.robot.model,
                                        context.settings.goal, input, memory);
  EXPECT_EQ(sent.power, output.power);
  const auto record = decision.nth(1);
  EXPECT_TRUE(record.fire);
  EXPECT_EQ(record.reason, msg::REASON_FIRE);
  EXPECT_EQ(record.kick_id, sent.kick_id);
  EXPECT_EQ(record.power, sent.power);
  EXPECT_EQ(record.policy, msg::POLICY_MOVING);
  EXPECT_EQ(record.charge, 0.97);
}

TEST_F(KickDecisionNodeTest, GoesByWhatTheObserverHasLearnedWhereItIsSwitchedOn) {
  Says<msg::KickerEstimate> learned{participant};
  const auto faster = [](double ratio, std::uint64_t seq) {
    msg::KickerEstimate estimate{};
    estimate.seq = seq;
    estimate.t_ns = 500'000'000;
    estimate.used = true;
    estimate.speed_ln = std::log(ratio);
    return estimate;
  };
  const auto power_of_kick = [&](std::size_t n, std::uint32_t possession) {
    auto state = world();
    state.possession_id = possession;
    cycle(state);
    return order.nth(n).power;
  };
  context.settings.self_calibration.mode = config::SelfCalibrationMode::kOn;
  start();
  learned.expect_reader();
  const double by_file = power_of_kick(1, 1);
  EXPECT_EQ(decision.nth(1).estimate, 0u) << "nobody has learned anything";
  learned(faster(1.1, 2));
  const double by_estimate = power_of_kick(2, 2);
  EXPECT_LT(by_estimate, by_file);
  EXPECT_EQ(decision.nth(2).estimate, 1u) << "the first one that was said";
  // Where an estimate makes no sense the last good one holds.
  auto wrong = faster(1.1, 3);
  wrong.delay_s = std::numeric_limits<double>::quiet_NaN();
  learned(wrong);
  EXPECT_EQ(power_of_kick(3, 3), by_estimate);
  EXPECT_EQ(decision.nth(3).estimate, 1u);
}

TEST_F(KickDecisionNodeTest, GoesByTheRobotsFileWhereLearningIsAShadow) {
  Says<msg::KickerEstimate> learned{participant};
  start();
  learned.expect_reader();
  msg::KickerEstimate estimate{};
  estimate.seq = 2;
  estimate.used = true;  // whatever it says of itself
  estimate.speed_ln = 0.1;
  learned(estimate);
  cycle(world());
  EXPECT_EQ(decision.nth(1).estimate, 0u);
}

TEST_F(KickDecisionNodeTest, AWorldThatWaitedIsNotDecidedOnAndTheRobotStands) {
  start();
  world_age_ns = 141'000'000;  // policy.max_state_age_s 0.14
  auto far = world();
  far.y_m = 0.0;
  const auto stands = cycle(far);
  EXPECT_EQ(decision.nth(1).reason, msg::REASON_STALE_STATE);
  EXPECT_FALSE(decision.nth(1).fire);
  EXPECT_EQ(stands.vx_mps, 0.0);
  EXPECT_EQ(stands.vy_mps, 0.0);
  EXPECT_EQ(stands.omega_radps, 0.0);
  world_age_ns = 139'000'000;
  EXPECT_NE(cycle(far).vy_mps, 0.0);
  EXPECT_NE(decision.nth(2).reason, msg::REASON_STALE_STATE);
}

TEST_F(KickDecisionNodeTest, OneFireIsOneOrder) {
  start();
  for (int i = 0; i < 10; ++i) cycle(world());
  EXPECT_EQ(order.now().size(), 1u);
  ASSERT_EQ(decision.first(10).size(), 10u);
  for (std::size_t i = 1; i < 10; ++i) {
    EXPECT_EQ(decision.now()[i].reason, msg::REASON_ORDER_PENDING);
    EXPECT_EQ(decision.now()[i].kick_id, 0);
    EXPECT_EQ(decision.now()[i].seq, i + 1);
  }
}

TEST_F(KickDecisionNodeTest, InASetPieceOfOursItDoesNotWaitForWhatComesTooLate) {
  context.settings.policy.rules.set_piece_s = 0.1;
  context.settings.kick_decision.policy_by_half = {kicking::PolicyName::kPredictive};
  Says<msg::Referee> referee_permission{participant};
  start();
  msg::Referee word{};
  word.t_ns = t_ns;
  word.restart = msg::RESTART_FREEKICK;
  word.ours = true;
  referee_permission(word);
  auto stopped = world(0.8);
  stopped.playing = false;
  cycle(stopped);
  word.t_ns = t_ns;
  word.playing = true;
  word.restart = msg::RESTART_NONE;
  word.ours = false;
  referee_permission(word);
  cycle(world(0.8));
  t_ns += 100'000'000;
  cycle(world(0.8));
  EXPECT_EQ(decision.nth(1).reason, msg::REASON_NOT_PLAYING);
  EXPECT_EQ(decision.nth(2).reason, msg::REASON_UNLIKELY) << "it cannot turn within 0.1 s";
  EXPECT_EQ(decision.nth(3).reason, msg::REASON_WAITING) << "the set piece is over";
}

TEST_F(KickDecisionNodeTest, HoldsAndTurnsWhileItIsNotAligned) {
  start();
  const auto command = cycle(world(0.8));
  EXPECT_EQ(command.t_ns, 1'000'000'000);
  EXPECT_LT(command.omega_radps, 0.0) << "back towards the goal";
  EXPECT_FALSE(decision.nth(1).fire);
  EXPECT_EQ(decision.nth(1).reason, msg::REASON_NOT_ALIGNED);
  EXPECT_EQ(decision.nth(1).kick_id, 0);
  EXPECT_TRUE(order.now().empty());
}

TEST_F(KickDecisionNodeTest, StandsStillWhenTheGameIsStoppedOrTheBallIsElsewhere) {
  start();
  auto stopped = world(0.8);
  stopped.playing = false;
  auto without_ball = world(0.8);
  without_ball.possession = false;
  for (const auto& state : {stopped, without_ball}) {
    const auto command = cycle(state);
    EXPECT_EQ(command.vx_mps, 0.0);
    EXPECT_EQ(command.vy_mps, 0.0);
    EXPECT_EQ(command.omega_radps, 0.0);
  }
  EXPECT_EQ(decision.now().size(), 1u) << "only cycles with the ball are decisions";
  EXPECT_EQ(decision.nth(1).reason, msg::REASON_NOT_PLAYING);
}

TEST_F(KickDecisionNodeTest, NamesWhatTheKickerIsMissing) {
  start();
  cycle(world(), false);
  EXPECT_EQ(decision.nth(1).reason, msg::REASON_KICKER_NOT_READY);
  cycle(world(), true, 200'000'000);
  EXPECT_EQ(decision.nth(2).reason, msg::REASON_STALE_STATE);
  EXPECT_TRUE(order.now().empty());
}

TEST_F(KickDecisionNodeTest, WithoutAnyStatusOfTheKickerItHolds) {
  start();
  world_says(world());
  EXPECT_EQ(decision.nth(1).reason, msg::REASON_KICKER_NOT_READY);
  EXPECT_EQ(decision.nth(1).charge, 0.0);
}

TEST_F(KickDecisionNodeTest, ThePolicyOfTheHalfDecidesAndTheOtherRidesAlong) {
  context.settings.kick_decision.policy_by_half = {kicking::PolicyName::kStopped, kicking::PolicyName::kMoving};
  context.settings.policy.settle_s = 0.25;
  start();
  auto second_half = world();
  second_half.half = 2;
  auto third_half = world();
  third_half.half = 3;
  cycle(world());
  cycle(second_half);
  cycle(third_half);
  EXPECT_EQ(decision.nth(1).policy, msg::POLICY_STOPPED);
  EXPECT_EQ(decision.nth(2).policy, msg::POLICY_MOVING);
  EXPECT_EQ(decision.nth(3).policy, msg::POLICY_MOVING) << "the last one goes on";
  EXPECT_FALSE(decision.nth(1).fire) << "it has not settled";
  ASSERT_EQ(decision.nth(1).shadow_count, 2);
  EXPECT_EQ(decision.nth(1).shadows[0].policy, msg::POLICY_MOVING);
  EXPECT_TRUE(decision.nth(1).shadows[0].fire) << "this one would have kicked";
  EXPECT_EQ(decision.nth(2).shadows[0].policy, msg::POLICY_STOPPED);
}

TEST_F(KickDecisionNodeTest, ThePolicyOfAPossessionIsDrawnAndItsProbabilityRecorded) {
  auto& settings = context.settings.kick_decision;
  settings.random = {kicking::PolicyName::kStopped, kicking::PolicyName::kMoving};
  settings.random_probabilities = {0.25, 0.75};
  const robot::PolicyAssignment assignment{settings, 1};
  start();
  for (std::uint32_t id = 1; id <= 12; ++id) {
    auto state = world(0.8);
    state.possession_id = id;
    cycle(state);
    const auto chance = assignment.in_charge(1, id);
    EXPECT_EQ(decision.nth(id).policy, robot::to_wire(chance.policy));
    EXPECT_EQ(decision.nth(id).assignment_probability, chance.probability);
  }
}

TEST_F(KickDecisionNodeTest, RefusesTheOracle) {
  context.settings.kick_decision.policy_by_half = {kicking::PolicyName::kOracle};
  EXPECT_THROW(KickDecisionNode{context}, std::runtime_error);
}

TEST_F(KickDecisionNodeTest, ShadowsCanBeSwitchedOff) {
  context.settings.kick_decision.shadows = false;
  start();
  cycle(world());
  EXPECT_EQ(decision.nth(1).shadow_count, 0);
}

// A stopped policy that settles for a quarter of a second: what it had settled is void once the ball was lost.
TEST_F(KickDecisionNodeTest, AShadowSeesTheCyclesWithoutTheBallToo) {
  context.settings.policy.settle_s = 0.25;
  start();
  auto without_ball = world();
  without_ball.possession = false;
  for (int i = 0; i < 5; ++i) cycle(world());
  for (int i = 0; i < 20; ++i) cycle(without_ball);
  cycle(world());
  const auto after = decision.nth(6);
  EXPECT_EQ(after.shadows[0].policy, msg::POLICY_STOPPED);
  EXPECT_FALSE(after.shadows[0].fire);
  for (int i = 0; i < 20; ++i) cycle(world());
  bool fired = false;
  for (const auto& later : decision.first(26)) fired = fired || later.shadows[0].fire;
  EXPECT_TRUE(fired) << "it does kick once it has settled";
}

// Turning counter-clockwise, 15 degrees before the target is where the first bisection's middle lies.
TEST_F(KickDecisionNodeTest, TheTurnDriveHearsWhatBecameOfItsKick) {
  context.settings.kick_decision.policy_by_half = {kicking::PolicyName::kTurnDrive};
  context.settings.policy.test_drive.turn_radps = {1.0};
  context.settings.policy.test_drive.turn_kicks_per_step = 1;
  Says<msg::KickOutcome> observer{participant};
  start();
  observer.expect_reader();
  const auto sweep = [this](std::uint32_t possession_id) {
    auto state = world(-context.settings.policy.test_drive.turn_lead_rad);
    state.possession_id = possession_id;
    cycle(state);
    auto aligned = world(kicking::radians(-14.9));
    aligned.possession_id = possession_id;
    aligned.omega_radps = 1.0;
    cycle(aligned);
    return decision.nth(2 * possession_id);
  };
  const auto first = sweep(1);
  EXPECT_TRUE(first.fire);
  EXPECT_EQ(first.policy, msg::POLICY_TURN_DRIVE);
  EXPECT_NEAR(first.beta_rad, kicking::radians(15.0), 1e-9);
  EXPECT_EQ(first.shadow_count, 3) << "stopped, moving and predictive ride along";
  msg::KickOutcome others{};
  others.t_ns = t_ns;
  others.kick_id = first.kick_id - 1;
  others.x_cross_m = 3.0;
  observer(others);
  t_ns += 1'000'000'000;
  EXPECT_NEAR(sweep(2).beta_rad, kicking::radians(15.0), 1e-9) << "the outcome of another kick";
  msg::KickOutcome late{};
  late.t_ns = t_ns;
  late.kick_id = order.nth(2).kick_id;
  late.x_cross_m = -2.0;
  observer(late);
  t_ns += 1'000'000'000;
  EXPECT_NEAR(sweep(3).beta_rad, kicking::radians(22.5), 1e-9) << "it went to the left: earlier";
}

TEST_F(KickDecisionNodeTest, TheSessionOfItsKickIdsIsOfItsStartWhereNoneIsGiven) {
  const auto unix_s = [] { return static_cast<std::uint64_t>(std::time(nullptr)); };
  context.settings.run.session = 0;
  const std::uint64_t first_s = unix_s();
  start();
  const std::uint64_t last_s = unix_s();
  cycle(world());
  const auto id = order.nth(1).kick_id;
  std::set<std::int64_t> possible;
  for (std::uint64_t s = first_s; s <= last_s; ++s) possible.insert(kicking::kick_session_at(s, false));
  EXPECT_TRUE(possible.contains(id >> 48)) << id;
  EXPECT_EQ((id >> 40) & 0xff, 1);
  EXPECT_EQ(id & 0xffffffffff, 1);
}

TEST_F(KickDecisionNodeTest, AWorldThatIsNotFiniteIsNotActedUpon) {
  start();
  auto broken = world();
  broken.heading_rad = std::numeric_limits<double>::quiet_NaN();
  const auto command = cycle(broken);
  EXPECT_EQ(command.omega_radps, 0.0);
  EXPECT_EQ(decision.nth(1).reason, msg::REASON_STALE_STATE);
  cycle(world());
  EXPECT_EQ(decision.nth(2).reason, msg::REASON_FIRE);
}

/// The second of two nodes beside a first one whose drive commands the test writes. Listeners run in the writer's
/// thread: when a sample is said, the node has answered.
class SecondDecisionNodeTest : public KickDecisionNodeTest {
 protected:
  void start_second() {
    context.settings.kick_decision.standby = true;
    node.emplace(context, DecisionNode::kSecond);
    running.emplace(Executor::kListener, stop, std::vector<bus::Node*>{&node->node()});
    world_says.expect_reader();
    first.expect_reader(2);  // the node and the test's own
  }
  void step(bool first_speaks) {
    clock_ns = t_ns;
    msg::DriveCommand command{};
    command.t_ns = t_ns;
    if (first_speaks) first(command);
    msg::KickerStatus status{};
    status.t_ns = t_ns;
    status.ready = true;
    status.charge = 0.97;
    kicker_says(status);
    msg::WorldState state = world();
    state.t_ns = t_ns;
    world_says(state);
    t_ns += kCycle_ns;
  }

  Says<msg::DriveCommand> first{participant, 1, "kick_decision/1"};
};

TEST_F(SecondDecisionNodeTest, SaysNothingWhileTheFirstSpeaksAndOrdersWhereItFallsSilent) {
  start_second();
  for (int i = 0; i < 50; ++i) step(true);
  EXPECT_TRUE(order.now().empty() && decision.now().empty());
  EXPECT_EQ(drive.now().size(), 50u) << "the first one's alone";
  for (int i = 0; i < 5; ++i) step(false);
  EXPECT_TRUE(order.now().empty());
  const std::int64_t sixth_ns = t_ns;
  step(false);
  EXPECT_EQ(order.nth(1).t_ns, sixth_ns) << "what it judged before left no order pending";
  EXPECT_EQ(order.nth(1).seq, 1u) << "nor took a number";
  EXPECT_EQ(order.nth(1).kick_id >> 48, 6) << "not the first one's session, 5";
  EXPECT_EQ(decision.nth(1).seq, 1u);
  EXPECT_EQ(drive.nth(51).t_ns, sixth_ns);
  EXPECT_TRUE(log_lines->wait_for("no first decision node is received: this one decides"));
}

TEST_F(SecondDecisionNodeTest, SpeaksOnForTwoSecondsAfterTheFirstIsBack) {
  start_second();
  for (int i = 0; i < 50; ++i) step(true);
  for (int i = 0; i < 20; ++i) step(false);
  const std::size_t alone = drive.now().size();
  for (int i = 0; i < 200; ++i) step(true);
  EXPECT_EQ(drive.now().size(), alone + 200 + 100) << "both for 100 cycles";
  EXPECT_TRUE(log_lines->wait_for("the first decision node is back and decides"));
}

TEST_F(SecondDecisionNodeTest, RefusesARobotThatHasOneDecisionNode) {
  try {
    KickDecisionNode second{context, DecisionNode::kSecond};
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("kick_decision.standby = false"));
  }
}

}  // namespace
}  // namespace trivela::nodes
