#include "evaluator/sessions/kicker_learning.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "evaluator/table2/table2.hpp"
#include "tests/evaluator/match_fixture.hpp"
#include "tests/evaluator/report_of_log.hpp"

namespace trivela::evaluator {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

using Int = std::int64_t;

/// A match whose kicks teach the robot its kicker.
class KickerLearningOfALog : public LogTest {
 protected:
  KickerLearningOfALog() : match(path(), session(), options()), estimates(kicker_estimates(match.writer())) {}

  void estimate(Int kick_id, double speed_ln, double chi_square = 4.0, double p_mistaken = 0.0, Int used = 0) {
    const Int kicks = seq++;
    match.writer().push(estimates, {Int{1}, seq,   100 * seq, kick_id, kicks,      used, speed_ln,  0.01, 0.0,
                                    0.002,  0.0,   0.0,       0.02,    0.004,      0.01, 0.003,     0.1,  0.1,
                                    0.02,   0.005, 0.025,     0.015,   p_mistaken, 0.0,  chi_square});
  }

  std::vector<LearnedKicker> read() {
    match.close();
    return learned_kickers_of(log::Reader(path()));
  }

  MatchLog match;
  log::TableId estimates;
  Int seq = 0;
};

TEST_F(KickerLearningOfALog, GivesEveryUpdateWithItsErrors) {
  estimate(0, 0.0);
  estimate(match.kick(1, "on_target"), 0.05);
  estimate(match.kick(1, "over"), 0.09);
  const auto kickers = read();
  ASSERT_THAT(kickers, SizeIs(1));
  EXPECT_EQ(kickers[0].robot_id, 1);
  EXPECT_FALSE(kickers[0].used);
  EXPECT_EQ(kickers[0].kicks(), 2);
  ASSERT_THAT(kickers[0].steps, SizeIs(3));
  EXPECT_EQ(kickers[0].steps[0].kick_id, 0);
  EXPECT_EQ(kickers[0].steps[2].speed_ln.value, 0.09);
  EXPECT_EQ(kickers[0].steps[2].speed_ln.se, 0.02);
}

TEST_F(KickerLearningOfALog, OfFewKicksItSaysThatTheyAreTooFew) {
  estimate(0, 0.0);
  estimate(match.kick(1, "on_target"), 0.05);
  const auto kickers = read();
  EXPECT_FALSE(kickers.at(0).valid());
  EXPECT_THAT(kickers[0].sentences(), ElementsAre(HasSubstr("1 flight is too few to say")));
}

TEST_F(KickerLearningOfALog, BelievesFlightsThatLieWhereItSays) {
  estimate(0, 0.0);
  for (int i = 0; i < 6; ++i) estimate(match.kick(1, "on_target"), 0.05, 3.0 + 0.5 * i);
  const auto kickers = read();
  EXPECT_TRUE(kickers.at(0).valid());
  EXPECT_THAT(kickers[0].sentences().back(), HasSubstr("mean chi-square 4.2, expected 4): it may be believed"));
}

TEST_F(KickerLearningOfALog, WarnsOfAFileThatIsWrongWhereNobodyGoesByTheKicks) {
  estimate(0, 0.0);
  for (int i = 0; i < 6; ++i) estimate(match.kick(1, "over"), 0.095);
  const auto kickers = read();
  EXPECT_THAT(kickers.at(0).sentences(),
              testing::Contains(HasSubstr("warning: the ball is 10 % faster than its file says: trivela calibrate")));
}

TEST_F(KickerLearningOfALog, DoesNotBelieveFlightsThatLieFartherThanItSays) {
  estimate(0, 0.0);
  for (int i = 0; i < 6; ++i) estimate(match.kick(1, "on_target"), 0.05, 15.0);
  const auto kickers = read();
  EXPECT_FALSE(kickers.at(0).valid());
  EXPECT_THAT(kickers[0].sentences().back(), HasSubstr("do not believe it"));
}

TEST_F(KickerLearningOfALog, ItsLastThirtyFlightsSayWhetherToBelieveIt) {
  estimate(0, 0.0);
  for (int i = 0; i < 10; ++i) estimate(match.kick(1, "on_target"), 0.05, 40.0);
  for (int i = 0; i < 30; ++i) estimate(match.kick(1, "on_target"), 0.05, 5.0);
  const auto kickers = read();
  EXPECT_DOUBLE_EQ(kickers.at(0).mean_chi_square(), 5.0);
  EXPECT_TRUE(kickers[0].valid());
}

TEST_F(KickerLearningOfALog, DoesNotBelieveWhereMostFlightsSayNothing) {
  estimate(0, 0.0);
  for (int i = 0; i < 12; ++i) estimate(match.kick(1, "on_target"), 0.05, 3.0, i % 2 == 0 ? 0.99 : 0.0);
  const auto kickers = read();
  EXPECT_EQ(kickers.at(0).mistaken(), 6);
  EXPECT_FALSE(kickers[0].valid());
  EXPECT_THAT(kickers[0].sentences().front(), HasSubstr("6 of 12 flights said nothing of the kicker"));
}

TEST_F(KickerLearningOfALog, TheReportHasItAsTextAndJson) {
  estimate(0, 0.0);
  for (int i = 0; i < 6; ++i) estimate(match.kick(1, "on_target"), 0.095);
  match.close();
  const Report report = make_report(log::Reader(path()));
  ASSERT_THAT(report.kickers, SizeIs(1));
  EXPECT_THAT(to_text(report), HasSubstr("What kicks show of the kickers"));
  EXPECT_THAT(to_text(report), HasSubstr("+9.5 (2.0)"));
  EXPECT_THAT(to_json(report), HasSubstr("\"mean_chi_square\": 4.0"));
}

TEST_F(KickerLearningOfALog, OfSeveralLogsEachKickerHasItsLogsName) {
  estimate(0, 0.0);
  for (int i = 0; i < 6; ++i) estimate(match.kick(1, "on_target"), 0.095);
  match.close();
  log::Session another = session();
  another.uuid = "00000002-0000-4000-8000-000000000001";
  another.seed = 8;
  MatchLog second(path("second.db"), another, options());
  second.kick(1, "over");
  second.close();
  log::Reader of_first(path()), of_second(path("second.db"));
  const OpenLog logs[] = {{&of_first, "first.db"}, {&of_second, "second.db"}};
  const std::string text = to_text(make_report(logs));
  EXPECT_THAT(text, HasSubstr("  robot 1 (first.db)           6 "));
  EXPECT_THAT(text, HasSubstr("robot 1 (first.db): warning: the ball is 10 % faster"));
}

TEST_F(KickerLearningOfALog, ALogWithoutEstimatesHasNone) {
  match.kick(1, "on_target");
  match.close();
  const Report report = make_report(log::Reader(path()));
  EXPECT_THAT(report.kickers, IsEmpty());
  EXPECT_THAT(to_text(report), testing::Not(HasSubstr("What kicks show")));
}

}  // namespace
}  // namespace trivela::evaluator
