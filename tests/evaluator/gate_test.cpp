#include "evaluator/render/gate.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "evaluator/table2/table2.hpp"

namespace trivela::evaluator {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Gate parsed(const std::string& text) { return parse_gate(text, report_gate_metrics()); }

std::string message_of(const std::string& text) {
  try {
    parsed(text);
    return "read";
  } catch (const BadGate& bad) {
    return bad.what();
  }
}

TEST(Gate, IsAMetricASubjectARelationAndANumber) {
  const Gate gate = parsed("efficiency(moving)>=0.7");
  EXPECT_EQ(gate.metric, "efficiency");
  EXPECT_EQ(gate.subject, "moving");
  EXPECT_EQ(gate.relation, Relation::kAtLeast);
  EXPECT_EQ(gate.bound, 0.7);
  EXPECT_EQ(gate.text, "efficiency(moving)>=0.7");
}

TEST(Gate, MayHaveARobotBlanksQuotesPercentAndNoSubject) {
  const Gate robot = parsed(" kicks ( moving paper , robot 12 ) > 3 ");
  EXPECT_EQ(robot.subject, "moving paper");
  EXPECT_EQ(robot.robot_id, 12);
  EXPECT_EQ(parsed("kicks(\"a, \\\"b\\\") c\")<3").subject, "a, \"b\") c");
  EXPECT_EQ(parsed("kicks(\"robot 1\")<3").subject, "robot 1");
  EXPECT_FALSE(parsed("kicks(\"robot 1\")<3").robot_id);
  EXPECT_EQ(parsed("efficiency(all)>70%").bound, 0.7);
  EXPECT_EQ(parsed("efficiency(all)>70%").subject, "");
  EXPECT_EQ(parsed("missing_rows==0").relation, Relation::kEqual);
  EXPECT_EQ(parsed("unknown_share<=-1e-3").bound, -1e-3);
}

TEST(Gate, ThatCannotBeReadSaysWhereAndWhatIsKnown) {
  EXPECT_THAT(message_of("efficency(moving)>=0.7"),
              AllOf(HasSubstr("character 1: 'efficency' is no metric, did you mean efficiency?"),
                    HasSubstr("kicks_per_min"), HasSubstr("missing_rows")));
  EXPECT_THAT(message_of(""), HasSubstr("character 1: a metric is missing"));
  EXPECT_THAT(message_of("kicks(moving>=3"), HasSubstr("character 16: ')' is missing"));
  EXPECT_THAT(message_of("kicks()>=3"), HasSubstr("character 7: a subject is missing"));
  EXPECT_THAT(message_of("kicks(a,b)>=3"), HasSubstr("character 9: a second subject"));
  EXPECT_THAT(message_of("kicks(all,b)>=3"), HasSubstr("character 11: a second subject"));
  EXPECT_THAT(message_of("kicks(robot x)>=3"), HasSubstr("character 7: write robot N"));
  EXPECT_THAT(message_of("kicks(robot 1,robot 2)>=3"), HasSubstr("character 15: a second robot"));
  EXPECT_THAT(message_of("kicks(\"a)>=3"), HasSubstr("the quote is not closed"));
  EXPECT_THAT(message_of("kicks=3"), HasSubstr("character 6: one of >= <= > < == is missing"));
  EXPECT_THAT(message_of("kicks>="), HasSubstr("character 8: a number is missing"));
  EXPECT_THAT(message_of("kicks>=nan"), HasSubstr("character 8: a number is missing"));
  EXPECT_THAT(message_of("kicks>=inf"), HasSubstr("a number is missing"));
  EXPECT_THAT(message_of("kicks>=1e999"), HasSubstr("a number is missing"));
  EXPECT_THAT(message_of("kicks>=3 of them"), HasSubstr("character 9: nothing may follow the number"));
  EXPECT_THAT(message_of("missing_rows(moving)==0"), HasSubstr("takes no subject"));
}

TEST(Gate, IsNeverPassedByNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const char* const relation : {">=", "<=", ">", "<", "=="})
    EXPECT_FALSE(parsed(std::string("kicks") + relation + "1").passes(nan)) << relation;
}

