// A policy of another repository, examples/own_policy: in process, on the bus, and to those that do not have it.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/simulate_runs.hpp"

namespace trivela::e2e {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class OwnPolicy : public testing::Test {
 protected:
  /// Runs the example, which must succeed; gives what it prints.
  std::string patient(const std::vector<std::string>& arguments) const {
    Program program{TRIVELA_PATIENT, arguments, folder_.path(), find_nodes};
    EXPECT_EQ(program.wait(), 0) << program.errors();
    return program.output();
  }
  /// What a program that must fail with this exit code says.
  std::string refusal(const std::string& name, const std::vector<std::string>& arguments, int code) const {
    Program program{name, arguments, folder_.path(), find_nodes};
    EXPECT_EQ(program.wait(), code);
    return program.errors();
  }
  static void find_nodes() { setenv("PATH", TRIVELA_BINARY_DIR ":/usr/bin:/bin", 1); }

  tests::Folder folder_;
};

TEST_F(OwnPolicy, PlaysAThousandOpportunitiesBesideMovingAndIsCompared) {
  patient({"simulate", "--arms", "patient,moving", "--matches", "100", "--possessions", "10", "--robot", kRobot,
           "--out", "ab.db"});
  const Reader log{folder_ / "ab.db"};
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM possession_truths"), 2000);
  EXPECT_GT(number_of(log, "SELECT count(*) FROM kick_decisions WHERE policy = 'patient' AND fire = 1"), 300);
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM kick_decisions WHERE policy NOT IN ('patient', 'moving')"), 0);
  Program compare{"trivela", {"compare", "ab.db"}, folder_.path()};
  ASSERT_EQ(compare.wait(), 0) << compare.errors();
  EXPECT_THAT(compare.output(), HasSubstr("patient"));
  Program report{"trivela", {"report", "ab.db"}, folder_.path()};
  ASSERT_EQ(report.wait(), 0) << report.errors();
  EXPECT_THAT(report.output(), HasSubstr("patient"));
}

TEST_F(OwnPolicy, DecidesOnTheBusAsInProcess) {
  const std::string near = "policy.own.patient.near_m=5.5", robot = "run.robot='" + kRobot + "'";
  patient({"simulate", "--arms", "patient", "--matches", "1", "--possessions", "8", "--robot", kRobot, "--shadows",
           "--every-cycle", "--set", near, "--out", "in.db"});
  EXPECT_THAT(
      differing_on_the_bus(folder_, {"--half", "patient", "--set", robot, "--set", near}, TRIVELA_PATIENT, find_nodes),
      IsEmpty());
  const Reader bus{folder_ / "bus.db"};
  EXPECT_EQ(rows_of(bus, "SELECT DISTINCT policy FROM session_policies"), (std::vector<Row>{{std::string{"patient"}}}));
  EXPECT_EQ(rows_of(bus, "SELECT DISTINCT policy FROM assignments"), (std::vector<Row>{{std::string{"patient"}}}));
  EXPECT_GE(number_of(bus, "SELECT count(*) FROM kick_decisions WHERE fire = 1 AND policy = 'patient'"), 3);
  EXPECT_GE(number_of(bus, "SELECT count(*) FROM texts WHERE text LIKE '%[policy.own.patient]%near_m = 5.5%'"), 1)
      << "the log says its settings";
  EXPECT_THAT(loose_ends_of(folder_ / "bus.db"), IsEmpty());
}

TEST_F(OwnPolicy, ProgramsWithoutItReadItsSettingsAndRefuseToPlayIt) {
  std::ofstream{folder_ / "own.toml"} << "[policy.own.patient]\nnear_m = 4.0\n\n"
                                         "[kick_decision]\npolicy_by_half = [\"patient\"]\n";
  EXPECT_THAT(refusal("trivela-kick_decision", {"--config", "own.toml"}, 1),
              HasSubstr("the policy patient is another program's: use that program in place of this one"));
  std::ofstream{folder_ / "wrong.toml"} << "[policy.own.patient]\nneer_m = 4.0\n";
  EXPECT_THAT(refusal(TRIVELA_PATIENT, {"kick_decision", "--config", "wrong.toml"}, 1),
              HasSubstr("wrong.toml:2: policy.own.patient.neer_m: unknown key; did you mean near_m?"));
  EXPECT_THAT(refusal(TRIVELA_PATIENT,
                      {"simulate", "--arms", "patient", "--set", "policy.own.patient.near_m=21", "--out", "x.db"}, 1),
              HasSubstr("policy.own.patient.near_m = 21: must lie in [0, 20]"));
  EXPECT_THAT(refusal("trivela", {"simulate", "--arms", "patient", "--out", "x.db"}, 2),
              HasSubstr("\"patient\" is no policy"));
  EXPECT_THAT(refusal(TRIVELA_PATIENT, {"simulate", "--arms", "pateint", "--out", "x.db"}, 2),
              HasSubstr("\"pateint\" is no policy; did you mean patient?"));
  std::ofstream{folder_ / "capital.toml"} << "[policy.own.Patient]\nnear_m = 4.0\n";
  EXPECT_THAT(refusal("trivela-kick_decision", {"--config", "capital.toml"}, 1), HasSubstr("1 to 31 of a-z"));
}

TEST_F(OwnPolicy, AnExperimentGoesOnWithTheSameCodeAlone) {
  const std::vector<std::string> arguments{"simulate",      "--arms", "patient,moving", "--matches", "2",
                                           "--possessions", "3",      "--robot",        kRobot,      "--out",
                                           "ab.db"};
  patient(arguments);
  EXPECT_THAT(patient(arguments), HasSubstr("2 of 2 matches are in ab.db already"));
  const auto changed = folder_ / "changed";
  std::filesystem::copy_file(TRIVELA_PATIENT, changed);
  std::ofstream{changed, std::ios::app} << "other code";
  EXPECT_THAT(refusal(changed, arguments, 2), HasSubstr("was begun with other arguments: \"code of patient = "));
  const std::vector<std::string> study{"study", "arms",          "--arms", "moving,patient", "--matches",
                                       "2",     "--possessions", "3",      "--results",      "r.db"};
  patient(study);
  EXPECT_THAT(refusal(changed, study, 2), HasSubstr("\"code of patient = "));
}

TEST_F(OwnPolicy, ANameThatIsMistypedOnTheCommandLineIsRefused) {
  const std::string said =
      "policy.own.pateint.near_m=5: this program has no policy pateint of its own; did you mean patient?";
  EXPECT_THAT(refusal(TRIVELA_PATIENT,
                      {"simulate", "--arms", "patient", "--set", "policy.own.pateint.near_m=5", "--out", "x.db"}, 2),
              HasSubstr(said));
  EXPECT_THAT(refusal(TRIVELA_PATIENT,
                      {"match", "--half", "patient", "--set", "policy.own.pateint.near_m=5", "--out", "x.db"}, 2),
              HasSubstr(said));
  EXPECT_THAT(refusal("trivela", {"simulate", "--arms", "moving", "--set", "policy.own.patient.near_m=5"}, 2),
              HasSubstr("this program has no policy patient of its own"));
}

TEST_F(OwnPolicy, ThatFailsIsNamedAndThatHangsIsEndedByTheSecondSignal) {
  EXPECT_THAT(refusal(TRIVELA_ODD_POLICIES, {"simulate", "--arms", "throws", "--matches", "1", "--out", "x.db"}, 1),
              HasSubstr("policy throws: an idea that was none"));
  EXPECT_THAT(refusal(TRIVELA_ODD_POLICIES, {"Capital"}, 2), HasSubstr("trivela: policy \"Capital\": 1 to 31 of a-z"));
  Program hangs{TRIVELA_ODD_POLICIES, {"simulate", "--arms", "hangs", "--jobs", "2", "--out", "y.db"}, folder_.path()};
  ASSERT_TRUE(
      wait_for_change(folder_.path(), hangs.watch(), [&] { return std::filesystem::exists(folder_ / "hangs"); }));
  hangs.signal(SIGINT);
  ASSERT_TRUE(wait_for_change(folder_.path(), hangs.watch(),
                              [&] { return hangs.errors().find("once more stops at once") != std::string::npos; }));
  hangs.signal(SIGTERM);
  EXPECT_EQ(hangs.wait(), 128 + SIGTERM);
}

TEST_F(OwnPolicy, WhosePowerNoRobotHasIsToldSo) {
  Program strong{TRIVELA_ODD_POLICIES,
                 {"simulate", "--arms", "strong,moving", "--matches", "1", "--possessions", "3", "--out", "z.db"},
                 folder_.path(),
                 find_nodes};
  EXPECT_EQ(strong.wait(), 0) << strong.errors();
  EXPECT_THAT(strong.output(), testing::ContainsRegex("strong: [0-9]+ orders were refused, since their power lies "
                                                      "outside the robot's set-points\n"));
  EXPECT_THAT(strong.output(), testing::Not(HasSubstr("moving: ")));
}

TEST_F(OwnPolicy, IsTunedByItsOwnSettings) {
  EXPECT_THAT(patient({"study", "tune", "--help"}), HasSubstr("patient"));
  EXPECT_THAT(refusal("trivela", {"study", "tune", "patient"}, 2), HasSubstr("patient"));
}

}  // namespace
}  // namespace trivela::e2e
