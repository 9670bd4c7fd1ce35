// The node on a real socket to an emulated box and on the real bus.
#include "nodes/refbox/refbox_node.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "emulators/refbox/emulated_box.hpp"
#include "tests/hal/json_schema.hpp"
#include "tests/nodes/node_fixture.hpp"

namespace trivela::nodes {
namespace {

using hal::refbox::BoxCommand;
using hal::refbox::BoxFault;
using hal::refbox::CommandKind;
using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

class RefboxNodeTest : public NodeTest {
 protected:
  RefboxNodeTest() {
    context.settings.refbox.port = box.port();
    context.settings.refbox.group = "224.16.32.39";
    context.settings.refbox.team_name = "Trivela";
  }

  void start() {
    node.emplace(context, open_refbox(context.settings.refbox));
    running.emplace(bus::Executor::kListener, stop, std::vector{&node->node()});
    ASSERT_TRUE(box.wait_for_teams(1, kPlenty));
  }
  void say(CommandKind kind, std::optional<std::size_t> team = {}) { box.act(BoxCommand{.kind = kind, .team = team}); }

  /// The first sample of `referee` from now on that is so, of this robot.
  template <class Is>
  msg::Referee wait_for(Is&& is, std::uint8_t robot_id = 1) {
    const auto end = Clock::now() + kPlenty;
    while (Clock::now() < end) {
      const auto& samples = referee.first(seen_ + 1);
      if (samples.size() <= seen_) break;
      const msg::Referee word = samples[seen_++];
      if (word.robot_id == robot_id && is(word)) return word;
    }
    ADD_FAILURE() << "no such word";
    return {};
  }
  msg::Referee wait_for_play(bool playing) {
    return wait_for([playing](const msg::Referee& word) { return word.playing == playing; });
  }

