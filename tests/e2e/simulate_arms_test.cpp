// Who plays in an experiment, and what its arms are refused for.
#include <gmock/gmock.h>

#include <fstream>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/simulate_runs.hpp"

namespace trivela::e2e {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(SimulateArms, NamesWhatIsNoArm) {
  const tests::Folder folder;
  const auto complaint = [&](const std::string& arms) {
    Program program{"trivela", {"simulate", "--arms", arms, "--matches", "1"}, folder.path()};
    EXPECT_EQ(program.wait(), 2) << arms;
    return program.errors();
  };
  EXPECT_THAT(complaint("stopped,walking"), HasSubstr("\"walking\" is no policy"));
  EXPECT_THAT(complaint("moving@worn"), HasSubstr("a table is new or old"));
  EXPECT_THAT(complaint("moving,moving"), HasSubstr("twice"));
  EXPECT_THAT(complaint("turn_drive"), HasSubstr("calibrates a robot"));
  EXPECT_THAT(complaint("learned"), HasSubstr("needs a model"));
}

/// What a refused command says. It leaves no file behind.
std::string refusal(const tests::Folder& folder, const std::vector<std::string>& more, int exit_code = 2) {
  std::vector<std::string> arguments{"simulate", "--matches", "1", "--possessions", "3", "--out", "no.db"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  Program program{"trivela", arguments, folder.path()};
  EXPECT_EQ(program.wait(), exit_code) << program.errors();
  EXPECT_THAT(folder.files(".db"), IsEmpty());
  return program.errors();
}

TEST(SimulateArms, ARefusedCommandDoesNotBlockTheCorrectedOne) {
  const tests::Folder folder;
  EXPECT_THAT(refusal(folder, {"--arms", "stopped", "--set", "run.cycle_s=0.01"}, 1),
              HasSubstr("arm stopped: run.cycle_s = 0.01 differs from the scenario's"));
  EXPECT_THAT(
      refusal(folder,
              {"--arms", "moving@old", "--set", "policy.target_height_m=2.0", "--set", "policy.height_law=\"exact\""},
              1),
      AllOf(HasSubstr("arm moving@old: robot calibrated_1 with policy.target_height_m = 2: height_table: "),
            HasSubstr("distances_m[1] = ")));
}

TEST(SimulateArms, RefusesSettingsThatPlayNoPart) {
  const tests::Folder folder;
  const auto said = [&](const std::string& line) { return refusal(folder, {"--arms", "moving", "--set", line}); };
  EXPECT_THAT(said("kick_decision.shadows=true"), HasSubstr("--set kick_decision.shadows=true: kick_decision.shadows "
                                                            "plays no part in process: trivela simulate --shadows"));
  EXPECT_THAT(said("run.robot_id=2"), HasSubstr("the scenario's [team]"));
  EXPECT_THAT(said("run.scenario='x.toml'"), HasSubstr("--scenario names the world"));
  EXPECT_THAT(said("run={robot='x.toml'}"), HasSubstr("run.robot plays no part in process: --robot"));
  EXPECT_THAT(said("run.field_file='x.toml'"),
              HasSubstr("run.field_file plays no part in process: the scenario names"));
  EXPECT_THAT(said("field.side_line_x_m=3"), HasSubstr("field.side_line_x_m plays no part in process"));
  EXPECT_THAT(said("simulator.seed=1"), HasSubstr("--seed says"));
  EXPECT_THAT(said("simulator.halves=2"), HasSubstr("--possessions says"));
  EXPECT_THAT(said("recorder.log='x.db'"), HasSubstr("--out names the log"));
  EXPECT_THAT(said("hal.wheels='cia402'"), HasSubstr("plays no part in process"));
  std::ofstream{folder / "arms.toml"} << "[[arm]]\nname = \"a\"\nset = [\n  \"simulator.seed = 3\"\n]\n";
  EXPECT_THAT(refusal(folder, {"--arms", "arms.toml"}),
              HasSubstr("arms.toml:4: arm a: set \"simulator.seed = 3\": simulator.seed plays no part in process"));
}

TEST(SimulateArms, OneOfArmAndSettingsSaysWhoPlays) {
  const tests::Folder folder;
  const auto said = [&](const std::string& line) { return refusal(folder, {"--arms", "moving", "--set", line}); };
  EXPECT_THAT(
      said("kick_decision.random=['stopped','moving']"),
      HasSubstr("arm moving: kick_decision.random says who plays, and so does the arm's policy; leave one out"));
  EXPECT_THAT(said("kick_decision.policy_by_robot=['stopped']"), HasSubstr("kick_decision.policy_by_robot says who"));
  EXPECT_THAT(said("kick_decision.policy_by_half=['stopped']"), HasSubstr("kick_decision.policy_by_half says who"));
  std::ofstream{folder / "drawn.toml"} << "[[arm]]\nname = \"a\"\nrandom = [\"stopped\", \"moving\"]\n";
  EXPECT_THAT(refusal(folder, {"--arms", "drawn.toml", "--set", "kick_decision.random_probabilities=[0.5,0.5]"}),
              HasSubstr("drawn.toml:1: arm a: kick_decision.random_probabilities says who plays, and so does the arm's "
                        "random"));
  std::ofstream{folder / "free.toml"} << "[[arm]]\nname = \"a\"\n";
  EXPECT_THAT(refusal(folder, {"--arms", "free.toml", "--set", "kick_decision.policy_by_half=['stopped','moving']"}),
              HasSubstr("names 2 halves"));
  EXPECT_THAT(refusal(folder, {"--arms", "free.toml", "--set", "kick_decision.random_probabilities=[1.0]"}, 1),
              HasSubstr("free.toml:1: arm a: kick_decision.random_probabilities has 1 entries"));
}

constexpr const char* kArmsWithoutPolicy = R"(
[[arm]]
name = "by robot"
set = ["kick_decision.policy_by_robot = ['stopped', 'predictive']", "kick_decision.policy_by_half = ['moving']"]
[[arm]]
name = "by half"
set = ["kick_decision.policy_by_half = ['stopped']"]
[[arm]]
name = "drawn"
set = ["kick_decision.random = ['stopped', 'moving']", "kick_decision.random_probabilities = [0.25, 0.75]"]
[[arm]]
name = "drawn by the arm"
random = ["stopped", "moving"]
random_probabilities = [0.25, 0.75]
)";

std::vector<Row> assignments_of(const Reader& log, const std::string& arm) {
  return rows_of(log,
                 "SELECT match_id, a.robot_id, possession_id, policy, probability FROM assignments AS a JOIN "
                 "sessions USING (session_id) WHERE arm = '" +
                     arm + "' ORDER BY match_id, possession_id");
}

/// How many policies played in an arm.
auto policies_of(const Reader& log, const std::string& arm) {
  return number_of(
      log, "SELECT count(DISTINCT policy) FROM assignments JOIN sessions USING (session_id) WHERE arm = '" + arm + "'");
}

TEST(SimulateArms, AnArmWithoutPolicyPlaysWhatItsSettingsSay) {
  const tests::Folder folder;
  std::ofstream{folder / "arms.toml"} << kArmsWithoutPolicy;
  run(folder, {"simulate", "--arms", "arms.toml", "--matches", "2", "--possessions", "20", "--scenario",
               std::string{TRIVELA_SOURCE_DIR} + "/config/scenarios/team.toml", "--out", "team.db"});
  const Reader log{folder / "team.db"};
  EXPECT_EQ(number_of(log,
                      "SELECT count(*) FROM assignments AS a JOIN sessions USING (session_id) WHERE arm = "
                      "'by robot' AND probability = 1 AND policy = CASE a.robot_id WHEN 1 THEN 'stopped' WHEN 2 "
                      "THEN 'predictive' ELSE 'moving' END"),
            40);
  EXPECT_EQ(policies_of(log, "by robot"), 3);
  EXPECT_EQ(number_of(log,
                      "SELECT count(*) FROM kick_decisions AS d LEFT JOIN assignments AS a USING (session_id, "
                      "robot_id, half, possession_id) WHERE d.policy IS NOT a.policy"),
            0);
  EXPECT_EQ(assignments_of(log, "drawn"), assignments_of(log, "drawn by the arm"));
  EXPECT_EQ(policies_of(log, "drawn"), 2);
  EXPECT_EQ(rows_of(log,
                    "SELECT DISTINCT arm, half, policy FROM session_policies AS p JOIN sessions USING (session_id) "
                    "WHERE p.robot_id = 0"),
            (std::vector<Row>{{"by half", std::int64_t{1}, "stopped"}}))
      << "the halves of the others have no one policy";
  EXPECT_EQ(
      rows_of(log,
              "SELECT DISTINCT p.robot_id, policy FROM session_policies AS p JOIN sessions USING (session_id) "
              "WHERE arm = 'by robot' AND p.robot_id <= 3 ORDER BY 1"),
      (std::vector<Row>{{std::int64_t{1}, "stopped"}, {std::int64_t{2}, "predictive"}, {std::int64_t{3}, "moving"}}));
}

TEST(SimulateArms, SaysWhereATeamSharesARobotFile) {
  const tests::Folder folder;
  const auto said = [&](const std::string& out, std::vector<std::string> more) {
    more.insert(more.begin(), {"simulate", "--arms", "stopped", "--matches", "1", "--possessions", "2", "--out", out});
    Program program{"trivela", more, folder.path()};
    EXPECT_EQ(program.wait(), 0);
    return program.errors();
  };
  const std::string team = std::string{TRIVELA_SOURCE_DIR} + "/config/scenarios/team.toml";
  EXPECT_THAT(said("shared.db", {"--scenario", team, "--robot", kRobot}),
              HasSubstr("5 robots play with 1 robot file: cambada_1 is taken for all further ones"));
  EXPECT_THAT(said("own.db", {"--scenario", team}), Not(HasSubstr("robot file")));
  EXPECT_THAT(said("one.db", {"--robot", kRobot}), Not(HasSubstr("robot file")));
}

}  // namespace
}  // namespace trivela::e2e
