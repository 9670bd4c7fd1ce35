#include "cli/compare/compare_input.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/verbs.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/evaluator/log_fixture.hpp"

namespace trivela::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

// `kicks` rows of one group and situation, `inside` of them on target.
std::string rows(const std::string& group, const std::string& situation, int inside, int kicks) {
  std::string text;
  for (int i = 0; i < kicks; ++i) text += group + "," + (i < inside ? "1" : "0") + "," + situation + "\n";
  return text;
}

class CompareCsv : public evaluator::LogTest {
 protected:
  std::string output_of(const std::string& csv, const std::string& flags = "") {
    std::ofstream(path("kicks.csv")) << csv;
    CLI::App app;
    int exit_code = -1;
    add_compare(app, exit_code);
    testing::internal::CaptureStdout();
    try {
      app.parse("compare --all --csv " + path("kicks.csv").string() + " " + flags);
    } catch (const std::exception& error) {
      testing::internal::GetCapturedStdout();
      return error.what();
    }
    EXPECT_EQ(exit_code, kDone);
    return testing::internal::GetCapturedStdout();
  }
  nlohmann::json json_of(const std::string& csv, const std::string& flags = "") {
    return nlohmann::json::parse(output_of(csv, flags + " --json"));
  }
};

void expect_near(const nlohmann::json& value, double expected, double tolerance = 5e-10) {
  EXPECT_NEAR(value.get<double>(), expected, tolerance);
}

std::string near_and_far() {
  return "policy,on_target,distance_m\n" + rows("old", "2.5", 45, 50) + rows("new", "2.5", 28, 30) +
         rows("old", "6.5", 5, 25) + rows("new", "6.5", 45, 120);
}

// R: binom.test(2, 4) and binom.test(3, 4).
TEST_F(CompareCsv, FewKicksHaveExactIntervalsAndTheTextSaysSo) {
  const std::string text = output_of("policy,on_target,place\n" + rows("old", "x", 2, 4) + rows("new", "x", 3, 4));
  EXPECT_THAT(text, HasSubstr("50.0 %   6.8 % to 93.2 %"));
  EXPECT_THAT(text, HasSubstr("75.0 %  19.4 % to 99.4 %"));
  EXPECT_THAT(text, HasSubstr("of fewer than 24 kicks no narrower than Clopper and Pearson's"));
  EXPECT_THAT(text, HasSubstr("-45.4 to +74.6 (Newcombe, exact ends for few kicks, kicks independent)"));
  const std::string many = output_of("policy,on_target,place\n" + rows("old", "x", 12, 24) + rows("new", "x", 18, 24));
  EXPECT_THAT(many, Not(HasSubstr("Clopper and Pearson's")));
}

TEST_F(CompareCsv, KicksFromNearAndFarAreSimpsonsParadox) {
  const auto json = json_of(near_and_far(), "--stratify distance");
  const auto& pair = json["comparisons"][0];
  EXPECT_EQ(pair["old"], "old");
  expect_near(pair["efficiency"]["difference"], 73.0 / 150.0 - 50.0 / 75.0);
  expect_near(pair["independent_kicks"]["odds_ratio"], 0.474025974);
  expect_near(pair["independent_kicks"]["fisher_two_sided_p"], 0.0110500721);
  const auto& strata = pair["stratified"];
  EXPECT_EQ(strata["strata"].size(), 2U);
  EXPECT_EQ(strata["strata"][0]["name"], "under 3 m");
  EXPECT_EQ(strata["strata"][0]["reversed"], true);
  expect_near(strata["mh_odds_ratio"], 2.144018583);
  expect_near(strata["mh_odds_ratio_ci95"][1], 5.222652600784);
  expect_near(strata["cmh"]["chi_square"], 2.896785281);
  expect_near(strata["cmh"]["p"], 0.088756399);
  expect_near(strata["mh_risk_difference_ci95"][0], -0.004414315);
  expect_near(strata["standardised"]["new"], 0.573518519);
  expect_near(strata["standardised"]["old"], 0.448888889);
  expect_near(strata["breslow_day"]["p"], 0.670179515);
  EXPECT_EQ(strata["simpson"], true);
  EXPECT_EQ(pair["headline"]["adjusted"], true);
  EXPECT_GT(pair["headline"]["difference"].get<double>(), 0.0) << "the verdict is that of the same mix of distances";
  const std::string text = output_of(near_and_far(), "--stratify distance");
  EXPECT_THAT(text, HasSubstr("Simpson's paradox"));
  EXPECT_THAT(text, HasSubstr("on the same mix of distance"));
}

