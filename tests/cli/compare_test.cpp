#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/compare_input.hpp"
#include "cli/verbs.hpp"

namespace trivela::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string output_of(const std::string& arguments) {
  CLI::App app;
  int exit_code = -1;
  add_compare(app, exit_code);
  testing::internal::CaptureStdout();
  app.parse(arguments);
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

}  // namespace
}  // namespace trivela::cli
