#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/compare/compare_input.hpp"
#include "cli/verbs.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string output_of(const std::string& arguments) {
  CLI::App app;
  int exit_code = -1;
  add_compare(app, exit_code);
  testing::internal::CaptureStdout();
  app.parse(arguments + " --all");
  EXPECT_EQ(exit_code, kDone);
  return testing::internal::GetCapturedStdout();
}

std::string message_of(const std::vector<std::string>& counts) {
  try {
    parse_two_counts(counts);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(Compare, ReadsTwoNamedCounts) {
  const auto [older, newer] = parse_two_counts({"2014=34/65", "with=new/way=100/132"});
  EXPECT_EQ(older.name, "2014");
  EXPECT_EQ(older.counts.inside, 34);
  EXPECT_EQ(older.counts.n, 65);
  EXPECT_EQ(newer.counts.n, 132);
}

TEST(Compare, NamesTheGroupsAndClaimsNoCause) {
  const std::string text = output_of("compare --counts left=34/65 right=100/132");
  EXPECT_THAT(text, HasSubstr("P(right > left)       0.999473"));
  EXPECT_THAT(text, HasSubstr("right differs from left, the more for right"));
  EXPECT_THAT(text, Not(HasSubstr("better")));
  EXPECT_THAT(output_of("compare --counts a=1/1000 b=999/1000"),
              HasSubstr("below 1e-12 percentage points by choosing b"));
}

TEST(Compare, SaysWhatIsWrongWithACount) {
  EXPECT_THAT(message_of({"old=70/65", "new=1/2"}), HasSubstr("'old=70/65': 70 inside of only 65 kicks"));
  EXPECT_THAT(message_of({"old=1/2", "new=x/3"}), HasSubstr("'new=x/3': INSIDE and KICKS must be whole numbers"));
  EXPECT_THAT(message_of({"old=1/2", "new=1.5/3"}), HasSubstr("whole numbers"));
  EXPECT_THAT(message_of({"old=1/2", "new=/3"}), HasSubstr("whole numbers"));
  EXPECT_THAT(message_of({"old=1/2", "new=1/2/3"}), HasSubstr("whole numbers"));
  EXPECT_THAT(message_of({"old=0/0", "new=1/2"}), HasSubstr("without a kick"));
  EXPECT_THAT(message_of({"old=-1/2", "new=1/2"}), HasSubstr("negative"));
  EXPECT_THAT(message_of({"old=1/-2", "new=1/2"}), HasSubstr("negative"));
  EXPECT_THAT(message_of({"old=1/99999999999999999999", "new=1/2"}), HasSubstr("more than"));
  EXPECT_THAT(message_of({"34/65", "new=1/2"}), HasSubstr("NAME=INSIDE/KICKS"));
  EXPECT_THAT(message_of({"=34/65", "new=1/2"}), HasSubstr("NAME=INSIDE/KICKS"));
  EXPECT_THAT(message_of({"old=3465", "new=1/2"}), HasSubstr("NAME=INSIDE/KICKS"));
}

TEST(Compare, NeedsExactlyTwoNames) {
  EXPECT_THAT(message_of({"old=1/2"}), HasSubstr("there is 1"));
  EXPECT_THAT(message_of({"a=1/2", "b=1/2", "c=1/2"}), HasSubstr("there are 3"));
  EXPECT_THAT(message_of({"a=1/2", "a=1/3"}), HasSubstr("both are called 'a'"));
}

TEST(Compare, ThePapersCountsGiveThePublishedNumbers) {
  const auto json = nlohmann::json::parse(output_of("compare --counts old=34/65 new=100/132 --json"));
  const auto near = [&](const nlohmann::json& value, double expected) {
    EXPECT_NEAR(value.get<double>(), expected, 1e-9);
  };
  near(json["old"]["efficiency"], 0.5230769231);
  near(json["old"]["wilson95"][0], 0.4037962961);
  near(json["old"]["wilson95"][1], 0.6397820947);
  near(json["new"]["efficiency"], 0.7575757576);
  near(json["new"]["wilson95"][0], 0.6778581786);
  near(json["difference"], 0.2344988345);
  near(json["newcombe95"][0], 0.0931659315);
  near(json["newcombe95"][1], 0.3704118230);
  near(json["relative_gain"], 0.4483065954);
  near(json["risk_ratio"], 1.4483065954);
  near(json["risk_ratio_ci95"][0], 1.1263746373);
  near(json["risk_ratio_ci95"][1], 1.8622507332);
  near(json["fisher_two_sided_p"], 0.0011768787);
  near(json["boschloo_one_sided_p"], 0.0005579792);
  near(json["boschloo_two_sided_p"], 0.0011159585);
  near(json["p_new_better"], 0.9994725290);
  EXPECT_THAT(json["two_sided_definition"]["boschloo"], HasSubstr("twice"));
  EXPECT_THAT(json["two_sided_definition"]["fisher"], HasSubstr("sum of the probabilities"));
}

TEST(Compare, TextOfThePapersCountsStatesWhatItsProseGotWrong) {
  const std::string text = output_of("compare --counts old=34/65 new=100/132");
  for (const char* const part : {"52.3 %  40.4 % to 64.0 %", "75.8 %  67.8 % to 82.3 %", "+9.3 to +37.0 (Newcombe)",
                                 "+44.8 % from the counts", "46 %", "0.00118 two-sided (sum", "twice the smaller",
                                 "0.999473", "47.7 %", "83 %", "negligible", "no rate", "Proving"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(Compare, OtherCountsSayNothingOfThePaper) {
  for (const char* const counts : {"old=34/65 new=101/132", "new=100/132 old=34/65"}) {
    EXPECT_THAT(output_of(std::string("compare --counts ") + counts), Not(HasSubstr("paper")));
  }
}

TEST(Compare, NothingInsideLeavesTheRatiosOpen) {
  const auto json = nlohmann::json::parse(output_of("compare --counts old=0/5 new=3/5 --json"));
  EXPECT_TRUE(json["relative_gain"].is_null());
  EXPECT_TRUE(json["risk_ratio"].is_null());
  EXPECT_TRUE(json["risk_ratio_ci95"].is_null());
  EXPECT_THAT(output_of("compare --counts old=0/5 new=3/5"), HasSubstr("nothing was inside before"));
}

int count_of_lines(const std::string& text) { return static_cast<int>(std::ranges::count(text, '\n')); }

TEST(CompareInShort, SaysOfCountsWhoIsBetterByHowMuchHowSureAndHowManyMoreAreNeeded) {
  const std::string text = run_verbs({add_compare}, "compare --counts old=34/65 new=100/132").out;
  EXPECT_THAT(text,
              testing::StartsWith("new differs from old: +23.4 points in efficiency, 95 % +9.3 to +37.0, p 0.00112; no "
                                  "more kicks needed\n"));
  EXPECT_EQ(count_of_lines(text), 2);
  EXPECT_THAT(run_verbs({add_compare}, "compare --counts old=34/65 new=36/65").out,
              AllOf(testing::StartsWith("new against old, not enough data: +3.1 points"),
                    testing::ContainsRegex("about [0-9]+ more kicks of the one with fewer for 5.0 points\n")));
  EXPECT_THAT(run_verbs({add_compare}, "compare --counts a=5000/10000 b=5010/10000").out,
              testing::StartsWith("b and a are alike within 5.0 points: "));
  EXPECT_THAT(run_verbs({add_compare}, "compare --counts a=90/100 b=10/100").out,
              testing::StartsWith("b differs from a: -80.0 points"));
}

class CompareLogs : public evaluator::LogTest {
 protected:
  void write(const std::string& name, std::int64_t seed, int half, int inside, const std::string& config) {
    log::Session played = session();
    played.uuid = fmt::format("{:08x}-0000-4000-8000-000000000001", seed);
    played.seed = seed;
    played.config_toml = config;
    played.policies = {{half, half == 1 ? "stopped" : "moving"}};
    evaluator::MatchLog match(path(name), played, options());
    match.kicks(half, "on_target", inside);
    match.kicks(half, "over", 50 - inside);
    match.close();
  }

  /// 50 kicks of both policies, so many of them inside.
  void write_both(const std::string& name, std::int64_t seed, int stopped_inside, int moving_inside) {
    log::Session played = session();
    played.uuid = fmt::format("{:08x}-0000-4000-8000-000000000001", seed);
    played.seed = seed;
    evaluator::MatchLog match(path(name), played, options());
    match.kicks(1, "on_target", stopped_inside);
    match.kicks(1, "over", 50 - stopped_inside);
    match.kicks(2, "on_target", moving_inside);
    match.kicks(2, "over", 50 - moving_inside);
    match.close();
  }

  VerbRun compared(const std::string& rest) const {
    return run_verbs({add_compare}, "compare " + path("a.db").string() + " " + path("b.db").string() + " " + rest);
  }
};

const std::string kOlder =
    "### settings\n\n[policy]\nkeep_off_m = 2.5\nsame = 1\n\n### robot 2\n[kicker]\ndelay_s = 0.05\n";
const std::string kNewer =
    "### settings\n\n[policy]\nkeep_off_m = 3.0\nsame = 1\nfresh = true\n\n### robot 2\n[kicker]\ndelay_s = 0.06\n";

TEST_F(CompareLogs, BeginWithWhatDiffersBetweenThem) {
  write("a.db", 1, 1, 10, kOlder);
  write("b.db", 2, 2, 40, kNewer);
  const std::string text = compared("").out;
  const std::string a = path("a.db").string(), b = path("b.db").string();
  const auto line = [&](const std::string& of, const std::string& older, const std::string& newer) {
    return fmt::format("  {}: {} in {}; {} in {}\n", of, older, a, newer, b);
  };
  EXPECT_THAT(text, HasSubstr("What differs between the logs\n"));
  EXPECT_THAT(text, HasSubstr(line("settings policy.keep_off_m", "2.5", "3.0")));
  EXPECT_THAT(text, HasSubstr(line("settings policy.fresh", "none", "true")));
  EXPECT_THAT(text, HasSubstr(line("robot 2 kicker.delay_s", "0.05", "0.06")));
  EXPECT_THAT(text, HasSubstr(line("sessions seed", "1", "2")));
  EXPECT_THAT(text, Not(HasSubstr("policy.same")));
  EXPECT_LT(text.find("keep_off_m"), text.find("moving differs from stopped: +60.0 points in efficiency"))
      << "differences, then the effect";
  const auto json = nlohmann::json::parse(compared("--json").out);
  EXPECT_THAT(json["differences"].dump(), HasSubstr("keep_off_m"));
}

TEST_F(CompareLogs, OfOnePolicyAreComparedWithEachOther) {
  write("a.db", 1, 2, 10, kOlder);
  write("b.db", 2, 2, 40, kOlder);
  const auto json = nlohmann::json::parse(compared("--json").out);
  EXPECT_EQ(json["by"], "log");
  EXPECT_EQ(json["groups"][0]["name"], path("a.db").string());
  EXPECT_EQ(json["groups"][0]["inside"], 10);
  EXPECT_EQ(json["groups"][1]["inside"], 40);
  EXPECT_EQ(json["comparisons"][0]["design"], "before_after");
}

TEST_F(CompareLogs, OfSeveralPoliciesSayWhatChangedInEach) {
  write_both("a.db", 1, 10, 20);
  write_both("b.db", 2, 40, 22);
  const std::string a = path("a.db").string(), b = path("b.db").string();
  const std::string text = compared("").out;
  EXPECT_THAT(text, HasSubstr("One log against the other\n"));
  EXPECT_THAT(text, HasSubstr(fmt::format("  stopped: {} differs from {}: +60.0 points in efficiency, 95 % ", b, a)));
  EXPECT_THAT(text, HasSubstr(fmt::format("  moving: {} against {}, not enough data: +4.0 points", b, a)));
  EXPECT_THAT(text, HasSubstr("(Holm, 2 comparisons)"));
  EXPECT_THAT(text, HasSubstr("before and after"));
  EXPECT_LT(text.find("sessions seed"), text.find("One log against")) << "after what differs between them";
  EXPECT_LT(text.find("One log against"), text.find("moving differs from stopped")) << "before the policies";
  const auto json = nlohmann::json::parse(compared("--json").out)["between_logs"];
  EXPECT_EQ(json[0]["group"], "stopped");
  EXPECT_NEAR(json[0]["comparisons"][0]["headline"]["difference"].get<double>(), 0.6, 1e-12);
  EXPECT_EQ(json[0]["comparisons"][0]["design"], "before_after");
  EXPECT_TRUE(json[0]["comparisons"][0]["kicks_per_min"].is_null()) << "minutes of play are the whole log's";
  EXPECT_FALSE(nlohmann::json::parse(compared("--by log --json").out).contains("between_logs"));
}

TEST_F(CompareLogs, SayWhichPolicyOneOfThemAloneHas) {
  write("a.db", 1, 1, 10, kOlder);
  write("b.db", 2, 2, 40, kOlder);
  EXPECT_THAT(compared("").out, HasSubstr(fmt::format("  moving: in {} alone\n", path("b.db").string())));
}

TEST_F(CompareLogs, ThatDifferInNothingSaySo) {
  write("a.db", 1, 2, 10, kOlder);
  std::filesystem::copy_file(path("a.db"), path("b.db"));
  EXPECT_THROW(compared("--by log"), std::runtime_error) << "the same session: one log alone has kicks";
}

TEST_F(CompareLogs, ThatHaveNotWhatIsAskedForMakeBadUsage) {
  write_both("a.db", 1, 10, 20);
  write_both("b.db", 2, 40, 22);
  for (const char* const flag : {"--by foo", "--by arm", "--stratify foo", "--baseline foo"})
    EXPECT_THROW(compared(flag), UsageError) << flag;
}

TEST_F(CompareLogs, HaveGates) {
  write("a.db", 1, 1, 10, kOlder);
  write("b.db", 2, 2, 40, kNewer);
  const VerbRun met = compared("--gate 'difference_lo(moving)>=0.3' --gate 'kicks>=50' --gate 'p<0.05'");
  EXPECT_EQ(met.exit_code, kDone);
  EXPECT_THAT(met.out, HasSubstr("gate met: kicks>=50: stopped 50; moving 50"));
  EXPECT_EQ(met.errors, "");
  for (const char* const gate : {"difference_lo(moving)>=0.6", "difference(stopped)>=-1", "kicks_per_min>=0",
                                 "efficiency>=0.7", "on_target_per_opportunity(moving)<=1"}) {
    const VerbRun missed = compared(fmt::format("--gate '{}'", gate));
    EXPECT_EQ(missed.exit_code, kDoneWithLoss) << gate;
    EXPECT_THAT(missed.out, HasSubstr("moving differs from stopped")) << "the comparison is written first";
    EXPECT_THAT(missed.errors, HasSubstr("gate MISSED: ")) << gate;
  }
  EXPECT_THROW(compared("--gate 'diference>=0'"), UsageError);
}

TEST(CompareGates, HoldOfCountsToo) {
  EXPECT_EQ(run_verbs({add_compare}, "compare --counts old=34/65 new=100/132 --gate 'difference_lo>=0.09'").exit_code,
            kDone);
  EXPECT_EQ(run_verbs({add_compare}, "compare --counts old=34/65 new=100/132 --gate 'efficiency(new)>=80%'").exit_code,
            kDoneWithLoss);
}

TEST(CompareOut, IsFoundUnwritableBeforeTheWork) {
  EXPECT_THROW(run_verbs({add_compare}, "compare --csv /nowhere/kicks.csv --out /nowhere/x.txt"), std::runtime_error);
  try {
    run_verbs({add_compare}, "compare --csv /nowhere/kicks.csv --out /nowhere/x.txt");
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot write --out /nowhere/x.txt")) << "not that the table is missing";
  }
}

}  // namespace
}  // namespace trivela::cli
