// What a comparison calls the same opportunity, and whom it calls its cause.
#include <gmock/gmock.h>

#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/counting/log_kicks.hpp"
#include "evaluator/sessions/session_facts.hpp"
#include "tests/evaluator/experiment_fixture.hpp"

namespace trivela::evaluator {
namespace {

using testing::Contains;
using testing::HasSubstr;

struct PlayedArm {
  std::string name;
  std::string policy;
  std::string table = "new";
  std::string settings = "gain = 1";
  std::string scenario = "far = 2";
  std::int64_t inside = 5;  // of ten opportunities a match
};

class ComparedAlike : public LogTest {
 protected:
  // Six matches of ten opportunities for each arm.
  void write(const std::string& file, const std::vector<PlayedArm>& arms, const std::string& run = "test") {
    TestExperiment experiment(path(file), 6);
    experiment.run = run;
    for (std::uint32_t match = 0; match < 6; ++match) {
      experiment.begin();
      for (std::uint32_t arm = 0; arm < arms.size(); ++arm) {
        const PlayedArm& played = arms[arm];
        experiment.table = played.table;
        experiment.config = "### settings\npolicy_by_half = [\"" + played.policy + "\"]\n" + played.settings +
                            "\n### scenario\n" + played.scenario + "\n";
        experiment.session(match, arm, played.name, {{1, played.policy}});
        experiment.played(1, 10.0);
        for (std::int64_t i = 1; i <= 10; ++i)
          experiment.possession(1, i, played.policy, 1.0, i <= played.inside ? kIn : kOut);
      }
      experiment.commit();
    }
    experiment.finish();
  }

  PolicyComparison compared(LogKicks options, const std::vector<std::string>& files = {"match.db"}) const {
    std::vector<std::filesystem::path> logs;
    for (const std::string& file : files) logs.push_back(path(file));
    std::string by;
    KickDataset dataset = read_log_kicks(logs, options, by);
    return compare_policies(std::move(dataset), by);
  }