TEST_F(CompareCsv, TheAdmissionsOfBerkeleyAreThoseOfR) {
  const std::string csv = "gender,on_target,department\n" + rows("women", "A", 89, 108) + rows("women", "B", 17, 25) +
                          rows("women", "C", 202, 593) + rows("women", "D", 131, 375) + rows("women", "E", 94, 393) +
                          rows("women", "F", 24, 341) + rows("men", "A", 512, 825) + rows("men", "B", 353, 560) +
                          rows("men", "C", 120, 325) + rows("men", "D", 138, 417) + rows("men", "E", 53, 191) +
                          rows("men", "F", 22, 373);
  const auto json = json_of(csv, "--by gender --stratify department");
  const auto& strata = json["comparisons"][0]["stratified"];
  expect_near(json["comparisons"][0]["independent_kicks"]["odds_ratio"], 1.84108004, 5e-9);
  expect_near(strata["mh_odds_ratio"], 0.904696828);
  expect_near(strata["mh_odds_ratio_ci95"][0], 0.771907362);
  expect_near(strata["cmh"]["chi_square"], 1.524606660, 5e-9);
  expect_near(strata["cmh_corrected"]["p"], 0.232263463);
}

TEST_F(CompareCsv, ThePapersKicksSayThatTheyDifferAndNotWhy) {
  const std::string csv =
      "policy,on_target,season\n" + rows("stopped", "2014", 34, 65) + rows("moving", "2015", 100, 132);
  const std::string text = output_of(csv);
  EXPECT_THAT(text,
              HasSubstr("moving differs from stopped in efficiency (on target of kicks): +23.4 percentage points, "
                        "95 % +9.3 to +37.0"));
  EXPECT_THAT(text, HasSubstr("before and after"));
  EXPECT_THAT(text, Not(HasSubstr("because of")));
  EXPECT_THAT(text, HasSubstr("Which kick belongs to which match is not known"));
  EXPECT_THAT(text, HasSubstr("neither opportunities nor minutes"));
  EXPECT_THAT(text, HasSubstr("E-value"));
  const auto json = json_of(csv);
  EXPECT_EQ(json["comparisons"][0]["headline"]["verdict"], "better");
  EXPECT_EQ(json["comparisons"][0]["independent_kicks"]["fragility"]["new"], 12);
  EXPECT_THAT(output_of(csv, "--design randomised"), HasSubstr("because of the policy: it was drawn at random"));
  EXPECT_THAT(output_of(csv, "--baseline moving"), HasSubstr("stopped against moving"));
}

TEST_F(CompareCsv, FewKicksSayHowManyMoreAreNeeded) {
  const auto csv = "policy,on_target,x\n" + rows("a", "1", 10, 20) + rows("b", "1", 12, 20);
  const std::string text = output_of(csv);
  EXPECT_THAT(text, HasSubstr("not enough data to tell b from a"));
  EXPECT_THAT(text, HasSubstr("more kicks of the one that has fewer"));
  EXPECT_GT(json_of(csv)["comparisons"][0]["headline"]["needed_of_each_for_smallest"], 1000.0);
}

TEST_F(CompareCsv, MatchesWidenTheIntervalsAndMinutesGiveRates) {
  std::string csv = "policy,on_target,match,minutes\n";
  for (int match = 0; match < 6; ++match) {
    const std::string old_match = "old" + std::to_string(match) + ",50",
                      new_match = "new" + std::to_string(match) + ",30";
    csv += rows("old", new_match, match < 3 ? 1 : 9, 10) + rows("new", old_match, match < 3 ? 3 : 10, 10);
  }
  const auto json = json_of(csv);
  const auto& pair = json["comparisons"][0];
  EXPECT_EQ(pair["headline"]["by_match"], true);
  EXPECT_GT(pair["efficiency"]["clustered"]["design_effect"], 3.0);
  expect_near(json["groups"][0]["minutes"], 180.0);
  expect_near(pair["on_target_per_min"]["ratio"], (39.0 / 300.0) / (30.0 / 180.0), 1e-12);
  EXPECT_THAT(output_of(csv), HasSubstr("clustered by match: 6 and 6 matches"));
}

TEST_F(CompareCsv, RowsOfOpportunitiesCountThoseWithoutAKick) {
  const std::string csv =
      "policy,on_target,kicked,match,opportunity\n"
      "a,1,1,m,1\na,,0,m,2\na,0,1,m,3\na,,0,m,4\n"
      "b,1,1,m,1\nb,1,1,m,2\nb,1,1,m,3\nb,,0,m,4\n";
  const auto json = json_of(csv, "--design paired");
  EXPECT_EQ(json["groups"][0]["opportunities"], 4);
  EXPECT_EQ(json["groups"][0]["kicks"], 2);
  const auto& pair = json["comparisons"][0];
  EXPECT_EQ(pair["pairs"]["new_only"], 2);
  expect_near(pair["pairs"]["mcnemar_p"], 0.5);
  EXPECT_EQ(pair["headline"]["measure"], "on_target_per_opportunity");
  expect_near(pair["headline"]["difference"], 0.5);
  EXPECT_THAT(output_of(csv, "--design paired"), HasSubstr("Fewer than five matches"));
}

