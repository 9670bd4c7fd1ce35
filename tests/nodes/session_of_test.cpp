// What the recorder writes down of a match before it begins.
#include <gmock/gmock.h>

#include "config/settings.hpp"
#include "config/text/error.hpp"
#include "log/read/reader.hpp"
#include "nodes/recorder/recorder_node.hpp"
#include "tests/evaluator/referee_row.hpp"
#include "tests/nodes/node_fixture.hpp"
#include "tests/support/folder.hpp"

namespace trivela::nodes {
namespace {

using kicking::PolicyName;

class SessionOf : public NodeTest {
 protected:
  SessionOf() {
    context.settings = config::load_settings(TRIVELA_SOURCE_DIR "/config/default.toml");
    context.settings.run.lockstep = true;
    context.settings.simulator.halves = 2;
    context.settings.simulator.half_minutes = 2.5;
  }
};

TEST_F(SessionOf, SaysHowLongASimulatedMatchIsToLast) {
  EXPECT_EQ(simulation_of(context.settings).planned_s, 300.0);
  context.settings.run.lockstep = false;
  EXPECT_EQ(simulation_of(context.settings).planned_s, 300.0) << "in real time, too";
  context.settings.simulator.max_possessions = 10;
  EXPECT_FALSE(simulation_of(context.settings).planned_s) << "a half may end with its possessions";
  context.settings.simulator.max_possessions = 0;
  context.settings.simulator.half_minutes = 0.0;
  context.settings.run.scenario = TRIVELA_SOURCE_DIR "/config/scenarios/msl_2026.toml";
  EXPECT_EQ(simulation_of(context.settings).planned_s, 1800.0) << "halves of the scenario's length";
  context.settings.run.scenario = "none.toml";
  EXPECT_FALSE(simulation_of(context.settings).planned_s) << "which nobody knows without its file";
}

TEST_F(SessionOf, SaysWhetherTheHalvesArePaired) {
  EXPECT_FALSE(simulation_of(context.settings).paired_halves);
  context.settings.simulator.paired_halves = true;
  EXPECT_TRUE(simulation_of(context.settings).paired_halves);
}

TEST_F(SessionOf, DoesNotCallASessionSimulatedForItsConfiguration) {
  for (const bool lockstep : {true, false}) {
    context.settings.run.lockstep = lockstep;
    const auto session = session_of(context);
    EXPECT_FALSE(session.simulated || session.seed || session.paired_halves || session.planned_s);
    EXPECT_EQ(session.scenario, "");
  }
}

TEST_F(SessionOf, NeedsAWorldsFileInLockstepAlone) {
  context.settings.run.scenario = "/nowhere/world.toml";
  EXPECT_THROW(session_of(context), config::Error);
  context.settings.run.lockstep = false;
  EXPECT_NO_THROW(session_of(context));
}

TEST_F(SessionOf, NamesThePoliciesOfRobotsThatHaveTheirOwn) {
  context.settings.kick_decision.policy_by_half = {PolicyName::kStopped, PolicyName::kMoving};
  context.settings.kick_decision.policy_by_robot = {PolicyName::kPredictive};
  std::vector<std::string> policies;
  for (const auto& half : session_of(context).policies)
    policies.push_back(std::to_string(half.robot_id) + " " + std::to_string(half.half) + " " + half.policy);
  EXPECT_THAT(policies, testing::ElementsAre("0 1 stopped", "0 2 moving", "1 1 predictive", "1 2 predictive"));
  context.settings.kick_decision.policy_by_robot.clear();
  context.settings.kick_decision.random = {PolicyName::kStopped, PolicyName::kMoving};
  EXPECT_THAT(session_of(context).policies, testing::IsEmpty());
}

}  // namespace
}  // namespace trivela::nodes
