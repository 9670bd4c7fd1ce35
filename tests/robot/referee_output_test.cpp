// A simulated referee's word through an emulated box's bytes: whoever hears them knows the same.
#include "emulators/refbox/referee_output.hpp"

#include <gmock/gmock.h>

#include "emulators/refbox/emulated_box.hpp"
#include "emulators/sim/sim_messages.hpp"
#include "robot/referee/match_state.hpp"
#include "tests/sim/played_match.hpp"

namespace trivela::robot {
namespace {

using namespace hal::refbox;
using enum hal::refbox::CommandKind;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr BoxCommand ours(CommandKind kind) { return {.kind = kind, .team = 0}; }
constexpr BoxCommand all(CommandKind kind) { return {.kind = kind}; }

sim::RefereeState word(int half, bool playing, std::uint32_t possession_id, std::uint32_t goals = 0) {
  return {
      .half = half, .playing = playing, .possession_id = possession_id, .goals = goals, .commands = 0, .half_s = {}};
}

TEST(RefereeOutput, SaysWhatBeginsAHalfThenEachStopSetPieceAndStartOnce) {
  RefereeOutput output;
  EXPECT_THAT(output.receive(word(1, false, 1)), ElementsAre(all(kFirstHalf), ours(kKickOff)));
  EXPECT_THAT(output.receive(word(1, false, 1)), IsEmpty());
  EXPECT_THAT(output.receive(word(1, true, 1)), ElementsAre(all(kStart)));
  EXPECT_THAT(output.receive(word(1, true, 1)), IsEmpty());
  EXPECT_THAT(output.receive(word(1, false, 2)), ElementsAre(all(kStop), ours(kFreeKick)));
  EXPECT_THAT(output.receive(word(1, true, 2)), ElementsAre(all(kStart)));
}

TEST(RefereeOutput, GivesAGoalWhenPlayIsStopped) {
  RefereeOutput output;
  output.receive(word(1, true, 1));
  EXPECT_THAT(output.receive(word(1, true, 1, 2)), IsEmpty());
  EXPECT_THAT(output.receive(word(1, false, 2, 2)), ElementsAre(all(kStop), ours(kGoal), ours(kGoal), ours(kFreeKick)));
}

TEST(RefereeOutput, EndsAHalfBeforeTheNextBegins) {
  RefereeOutput output;
  output.receive(word(1, true, 3));
  EXPECT_THAT(output.receive(word(1, false, 3)), ElementsAre(all(kStop)));
  EXPECT_THAT(output.receive(word(2, false, 1)), ElementsAre(all(kHalfTime), all(kSecondHalf), ours(kKickOff)));
  EXPECT_THAT(output.receive(word(3, false, 1)), ElementsAre(all(kEndGame), all(kFirstHalfOvertime), ours(kKickOff)));
  EXPECT_THAT(output.receive(word(4, false, 1)), ElementsAre(all(kEndPart), all(kSecondHalfOvertime), ours(kKickOff)));
  EXPECT_THAT(RefereeOutput::over(), ElementsAre(all(kStop), all(kGameOver)));
}

TEST(RefereeOutput, AStopOfNoTimeIsSaid) {
  RefereeOutput output;
  output.receive(word(1, true, 1));
  EXPECT_THAT(output.receive(word(1, true, 2)), ElementsAre(all(kStop), ours(kFreeKick), all(kStart)));
}

TEST(RefereeOutput, TheRightTeamIsNamedWhereItIsOurs) {
  RefereeOutput output{1};
  EXPECT_THAT(output.receive(word(1, false, 1)), ElementsAre(all(kFirstHalf), BoxCommand{.kind = kKickOff, .team = 1}));
}

class RefereeVoiceOnTheWire : public testing::TestWithParam<Protocol> {};

// The words of a whole match of two halves with goals, as bytes and back.
TEST_P(RefereeVoiceOnTheWire, WhoeverHearsItKnowsTheSimulatedRefereesWord) {
  sim::Scenario scenario = sim::alone();
  scenario.possession.goal_distance_max_m = 5.0;
  scenario.possession.aim_error_sd_rad = 0.05;
  const sim::Record record = sim::play(scenario, 7, 2, 0.3, sim::fire_at_once(16));
  const BoxConfig box{.protocol = GetParam()};
  CommandStream stream{{.protocol = GetParam(), .group = box.groups[0], .colour = Colour::kCyan}};
  RefereeOutput output;
  MatchState state;
  state.connected();
  for (const sim::Sensors& now : record.sensors) {
    for (const BoxCommand& said : output.receive(now.referee)) {
      for (const ParsedCommand& received : stream.add(wire_text(said, box))) {
        ASSERT_TRUE(std::holds_alternative<Command>(received)) << name(said.kind);
        state.command(std::get<Command>(received), now.t_ns);
      }
    }
    const msg::Referee known = state.message(now.t_ns);
    const msg::Referee said = hal::referee_message(now.t_ns, now.referee);
    ASSERT_EQ(known.playing, said.playing) << now.t_ns;
    ASSERT_EQ(known.half, said.half) << now.t_ns;
    ASSERT_EQ(known.stage, said.stage) << now.t_ns;
    if (!said.playing) {
      ASSERT_EQ(known.goals_own, said.goals_own) << now.t_ns;
    }
    if (now.referee.half_s) {
      ASSERT_NEAR(known.half_time_s, said.half_time_s, 1e-9) << now.t_ns;
    }
  }
  EXPECT_GT(state.message(0).goals_own, 0);
  EXPECT_EQ(state.message(0).half, 2);
}

INSTANTIATE_TEST_SUITE_P(Protocols, RefereeVoiceOnTheWire, testing::Values(Protocol::kJson, Protocol::kLetters));

}  // namespace
}  // namespace trivela::robot