TEST_F(CompareCsv, SeveralGroupsAreComparedWithTheFirstByHolm) {
  const auto csv = "policy,on_target,x\n" + rows("a", "1", 10, 40) + rows("b", "1", 22, 40) + rows("c", "1", 12, 40);
  const auto json = json_of(csv);
  ASSERT_EQ(json["comparisons"].size(), 2U);
  const double p = json["comparisons"][0]["headline"]["p"];
  expect_near(json["comparisons"][0]["headline"]["p_holm"], 2.0 * p, 1e-12);
  EXPECT_THAT(output_of(csv), HasSubstr("after Holm's adjustment for 2 comparisons"));
}

TEST_F(CompareCsv, UnknownOutcomesAreCountedAndBounded) {
  const std::string csv = "policy,on_target\n" + std::string("a,1\na,0\na,\na,\nb,1\nb,1\nb,0\nb,\n");
  const auto json = json_of(csv);
  EXPECT_EQ(json["groups"][0]["unknown"], 2);
  expect_near(json["groups"][0]["efficiency_bounds"][1], 0.75);
  expect_near(json["comparisons"][0]["difference_bounds"][0], 0.5 - 0.75);
  expect_near(json["comparisons"][0]["difference_bounds"][1], 0.75 - 0.25);
  EXPECT_THAT(output_of(csv), HasSubstr("3 outcomes are unknown"));
}

TEST_F(CompareCsv, GroupsWithoutAKnownKickOrWithOneResultGiveSentences) {
  EXPECT_THAT(output_of("policy,on_target\na,1\nb,\n"), HasSubstr("b has no kick whose outcome is known"));
  EXPECT_THAT(output_of("policy,on_target\na,1\na,1\nb,0\nb,0\n"), HasSubstr("b against a"));
  EXPECT_THAT(output_of("policy,on_target\na,1\na,1\nb,1\n"), HasSubstr("not enough data"));
  EXPECT_THAT(output_of("policy,on_target\na,1\n"), HasSubstr("the only policy is 'a': a comparison needs two"));
  EXPECT_THAT(output_of("policy,on_target\n"), HasSubstr("there are no kicks"));
  EXPECT_THAT(output_of("policy,on_target,kicked\na,,0\nb,,0\n"), HasSubstr("2 opportunities but no kick"));
}

TEST_F(CompareCsv, SaysWhereTheTableIsWrong) {
  EXPECT_THAT(output_of(""), HasSubstr("no header line"));
  EXPECT_THAT(output_of("a,b\n"), HasSubstr("no column policy in the header (a, b)"));
  EXPECT_THAT(output_of("policy,on_target,on_target\n"), HasSubstr("stands 2 times"));
  EXPECT_THAT(output_of("policy,on_target\na,1\na,2\n"),
              HasSubstr("kicks.csv:3: column on_target: '2' is neither 1 nor 0"));
  EXPECT_THAT(output_of("policy,on_target\na,yes\n"), HasSubstr("column on_target: 'yes' is not a number"));
  EXPECT_THAT(output_of("policy,on_target\n,1\n"), HasSubstr("kicks.csv:2: column policy: is empty"));
  EXPECT_THAT(output_of("policy,on_target\na\n"), HasSubstr("kicks.csv:2: column on_target"));
  EXPECT_THAT(output_of("policy,on_target,kicked\na,1,0\n"), HasSubstr("without a kick"));
  EXPECT_THAT(output_of("policy,on_target,minutes\na,1,0\n"), HasSubstr("column minutes: '0' is not above 0"));
  EXPECT_THAT(output_of("policy,on_target,minutes\na,1,5\na,1,6\n"), HasSubstr("differs from 5 in an earlier row"));
  EXPECT_THAT(output_of("policy,on_target\na,1\n", "--stratify distance"), HasSubstr("no column distance_m"));
  EXPECT_THAT(output_of("policy,on_target,distance_m\na,1,-2\n", "--stratify distance"), HasSubstr("'-2' is negative"));
  EXPECT_THAT(output_of("policy,on_target\na,1\nb,1\n", "--baseline z"), HasSubstr("there is no such policy (a, b)"));
  EXPECT_THAT(output_of("policy,on_target\na,1\nb,1\n", "--counts a=1/2"), HasSubstr("one of the three"));
  EXPECT_THAT(output_of("policy,on_target\na,1\nb,1\n", "--smallest-effect 0"), HasSubstr("between 0 and 100"));
  EXPECT_THAT(output_of("policy,on_target\na,1\nb,1\n", "--smallest-effect nan"), HasSubstr("between 0 and 100"));
}