TEST(Gate, HoldsAtItsBoundAsItsRelationSays) {
  const auto passes = [](const char* relation, double value) {
    return parsed(std::string("kicks") + relation + "2").passes(value);
  };
  EXPECT_TRUE(passes(">=", 2.0) && passes("<=", 2.0) && passes("==", 2.0) && passes(">", 2.1) && passes("<", 1.9));
  EXPECT_FALSE(passes(">", 2.0) || passes("<", 2.0) || passes(">=", 1.9) || passes("<=", 2.1) || passes("==", 2.1));
}

PolicyRow row(const std::string& policy, std::int64_t inside, std::int64_t outside, std::int64_t unknown = 0) {
  PolicyRow row;
  row.policy = policy;
  row.kicks_by_outcome = {{"on_target", inside}, {"over", outside}, {"unknown", unknown}};
  return row;
}

Report two_policies() {
  Report report;
  report.policies = {row("stopped", 1, 3), row("moving", 6, 2, 2)};
  report.policies[1].played_min = 2.0;
  report.robots.resize(1);
  static_cast<PolicyRow&>(report.robots[0]) = row("moving", 4, 1);
  report.robots[0].robot_id = 3;
  return report;
}

GateResult judged_by(const Report& report, const std::string& gate) {
  const std::vector<Gate> gates{parsed(gate)};
  return judge_gates(report, gates).front();
}

TEST(GateOfAReport, AsksThePolicyTheRobotOrAll) {
  const Report report = two_policies();
  const auto value = [&](const std::string& metric) {
    return judged_by(report, metric + ">=0").measured.front().value.value_or(-1.0);
  };
  EXPECT_EQ(value("efficiency(moving)"), 0.75);
  EXPECT_EQ(value("efficiency(robot 3)"), 0.8);
  EXPECT_EQ(value("kicks(moving, robot 3)"), 5.0);
  EXPECT_NEAR(value("efficiency"), 7.0 / 12.0, 1e-15);
  EXPECT_EQ(value("unknown_share(moving)"), 0.2);
  EXPECT_EQ(value("kicks_per_min(moving)"), 5.0);
  EXPECT_EQ(value("on_target_per_min(moving)"), 3.0);
  EXPECT_NEAR(value("efficiency_lo(moving)"), stats::wilson({6, 8}).lo, 1e-15);
  EXPECT_EQ(value("missing_rows"), 0.0);
}

TEST(GateOfAReport, IsMissedWhereThereAreNoDataAndSaysWhy) {
  const Report report = two_policies();
  for (const auto& [gate, why] : {std::pair{"kicks_per_min(stopped)<=9", "no minutes"},
                                  std::pair{"kicks(movin)>=0", "there is no 'movin' (stopped, moving)"},
                                  std::pair{"kicks(robot 9)>=0", "no row of robot 9"},
                                  std::pair{"truth_agreement<=1", "nothing to make it of"}}) {
    const GateResult result = judged_by(report, gate);
    EXPECT_FALSE(result.met) << gate;
    EXPECT_THAT(result.sentence(), AllOf(HasSubstr("gate MISSED: "), HasSubstr("no data"), HasSubstr(why)));
  }
  Report empty;
  empty.policies = {row("moving", 0, 0)};
  EXPECT_FALSE(judged_by(empty, "efficiency(moving)<=1").met) << "0 of 0";
  EXPECT_FALSE(judged_by(empty, "efficiency_lo(moving)<=1").met);
  EXPECT_FALSE(judged_by(Report{}, "kicks>=0").met);
}

TEST(GateOfAReport, DoesNotAddUpArms) {
  Report report = two_policies();
  report.robots.clear();
  report.policies = {row("moving", 6, 2), row("moving", 1, 2)};
  report.policies[0].arm = "moving";
  report.policies[1].arm = "moving paper";
  EXPECT_THAT(judged_by(report, "efficiency>=0").sentence(), HasSubstr("2 arms met the same opportunities"));
  EXPECT_EQ(judged_by(report, "efficiency(moving)>=0").measured.front().value, 0.75) << "the arm of that name";
}

}  // namespace
}  // namespace trivela::evaluator