  std::string refusal() {
    try {
      const RefboxNode other{context, open_refbox(context.settings.refbox)};
      return "";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

  hal::refbox::EmulatedBox box{hal::refbox::BoxConfig{}};
  Received<msg::Referee> referee{participant};
  Says<msg::WorldState> model_says{participant};
  std::optional<RefboxNode> node;
  std::optional<Running> running;
  std::size_t seen_ = 0;
};

TEST_F(RefboxNodeTest, SaysTheMatchAsTheBoxSaysIt) {
  start();
  say(CommandKind::kFirstHalf);
  say(CommandKind::kGoal, 1);
  say(CommandKind::kKickOff, 0);
  const auto announced = wait_for([](const msg::Referee& word) { return word.restart == msg::RESTART_KICKOFF; });
  EXPECT_FALSE(announced.playing);
  EXPECT_TRUE(announced.ours);
  EXPECT_EQ(announced.stage, msg::STAGE_FIRST_HALF);
  EXPECT_EQ(announced.goals_other, 1);
  EXPECT_EQ(announced.command_counter, 4U) << "with WELCOME";
  EXPECT_EQ(announced.t_ns, clock_ns);
  say(CommandKind::kStart);
  EXPECT_EQ(wait_for_play(true).restart, msg::RESTART_NONE);
  clock_ns += 2'000'000'000;
  say(CommandKind::kStop);
  EXPECT_DOUBLE_EQ(wait_for_play(false).half_time_s, 2.0);
}

TEST_F(RefboxNodeTest, SaysOnceThatTheBoxIsAProgram) {
  Received<msg::DeviceEmulated> emulated{participant};
  start();
  EXPECT_EQ(emulated.nth(1).part, msg::PART_REFEREE_BOX);
  EXPECT_EQ(emulated.nth(1).robot_id, 1);
  box.act(BoxFault::kClose);
  ASSERT_TRUE(box.wait_for_teams(1, kPlenty)) << "it says WELCOME once more";
  say(CommandKind::kStart);
  wait_for_play(true);
  EXPECT_EQ(emulated.now().size(), 1U);
}

TEST_F(RefboxNodeTest, RepeatsWhatItSaid) {
  start();
  say(CommandKind::kStart);
  const std::uint64_t first = wait_for_play(true).seq;
  const auto began = Clock::now();
  const auto last = wait_for([first](const msg::Referee& word) { return word.seq >= first + 10; });
  EXPECT_TRUE(last.playing);
  EXPECT_EQ(last.command_counter, 2U);
  EXPECT_GT(Clock::now() - began, std::chrono::milliseconds{500}) << "not more often than it is told to";
}

TEST_F(RefboxNodeTest, RepeatsItAtLeastEveryTenthOfASecond) {
  start();
  const std::uint64_t first = wait_for([](const msg::Referee&) { return true; }).seq;
  const auto began = Clock::now();
  wait_for([first](const msg::Referee& word) { return word.seq >= first + 30; });
  EXPECT_LT(Clock::now() - began, std::chrono::milliseconds{4500})
      << "30 words in 3 s, and half as much for a busy machine";
}

TEST_F(RefboxNodeTest, ALostConnectionStopsWithinHalfASecondUntilANewStart) {
  for (const BoxFault fault : {BoxFault::kClose, BoxFault::kReset}) {
    if (!node) start();
    say(CommandKind::kStart);
    wait_for_play(true);
    const auto before = Clock::now();
    box.act(fault);
    wait_for_play(false);
    EXPECT_LT(Clock::now() - before, std::chrono::milliseconds{500});
    ASSERT_TRUE(box.wait_for_teams(1, kPlenty)) << "it comes back";
    say(CommandKind::kKickOff, 0);
    EXPECT_FALSE(wait_for([](const msg::Referee& word) { return word.restart == msg::RESTART_KICKOFF; }).playing);
  }
  EXPECT_TRUE(log_lines->wait_for("is lost: "));
}

// What the box is told is longer than its deaf kernel has room for: the next object, a period later, is the first that
// waits.
TEST_F(RefboxNodeTest, ABoxThatAcknowledgesNothingMoreStopsTheGameWithinHalfASecond) {
  context.settings.refbox.intention = std::string(20'000, 'i');
  start();
  say(CommandKind::kStart);
  wait_for_play(true);
  const auto before = Clock::now();
  box.act(BoxFault::kDeaf);
  wait_for_play(false);
  const std::chrono::duration<double> period{context.settings.refbox.period_s};
  EXPECT_LT(Clock::now() - before, std::chrono::milliseconds{500} + period);
}

TEST_F(RefboxNodeTest, TheBoxsSilenceStopsNothing) {
  start();
  say(CommandKind::kStart);
  const std::uint64_t first = wait_for_play(true).seq;
  box.act(BoxFault::kSilent);
  EXPECT_TRUE(wait_for([first](const msg::Referee& word) { return word.seq >= first + 15; }).playing);
}

TEST_F(RefboxNodeTest, TellsTheBoxTenTimesASecondUnderTheLeaguesSchema) {
  start();
  model_says.expect_reader();
  msg::WorldState world{};
  world.t_ns = clock_ns;
  world.x_m = 1.25;
  model_says(world);
  constexpr std::uint64_t kObjects = 30;
  ASSERT_TRUE(box.wait_for_objects(0, kObjects, kPlenty));
  const auto report = box.report(0);
  EXPECT_GE(report.rate_hz, 10.0);
  EXPECT_EQ(report.problems, 0U) << report.last_problem;
  const auto told = nlohmann::json::parse(report.last);
  std::ifstream file(TRIVELA_SOURCE_DIR "/tests/hal/worldstate.schema.json");
  EXPECT_THAT(tests::SchemaCheck::problems(told, nlohmann::json::parse(file)), testing::IsEmpty());
  EXPECT_EQ(told["teamName"], "Trivela");
  ASSERT_EQ(told["robots"].size(), 1U);
  EXPECT_EQ(told["robots"][0]["pose"][0], 1.25);
}

TEST_F(RefboxNodeTest, OfARobotThatSaysNothingMoreTheBoxHearsNothing) {
  start();
  model_says.expect_reader();
  msg::WorldState world{};
  world.t_ns = clock_ns;
  model_says(world);
  const auto robots = [&] {
    const auto said = box.report(0).objects;
    EXPECT_TRUE(box.wait_for_objects(0, said + 3, kPlenty));
    return nlohmann::json::parse(box.report(0).last)["robots"].size();
  };
  EXPECT_EQ(robots(), 1U);
  clock_ns += 1'500'000'000;
  EXPECT_EQ(robots(), 0U);
}

TEST_F(RefboxNodeTest, SpeaksForEveryRobotThatItIsToldOf) {
  context.settings.refbox.robots = {2, 5};
  Says<msg::WorldState> five{participant, 5}, nine{participant, 9};
  start();
  five.expect_reader();
  nine.expect_reader();
  msg::WorldState world{};
  world.t_ns = clock_ns;
  nine(world);
  five(world);
  say(CommandKind::kStart);
  const auto plays = [](const msg::Referee& word) { return word.playing; };
  const auto two = wait_for(plays, 2);
  seen_ = 0;  // of several that wait a reader gives one robot's before the other's
  EXPECT_TRUE(wait_for([&](const msg::Referee& word) { return word.seq == two.seq; }, 5).playing);
  for (const msg::Referee& word : referee.now()) EXPECT_TRUE(word.robot_id == 2 || word.robot_id == 5);
  const auto said = box.report(0).objects;
  ASSERT_TRUE(box.wait_for_objects(0, said + 3, kPlenty));
  const auto told = nlohmann::json::parse(box.report(0).last);
  ASSERT_EQ(told["robots"].size(), 1U);
  EXPECT_EQ(told["robots"][0]["id"], 5);
}

TEST_F(RefboxNodeTest, WhatNobodyKnowsIsLoggedAndChangesNothing) {
  start();
  say(CommandKind::kStart);
  wait_for_play(true);
  for (const BoxFault fault : {BoxFault::kUnknown, BoxFault::kBroken, BoxFault::kStatus, BoxFault::kOverlong})
    box.act(fault);
  EXPECT_TRUE(log_lines->wait_for("a command that nobody knows"));
  EXPECT_TRUE(log_lines->wait_for("what is no JSON"));
  EXPECT_TRUE(log_lines->wait_for("an object without a command"));
  EXPECT_TRUE(log_lines->wait_for("over 100000 bytes"));
  say(CommandKind::kIsAlive, 0);
  EXPECT_TRUE(log_lines->wait_for("IS_ALIVE for us"));
  const auto now = wait_for([](const msg::Referee& word) { return word.command_counter == 3; });
  EXPECT_TRUE(now.playing);
}

TEST_F(RefboxNodeTest, ANodeThatJoinsTheBusAnewKeepsTheConnectionAndTheMatch) {
  const auto link = open_refbox(context.settings.refbox);
  bus::Stop first_stop;
  NodeContext first_context{context.settings, context.robot, participant, context.logger, first_stop};
  first_context.steady_ns = context.steady_ns;
  std::optional<RefboxNode> first(std::in_place, first_context, link);
  {
    const Running runs{bus::Executor::kListener, first_stop, {&first->node()}};
    ASSERT_TRUE(box.wait_for_teams(1, kPlenty));
    say(CommandKind::kStart);
    wait_for_play(true);
  }
  first.reset();
  const std::size_t before = referee.now().size();
  node.emplace(context, link);
  running.emplace(bus::Executor::kListener, stop, std::vector{&node->node()});
  const auto& words = referee.first(before + 3);
  for (std::size_t i = before; i < words.size(); ++i) EXPECT_TRUE(words[i].playing);
  EXPECT_EQ(words.back().command_counter, 2U) << "no second WELCOME";
}

TEST_F(RefboxNodeTest, ASecondRefereeOfARobotIsRefused) {
  start();
  EXPECT_THAT(refusal(), HasSubstr("another referee of robot 1 writes referee in domain"));
  context.settings.refbox.robots = {7, 1};
  EXPECT_THAT(refusal(), HasSubstr("another referee of robot 1 "));
  context.settings.refbox.robots = {7};
  EXPECT_EQ(refusal(), "");
}

TEST_F(RefboxNodeTest, BesideTheSimulatorsRefereeItIsRefused) {
  const bus::Writer<msg::Referee> simulators{participant, referee_of(1)};
  EXPECT_THAT(refusal(), HasSubstr("another referee of robot 1 writes referee"));
}

TEST_F(RefboxNodeTest, WithoutAGroupOrInLockstepItIsRefused) {
  context.settings.refbox.group = "";
  EXPECT_THAT(refusal(), HasSubstr("refbox.group is empty"));
  context.settings.refbox.letters = true;
  EXPECT_EQ(refusal(), "") << "letters are for a colour";
  context.settings.run.lockstep = true;
  EXPECT_THAT(refusal(), HasSubstr("run.lockstep"));
}

}  // namespace
}  // namespace trivela::nodes