  std::string message_of(LogKicks options, const std::vector<std::string>& files = {"match.db"}) const {
    try {
      compared(std::move(options), files);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(ComparedAlike, TablesAreComparedUnderThePoliciesThatBothHad) {
  write("match.db", {{.name = "a", .policy = "stopped", .inside = 3},
                     {.name = "b", .policy = "stopped", .table = "old", .inside = 2},
                     {.name = "c", .policy = "moving", .inside = 9}});
  const auto result = compared({.by = "table"});
  EXPECT_EQ(result.pairs[0].design, Design::kPaired);
  EXPECT_EQ(result.pairs[0].pairs->n(), 60);
  EXPECT_NEAR(result.pairs[0].headline->difference, 0.1, 1e-12) << "moving had the new table alone";
  EXPECT_EQ(result.groups[1].opportunities, 60);
  EXPECT_NEAR(*result.groups[1].played_min, 60.0, 1e-9);
  EXPECT_THAT(result.dataset.remarks,
              Contains(HasSubstr("60 opportunities of 'new' left out: their policy or settings")));
}

TEST_F(ComparedAlike, PoliciesAreComparedWithTheTablesThatAllHad) {
  write("match.db", {{.name = "a", .policy = "stopped", .inside = 3},
                     {.name = "b", .policy = "stopped", .table = "old", .inside = 1},
                     {.name = "c", .policy = "moving", .inside = 9}});
  const auto result = compared({.by = "policy"});
  EXPECT_NEAR(result.pairs[0].headline->difference, 0.6, 1e-12);
  EXPECT_EQ(result.groups[0].opportunities, 60);
  EXPECT_THAT(result.dataset.remarks, Contains(HasSubstr("60 opportunities of 'stopped' left out: their table")));
}

TEST_F(ComparedAlike, PoliciesWithOtherSettingsAreNotCalledTheCause) {
  write("match.db", {{.name = "a", .policy = "stopped"}, {.name = "b", .policy = "moving", .table = "old"}});
  EXPECT_EQ(compared({.by = "policy"}).pairs[0].design, Design::kBeforeAfter);
  EXPECT_EQ(compared({.by = "arm"}).pairs[0].design, Design::kPaired) << "an arm is its table, too";
  write("gain.db", {{.name = "a", .policy = "stopped"}, {.name = "b", .policy = "moving", .settings = "gain = 2"}});
  EXPECT_EQ(compared({.by = "policy"}, {"gain.db"}).pairs[0].design, Design::kBeforeAfter);
}

TEST_F(ComparedAlike, WithoutACommonTableThreePoliciesHaveNoComparison) {
  write("match.db", {{.name = "a", .policy = "stopped"},
                     {.name = "b", .policy = "moving"},
                     {.name = "c", .policy = "predictive", .table = "old"},
                     {.name = "d", .policy = "stopped", .table = "old"}});
  EXPECT_THAT(message_of({.by = "policy"}), HasSubstr("no table with the same settings was played with each policy"));
}

TEST_F(ComparedAlike, OneNameForArmsThatDifferIsRefused) {
  write("a.db", {{.name = "stopped", .policy = "stopped"}, {.name = "moving", .policy = "moving"}});
  write("b.db", {{.name = "moving", .policy = "moving", .settings = "gain = 2"}}, "other");
  EXPECT_THAT(message_of({.by = "arm"}, {"a.db", "b.db"}),
              HasSubstr("arm 'moving' was played twice on the same opportunities"));
}

TEST_F(ComparedAlike, AMatchThatWasPlayedAgainCountsOnce) {
  write("a.db", {{.name = "stopped", .policy = "stopped"}, {.name = "moving", .policy = "moving"}});
  write("b.db", {{.name = "moving", .policy = "moving"}}, "with other flags");
  const auto result = compared({.by = "arm"}, {"a.db", "b.db"});
  EXPECT_EQ(result.groups[1].opportunities, 60);
  EXPECT_NEAR(*result.groups[1].played_min, 60.0, 1e-9);
  EXPECT_THAT(result.dataset.remarks, Contains(HasSubstr("6 of its matches were played before with the same seed")));
}

TEST_F(ComparedAlike, AnotherWorldOfTheSameNameHasOtherOpportunities) {
  write("a.db", {{.name = "stopped", .policy = "stopped"}});
  write("b.db", {{.name = "moving", .policy = "moving", .scenario = "far = 4"}}, "other");
  const auto result = compared({.by = "arm"}, {"a.db", "b.db"});
  EXPECT_EQ(result.pairs[0].design, Design::kBeforeAfter);
  EXPECT_FALSE(result.pairs[0].pairs);
  EXPECT_THAT(result.dataset.remarks, Contains(HasSubstr("scenario 'empty_field' is not the same in all sessions")));
}

TEST_F(ComparedAlike, DrawsWithOtherProbabilitiesArePooledByNobody) {
  TestExperiment experiment(path(), 6);
  for (std::uint32_t match = 0; match < 6; ++match) {
    experiment.begin();
    for (const std::uint32_t arm : {0U, 1U}) {
      experiment.table = arm == 0 ? "new" : "old";
      experiment.session(match, arm, arm == 0 ? "often" : "seldom", {});
      for (std::int64_t i = 1; i <= 8; ++i) {
        const bool moving = (i <= 6) == (arm == 0);
        experiment.possession(1, i, moving ? "moving" : "stopped", i <= 6 ? 0.75 : 0.25, i % 2 == 0 ? kIn : kOut);
      }
    }
    experiment.commit();
  }
  experiment.finish();
  const auto pooled = compared({.by = "policy"});
  EXPECT_EQ(pooled.pairs[0].design, Design::kBeforeAfter);
  EXPECT_THAT(pooled.dataset.design_reason, HasSubstr("not everywhere with the same probability"));
  const auto within = compared({.by = "policy", .stratify = "arm"});
  EXPECT_EQ(within.pairs[0].design, Design::kRandomised);
  EXPECT_TRUE(within.pairs[0].headline->adjusted);
}

TEST(SetupIndex, TellsWorldsAndSettingsApartButNotWhoPlays) {
  SetupIndex dataset;
  const auto of = [&](const std::string& charge, const std::string& gain, const std::string& world) {
    return dataset.of("### settings\n" + charge + gain + "\n### scenario\n" + world);
  };
  const SessionSetup first = of("policy_by_half = [\"moving\"]\n", "gain = 1\n", "far = 2\n");
  EXPECT_EQ(of("random = [\"moving\", \"stopped\"]\n", "gain = 1\n", "far = 2\n").settings, first.settings);
  EXPECT_NE(of("", "gain = 2\n", "far = 2\n").settings, first.settings);
  EXPECT_EQ(of("", "gain = 2\n", "far = 2\n").world, first.world);
  EXPECT_NE(of("", "gain = 1\n", "far = 3\n").world, first.world);
  EXPECT_EQ(dataset.of("").world, dataset.of("### settings\na = 1\n").world) << "no scenario is one world";
}

}  // namespace
}  // namespace trivela::evaluator