TEST_F(CompareCsv, ANameThatTheTableHasNotIsBadUsage) {
  std::ofstream(path("kicks.csv")) << "policy,on_target\na,1\nb,0\n";
  for (const char* const flag : {"--by foo", "--stratify foo", "--stratify distance", "--baseline foo"})
    EXPECT_THROW(run_verbs({add_compare}, "compare --csv " + path("kicks.csv").string() + " " + flag), UsageError)
        << flag;
}

TEST_F(CompareCsv, ABadDistanceIsRefusedWhetherOrNotAnybodyStratifies) {
  EXPECT_THAT(output_of("policy,on_target,distance_m\na,1,far\n"),
              HasSubstr("kicks.csv:2: column distance_m: 'far' is not a number"));
  EXPECT_THAT(output_of("policy,on_target,distance_m\na,1,-2\n"), HasSubstr("column distance_m: '-2' is negative"));
  EXPECT_THAT(output_of("policy,on_target,distance_m\na,1,\nb,0,3\n"), HasSubstr("b against a"));
}

TEST_F(CompareCsv, OutcomesAreAsTheTableSays) {
  const std::string csv = "policy,on_target\na,1\nb,0\n";
  EXPECT_THAT(output_of(csv), HasSubstr("Outcomes: as the table says.\n"));
  EXPECT_THAT(run_verbs({add_compare}, "compare --csv " + path("kicks.csv").string()).out,
              HasSubstr("outcomes as the table says"));
  EXPECT_EQ(json_of(csv)["outcome"], "table");
}

TEST_F(CompareCsv, WhatHoldsForTheWholeTableNamesTheFile) {
  EXPECT_THAT(output_of("policy,on_target\n"), HasSubstr("kicks.csv: there are no kicks"));
  EXPECT_THAT(output_of("policy,on_target\na,1\n"), HasSubstr("kicks.csv: the only policy is 'a'"));
  EXPECT_THAT(output_of("policy,on_target,kicked\na,,0\nb,,0\n"), HasSubstr("kicks.csv: there are 2 opportunities"));
}

TEST_F(CompareCsv, ATextThatIsNoCsvIsRefusedAndNotCounted) {
  const std::string csv = "policy,on_target,note\na,1,q\nb,0,w\na,1,\"x\na,1,y\na,0,z\nb,1,w\nb,0,v\n";
  EXPECT_THAT(output_of(csv), HasSubstr("kicks.csv:4: column 3: the quote that opens here is never closed"));
  for (const char* flags : {"", "--json"}) {
    EXPECT_THAT(output_of("policy,on_target\na,1\nb\xE9,0\n", flags),
                HasSubstr("kicks.csv:3: column 1: byte 0xE9 is not UTF-8"));
  }
}

TEST_F(CompareCsv, AnOpportunityIsPlayedOnceByEachGroup) {
  const std::string csv = "policy,on_target,match,opportunity\na,1,m,1\nb,0,m,1\na,1,n,1\na,0,m,1\nb,1,m,2\n";
  const auto refusal =
      HasSubstr("kicks.csv:5: column opportunity: '1' stands in line 2 already, with policy 'a' and match 'm'");
  EXPECT_THAT(output_of(csv), refusal);
  EXPECT_THAT(output_of(csv, "--design paired"), refusal);
  // Without matches it may be another match's, unless all are said to be pairs.
  const std::string no_matches = "policy,on_target,opportunity\na,1,1\nb,0,1\na,1,1\n";
  EXPECT_THAT(output_of(no_matches), HasSubstr("b against a"));
  EXPECT_THAT(output_of(no_matches, "--design paired"), HasSubstr("'1' stands in line 2 already, with policy 'a'"));
}

TEST_F(CompareCsv, StrataAreNeitherTheOutcomeNorTheGroups) {
  const std::string csv = "policy,on_target,kicked,floor\na,1,1,x\nb,0,1,x\n";
  EXPECT_THAT(output_of(csv, "--stratify on_target"), HasSubstr("--stratify on_target: that is the outcome"));
  EXPECT_THAT(output_of(csv, "--stratify kicked"), HasSubstr("--stratify kicked: that is the outcome"));
  EXPECT_THAT(output_of(csv, "--by on_target"), HasSubstr("--by on_target: that is the outcome"));
  EXPECT_THAT(output_of(csv, "--stratify policy"), HasSubstr("--stratify policy: within one policy there is nothing"));
  EXPECT_THAT(output_of(csv, "--by floor --stratify floor"), HasSubstr("within one floor there is nothing"));
}

}  // namespace
}  // namespace trivela::cli
